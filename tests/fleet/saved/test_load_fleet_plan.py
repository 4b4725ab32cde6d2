"""Fleets' plans that were saved: equal when they are loaded, refused when somebody changed them."""

import io
import json
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.cli import cli


def go(name: str, start: list[float], goal: list[float], **more: Any) -> dict[str, Any]:
    return {"name": name, "route": {"start": start, "goal": goal}, **more}


SQUARE = {"start": [0, 0], "via": [[20, 0], [20, 20]], "closed": True}
CART = {
    "name": "cart",
    "circle": {"center": [0, 0], "radius": 1},
    "motion": {"from": [15, -10], "velocity_mps": [0, 1.0]},
}
DRONE = {"radius_m": 0.4, "half_height_m": 0.2}
CAR = {"radius_m": 0.5, "drive": {"ackermann": {"wheelbase_m": 1.0, "max_steer_deg": 30}}}
BROAD = {
    "drive": {"omnidirectional": {"max_speed_along_mps": 2, "max_speed_across_mps": 1}},
    "footprint": [[-0.6, -0.3], [0.6, -0.3], [0.6, 0.3], [-0.6, 0.3]],
}
ASKED: dict[str, dict[str, Any]] = {
    "crossing": {
        "separation_m": 1,
        "world": {"known": [{"circle": {"center": [30, 0], "radius": 1}}]},
        "fleet": [
            go("a", [0, 0], [40, 0], depart_s=2),
            go("b 1/2", [20, -20], [20, 20]),
            go("c", [20, 30], [22, -30], rest="leave", priority=2),
        ],
    },
    "not all served": {
        "separation_m": 0.3,
        "world": {"bounds": [-1, -1.05, 21, 1.05]},
        "fleet": [
            go("a", [0, 0], [20, 0]), go("b", [20, 0], [0, 0]), go("c", [14, 0], [9, 0]),
            go("d", [17, 0], [18.5, 0]),
        ],
    },
    "patrols": {
        "separation_m": 1,
        "fleet": [
            {"name": "p", "route": SQUARE},
            {"name": "q", "route": {"start": [10, -5], "via": [[10, 25]], "closed": True}},
            go("b", [30, 10], [-10, 12]),
        ],
    },
    "laps": {
        "fleet": [
            {"name": "p", "route": {**SQUARE, "laps": 1}},
            {"name": "q", "route": {**SQUARE, "start": [10, -5], "via": [[10, 25]], "laps": 2}},
        ],
    },
    "smooth patrol with stations, long body on two laps": {
        "robots": {"soft": {"max_jerk_mps3": 1.0}, "broad": BROAD},
        "world": {"known": [{"circle": {"center": [5, 24], "radius": 1}}]},
        "fleet": [
            {
                "name": "p", "robot": "soft", "depart_s": 2,
                "route": {**SQUARE, "via": [{"at": [20, 0], "dwell_s": 4}, [20, 20]]},
            },
            {
                "name": "b", "robot": "broad",
                "route": {"start": [0, 20], "via": [[0, 27], [10, 27]], "closed": True, "laps": 2},
            },
        ],
    },
    "nobody has a path": {
        "world": {
            "bounds": [-1, -5, 41, 5],
            "known": [{"polygon": [[19, -5], [21, -5], [21, 5], [19, 5]]}],
        },
        "fleet": [go("a", [0, 0], [40, 0])],
    },
    "kinds": {
        "robots": {"car": CAR, "broad": BROAD, "soft": {"max_jerk_mps3": 1.0}},
        "fleet": [
            {
                "name": "car", "robot": "car",
                "route": {"start": [0, 0], "via": [{"at": [10, 0], "dwell_s": 5}], "goal": [20, 0]},
            },
            go("broad", [10, -10], [10, 10], robot="broad"),
            go("soft", [15, 10], [15, -10], robot="soft"),
        ],
    },
    "settled order and tension": {
        "spline": {"tension": "auto"},
        "fleet": [
            {
                "name": "p",
                "route": {
                    "start": [0, 0], "via": [[20, 0], [5, 3], [12, -3]], "order": "shortest",
                    "goal": [30, 0],
                },
            },
            go("b", [10, -9], [10, 9]),
        ],
    },
    "among what moves": {
        "separation_m": 1,
        "world": {"known": [CART]},
        "fleet": [go("a", [0, 0], [40, 0]), go("b", [20, -20], [20, 20])],
    },
    "flights": {
        "separation_m": 2,
        "robots": {"drone": DRONE},
        "fleet": [
            go("a", [0, 0, 10], [40, 0, 10], robot="drone"),
            go("b", [20, -20, 10.5], [20, 20, 10.5], robot="drone"),
        ],
    },
    "flights past what moves": {
        "separation_m": 2,
        "world": {
            "known": [
                {"ball": {"center": [9, 9, 10], "radius": 1}},
                {
                    "name": "balloon", "ball": {"center": [0, 0, 0], "radius": 1.5},
                    "motion": {"from": [8, -16, 10], "velocity_mps": [0, 4, 0]},
                },
                {"box": {"min": [19, 30, 0], "max": [21, 31, 20]}},
            ],
        },
        "robots": {"drone": DRONE},
        "fleet": [
            go("a", [0, 0, 10], [40, 0, 10], robot="drone", depart_s=1),
            go("b", [20, -20, 10.5], [20, 20, 10.5], robot="drone", rest="leave"),
        ],
    },
    "flights that never end": {
        "separation_m": 1,
        "world": {"known": [{"ball": {"center": [12, 12, 11], "radius": 1}}]},
        "robots": {"drone": DRONE},
        "fleet": [
            {
                "name": "p", "robot": "drone",
                "route": {
                    "start": [0, 0, 10], "closed": True,
                    "via": [{"at": [20, 0, 10], "dwell_s": 2, "look_at": [20, 9, 9]},
                            [20, 20, 12]],
                },
            },
            {
                "name": "q", "robot": "drone",
                "route": {"start": [10, -5, 10], "via": [[10, 25, 11]], "closed": True},
            },
            go("b", [30, 10, 10], [-10, 12, 11], robot="drone"),
        ],
    },
    "flights in the order that is shortest": {
        "robots": {"drone": DRONE},
        "fleet": [
            {
                "name": "p", "robot": "drone",
                "route": {
                    "start": [0, 0, 9], "via": [[20, 0, 9], [5, 3, 9], [12, -3, 12]],
                    "order": "shortest", "goal": [30, 0, 9],
                },
            },
        ],
    },
    "on a lattice": {
        "separation_m": 0.3,
        "world": {"bounds": [-1, -1, 7, 7]},
        "robots": {"k": {"radius_m": 0.4, "clearance_m": 0.1}},
        "fleet": [
            go("a", [0, 0], [6, 0], robot="k"), go("b", [6, 0], [0, 0], robot="k"),
            go("c", [0, 6], [6, 6], robot="k"), go("d", [6, 6], [0, 6], robot="k"),
        ],
    },
}  # fmt: skip

Saved = dict[str, tuple[Path, vs.FleetPlan]]


@pytest.fixture(scope="module")
def unpainted() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("viaspline.report.fleet_results.fleet_picture", lambda plan, name: b"")
        yield


@pytest.fixture(scope="module")
def saved(tmp_path_factory: pytest.TempPathFactory, unpainted: None) -> Saved:
    folders = {}
    for name, asked in ASKED.items():
        folder = tmp_path_factory.mktemp(name)
        made = vs.plan_fleet(vs.Fleet.model_validate(asked))
        made.save(folder)
        folders[name] = (folder, made)
    return folders


def test_what_was_saved_is_of_every_kind(saved: Saved) -> None:
    assert any(one.waits_s > 0.0 for one in saved["crossing"][1].precedences)
    assert {one.name for one in saved["not all served"][1].not_served} == {"a", "b"}
    assert set(saved["not all served"][1].courses.names) > set(saved["not all served"][1].plans)
    patrols = saved["patrols"][1].patrols
    assert patrols is not None
    assert set(patrols.laps) == {"p", "q"}
    assert saved["laps"][1].patrols is None
    assert saved["flights"][1].is_spatial
    assert len(saved["on a lattice"][1].plans) == 4


@pytest.mark.parametrize("name", ASKED)
def test_a_fleets_plan_that_is_loaded_equals_the_one_that_was_saved(
    name: str, saved: Saved
) -> None:
    folder, made = saved[name]
    again = vs.load_fleet_plan(folder)
    assert again == made
    assert hash(again) == hash(made)
    assert again.fleet == made.fleet
    assert vs.load_fleet_plan(str(folder / "fleet.json"), made.fleet) == made


@pytest.mark.parametrize("change", ["added", "removed", "rerouted"])
def test_a_plan_that_was_changed_is_loaded_again_with_its_fleet(
    change: str, saved: Saved, tmp_path: Path
) -> None:
    plan = saved["crossing"][1]
    there = vs.Mission.model_validate(
        {"world": plan.fleet.world, "route": {"start": [32, -20], "goal": [32, 20]}}
    )
    made = {
        "added": lambda: vs.add_robot(plan, vs.FleetMember("d", there)),
        "removed": lambda: vs.remove_robot(plan, "a"),
        "rerouted": lambda: vs.reroute_robot(plan, vs.FleetMember("a", there)),
    }[change]()
    with pytest.warns(vs.MissionWarning, match=r"made in memory.*load_fleet_plan"):
        made.save(tmp_path)
    with pytest.raises(vs.SavedPlanError, match="give load_fleet_plan the fleet"):
        vs.load_fleet_plan(tmp_path)
    assert vs.load_fleet_plan(tmp_path, made.fleet) == made


def test_a_loaded_plan_is_driven_exported_and_saved_as_any_other(
    saved: Saved, tmp_path: Path
) -> None:
    folder, made = saved["crossing"]
    again = vs.load_fleet_plan(folder)
    run = vs.simulate_fleet(again.fleet, plan=again, delays=vs.Delays(slowed=0.2), seed=3)
    assert run == vs.simulate_fleet(made.fleet, plan=made, delays=vs.Delays(slowed=0.2), seed=3)
    told = [vs.FleetNavigator(one, warm=False).step((), 0.0)[0] for one in (again, made)]
    assert told[0] == told[1]
    again.save(tmp_path / "again")
    assert vs.load_fleet_plan(tmp_path / "again") == made
    called = ["export", str(folder), str(tmp_path / "round.csv"), "--quiet"]
    assert CliRunner().invoke(cli, called).exit_code == 0
    files = vs.export_fleet(made, tmp_path / "made.csv").values()
    exported = [one.path.read_bytes() for one in files if one.path is not None]
    assert [one.read_bytes() for one in sorted(tmp_path.glob("round*.csv"))] == exported
    assert vs.remove_robot(again, "a") == vs.remove_robot(made, "a")


def put(value: Any, *keys: Any) -> Callable[[Any], None]:
    def change(data: Any) -> None:
        for key in keys[:-1]:
            data = data[key]
        data[keys[-1]] = value

    return change


def nudge(by: float, *keys: Any) -> Callable[[Any], None]:
    def change(data: Any) -> None:
        for key in keys[:-1]:
            data = data[key]
        data[keys[-1]] = data[keys[-1]] + by

    return change


def edited(source: Path, target: Path, file: str, change: Callable[[Any], None]) -> Path:
    shutil.copytree(source, target)
    path = target / file
    if path.suffix == ".npz":
        with np.load(path) as stored:
            columns = {name: stored[name].copy() for name in stored.files}
        change(columns)
        content = io.BytesIO()
        np.savez(content, **columns)
        path.write_bytes(content.getvalue())
    else:
        data = json.loads(path.read_text())
        change(data)
        path.write_text(json.dumps(data))
    return target


def sooner(columns: Any) -> None:
    for column in ("laws.arrive", "laws.leave"):
        columns[column] = columns[column] - 3.0


def faster_alone(columns: Any) -> None:
    columns["rides.square"] = 2.0 * columns["rides.square"]


def swapped(data: Any) -> None:
    one = data["precedences"][0]
    one["first"], one["second"] = one["second"], one["first"]


def half_a_period(data: Any) -> None:
    data["patrols"]["period_s"] *= 0.5


def nobody_stands(columns: Any) -> None:
    columns["laws.is_timed"][:] = False


def beside_its_start(columns: Any) -> None:
    columns["courses.place"] = columns["courses.place"] + 0.1


CHANGES: list[tuple[str, str, Callable[[Any], None], str]] = [
    ("crossing", "fleet.json", nudge(0.01, "certificate", "separation_m"), "of separation"),
    ("crossing", "fleet.json", nudge(0.1, "fleet", "separation_m"), "of separation_m"),
    ("crossing", "fleet.json", put(["a", "c"], "certificate", "pair"), "are nearest"),
    ("crossing", "fleet.json", put(False, "certificate", "holds"), "holds isn't"),
    ("crossing", "fleet.json", put([], "precedences"), "0 precedences"),
    ("crossing", "fleet.json", swapped, "passes before"),
    ("crossing", "fleet.json", nudge(1.0, "precedences", 0, "leaves_at_m"), "passes before"),
    ("crossing", "fleet.json", nudge(1.0, "robots", 0, "arrives_s"), "arrives_s of 'a'"),
    ("crossing", "fleet.json", nudge(-1.0, "robots", 0, "alone_s"), "alone_s of 'a'"),
    ("crossing", "fleet.json", put("x", "robots", 0, "name"), "other robots"),
    ("crossing", "fleet.json", put("../a/plan.json", "robots", 0, "plan"), "FOLDER/plan.json"),
    ("crossing", "fleet.json", put("c/plan.json", "robots", 0, "plan"), "doesn't run through"),
    ("crossing", "fleet.json", put(None, "robots", 0, "plan"), "has no plan"),
("crossing", "fleet.json", put([{}], "refused"), "refused isn't"),
    ("crossing", "a/plan.json", nudge(0.5, "certificate", "clearance_m"), "of clearance"),
    ("crossing", "a/plan.json", nudge(1.0, "trajectory", "duration_s"), "of duration"),
    ("crossing", "courses.npz", sooner, "isn't that of its plan"),
    ("crossing", "courses.npz", faster_alone, "faster than its limits"),
    ("crossing", "courses.npz", beside_its_start, "isn't on its path"),
    ("crossing", "courses.npz", nudge(-0.2, "courses.reach"), "more room"),
    ("crossing", "courses.npz", put(np.zeros(3), "laws.arrive"), "has no laws.arrive"),
    ("not all served", "courses.npz", nobody_stands, "isn't that of its plan|stand at its start"),
    ("not all served", "courses.npz", beside_its_start, "stand at its start|on its path"),
    ("not all served", "fleet.json", put([], "refused"), "refused doesn't name"),
    ("patrols", "fleet.json", half_a_period, "patrols|where it was before"),
    ("patrols", "fleet.json", nudge(1, "patrols", "robots", 0, "laps_a_period"), "was before"),
    ("patrols", "fleet.json", nudge(-9.0, "patrols", "repeats_from_s"), "hasn't arrived|before"),
    ("patrols", "fleet.json", nudge(2e3, "patrols", "planned_until_s"), "where it was before"),
    ("patrols", "fleet.json", nudge(-1, "patrols", "robots", 0, "laps_planned"), "faster|before"),
    ("flights", "fleet.json", put({}, "patrols"), "patrols|period_s"),
    ("flights", "courses.npz", sooner, "isn't that of its plan"),
    ("flights past what moves", "a/plan.json", nudge(0.1, "certificate", "moving", "clearance_m"),
     "what moves"),
    ("flights past what moves", "courses.npz", sooner, "isn't that of its plan"),
    ("flights that never end", "fleet.json", half_a_period, "patrols|where it was before"),
    ("flights that never end", "fleet.json", nudge(1, "patrols", "robots", 0, "laps_a_period"),
     "was before"),
    ("flights that never end", "fleet.json", nudge(-1, "patrols", "robots", 0, "laps_planned"),
     "aren't the first|faster|before"),
    ("flights that never end", "p/plan.json", nudge(0.5, "certificate", "clearance_m"),
     "of clearance"),
    ("flights that never end", "courses.npz", faster_alone, "faster than its limits"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "file", "change", "words"), CHANGES, ids=[f"{k}" for k in range(len(CHANGES))]
)
def test_files_that_somebody_changed_are_refused(
    name: str, file: str, change: Callable[[Any], None], words: str, saved: Saved, tmp_path: Path
) -> None:
    folder = edited(saved[name][0], tmp_path / "edited", file, change)
    with pytest.raises(vs.SavedPlanError, match=words):
        vs.load_fleet_plan(folder)


def test_another_fleet_is_refused(saved: Saved) -> None:
    folder, _made = saved["crossing"]
    grown = vs.Fleet.model_validate(
        {**ASKED["crossing"], "world": {"known": [{"circle": {"center": [30, 0], "radius": 2}}]}}
    )
    with pytest.raises(vs.SavedPlanError, match=r"clearance|keep"):
        vs.load_fleet_plan(folder, grown)
    fewer = vs.Fleet.model_validate({**ASKED["crossing"], "fleet": ASKED["crossing"]["fleet"][:2]})
    with pytest.raises(vs.SavedPlanError, match="other robots than the fleet: 'c'"):
        vs.load_fleet_plan(folder, fewer)
    stays = vs.Fleet.model_validate(
        {
            **ASKED["crossing"],
            "fleet": [{**one, "rest": "stay"} for one in ASKED["crossing"]["fleet"]],
        }
    )
    with pytest.raises(vs.SavedPlanError, match=r"isn't that of its plan|than its limits"):
        vs.load_fleet_plan(folder, stays)


def test_what_is_no_plan_of_a_fleet_is_told(saved: Saved, tmp_path: Path) -> None:
    with pytest.raises(vs.SavedPlanError, match=r"no planned-fleet\.yaml beside it"):
        vs.load_fleet_plan(tmp_path)
    with pytest.raises(vs.MissionError, match="there is no such file"):
        vs.load_fleet_plan(tmp_path, saved["crossing"][1].fleet)
    with pytest.raises(vs.GeometryError, match="folder is of the class int"):
        vs.load_fleet_plan(5)  # type: ignore[arg-type]
    with pytest.raises(vs.SavedPlanError, match="call load_fleet_plan"):
        vs.load_plan(saved["crossing"][0])
    shutil.copytree(saved["crossing"][0], tmp_path / "copy")
    (tmp_path / "copy" / "courses.npz").unlink()
    with pytest.raises(vs.MissionError, match="there is no such file"):
        vs.load_fleet_plan(tmp_path / "copy")


@given(data=st.data())
@settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_whatever_is_put_into_the_file_of_a_fleet_it_is_loaded_or_refused(
    data: st.DataObject, saved: Saved, tmp_path: Path
) -> None:
    name = data.draw(st.sampled_from(["crossing", "not all served", "patrols"]))
    folder, made = saved[name]
    content = json.loads((folder / "fleet.json").read_text())
    parts = ["robots", "certificate", "precedences", "refused", "patrols", "fleet"]
    part = data.draw(st.sampled_from([one for one in parts if one in content]))
    keys: list[Any] = [part]
    inside = content[part]
    while isinstance(inside, dict | list) and inside and data.draw(st.booleans()):
        choices = list(inside) if isinstance(inside, dict) else list(range(len(inside)))
        keys.append(data.draw(st.sampled_from(choices)))
        inside = inside[keys[-1]]
    junk = data.draw(
        st.one_of(
            st.none(), st.booleans(), st.text(max_size=3), st.floats(-1e9, 1e9), st.just([]),
            st.just({}), st.just([[1, 2], [3]]),
        )
    )  # fmt: skip
    shutil.rmtree(tmp_path / "junk", ignore_errors=True)
    changed = edited(folder, tmp_path / "junk", "fleet.json", put(junk, *keys))
    try:
        again = vs.load_fleet_plan(changed)
    except vs.SavedPlanError:
        return
    assert again.certificate == made.certificate
    assert again.plans == made.plans
