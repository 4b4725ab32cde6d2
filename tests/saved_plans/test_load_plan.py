import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import viaspline as vs

EXAMPLES = Path(__file__).parents[2] / "examples"
CART = {
    "name": "cart", "circle": {"center": [0, 0], "radius": 1},
    "motion": {"from": [60, 40], "velocity_mps": [0, 1]},
}  # fmt: skip
TANK = {"name": "tank", "circle": {"center": [50, 52], "radius": 10}}
ROUTE = {"start": [10, 50], "via": [{"at": [70, 60], "dwell_s": 3}], "goal": [90, 20]}
TOWER = {"circle": {"center": [40, 0.5], "radius": 4}, "height_m": [0, 30]}
ASKED: dict[str, dict[str, Any]] = {
    "plain": {"world": {"bounds": [0, 0, 100, 100], "known": [TANK]}, "route": ROUTE},
    "stiff": {
        "world": {"known": [TANK]},
        "robot": {
            "min_turn_radius_m": 3, "footprint": [[-1, -0.5], [2, -0.5], [2, 0.5], [-1, 0.5]],
        },
        "route": ROUTE,
    },
    "driven": {
        "world": {"known": [TANK]},
        "robot": {"radius_m": 0.3, "drive": {"differential": {"track_m": 0.4}}},
        "route": ROUTE,
    },
    "reordered": {
        "world": {"known": [TANK]},
        "spline": {"tension": "auto"},
        "route": {**ROUTE, "via": [[80, 80], [20, 90], [70, 20]], "order": "shortest"},
    },
    "among": {"world": {"known": [TANK, CART]}, "route": ROUTE},
    "turning slowly among": {
        "world": {
            "known": [
                {"circle": {"center": [13.96, 2], "radius": 0.738}},
                {
                    "circle": {"center": [0, 0], "radius": 0.24},
                    "motion": {"from": [5.52, 8.47], "velocity_mps": [0.46, -0.04]},
                },
                {
                    "circle": {"center": [0, 0], "radius": 0.35},
                    "motion": {
                        "keyframes": [[0, 14.72, 7.25], [4.68, 15, 8.76], [28.75, 1.34, 0.57]],
                        "after": "bounce",
                    },
                },
            ],
            "speed_zones": [
                {"polygon": [[2, 8], [7, 8], [7, 13], [2, 13]], "max_speed_mps": 0.565},
                {"polygon": [[1, 2], [6.5, 2], [6.5, 4.4], [1, 4.4]], "max_speed_mps": 0.209},
            ],
        },
        "robot": {
            "max_speed_mps": 1.328, "max_accel_mps2": 1, "radius_m": 0.4, "clearance_m": 0.315,
            "drive": {
                "omnidirectional": {"max_speed_along_mps": 1.5, "max_speed_across_mps": 1},
                "delay_s": 0.05, "lag_s": 0.1,
            },
            "max_yaw_accel_degps2": 63.276,
        },
        "route": {
            "start": [17.33, 5.07], "via": [[12.87, 11.76], {"at": [4.38, 0.31], "dwell_s": 2}],
            "closed": True, "laps": 2, "optimise": "length",
        },
    },
    "round a zone": {
        "world": {
            "speed_zones": [
                {
                    "polygon": [[40, 30], [60, 30], [60, 60], [40, 60]], "max_speed_mps": 0.3,
                    "name": "lab",
                },
            ],
        },
        "route": {"start": [10, 50], "goal": [90, 50]},
    },
    "laps": {
        "world": {"known": [TANK]},
        "route": {"start": [10, 50], "via": [[70, 70], [80, 30]], "closed": True, "laps": 2},
    },
    "roomy": {
        "world": {"known": [TANK]},
        "robot": {"prefer_clearance_m": 1.0},
        "route": {**ROUTE, "depart_s": 5},
    },
    "unseen crosses": {
        "world": {
            "known": [TANK],
            "unseen": [
                {
                    "name": "cart", "circle": {"center": [0, 0], "radius": 1},
                    "motion": {"from": [80, 20], "velocity_mps": [0, 0.5]},
                },
            ],
        },
        "robot": {"sensor": {"range_m": 9}},
        "route": {**ROUTE, "depart_s": 5},
    },
    "flight": {
        "world": {"known": [TOWER], "ground": {"flat_m": 0}},
        "route": {
            "start": [0, 0], "takeoff": {"to_agl_m": 10}, "via": [{"at": [60, 5], "agl_m": 15}],
            "land": {"at": [90, 0]},
        },
    },
    "flight among": {
        "world": {
            "known": [
                {**TOWER, "height_m": [0, 3]},
                {
                    "name": "kite", "ball": {"center": [0, 0, 0], "radius": 2},
                    "motion": {"from": [40, -87, 10], "velocity_mps": [0, 4, 0]},
                },
            ]
        },
        "route": {"start": [0, 0, 10], "via": [[70, 5, 10]], "goal": [100, 0, 10], "depart_s": 3},
    },
    "flight led round": {
        "world": {
            "known": [
                {
                    "name": "airship", "ball": {"center": [0, 0, 0], "radius": 2},
                    "motion": {"from": [97.3, 0.1, 10], "velocity_mps": [-1.7, 0.013, 0.007]},
                },
            ]
        },
        "route": {"start": [0, 0, 10], "goal": [80, 0, 10]},
    },
}  # fmt: skip


class Saved(dict[str, tuple[Path, Any]]):
    """The plans and where they are saved; each is made when it is first asked for."""

    def __init__(self, root: Path) -> None:
        super().__init__()
        self.root = root

    def __missing__(self, name: str) -> tuple[Path, Any]:
        made = vs.plan(vs.Mission.model_validate(ASKED[name]))
        made.save(self.root / name)
        self[name] = (self.root / name, made)
        return self[name]


@pytest.fixture(scope="module")
def saved(tmp_path_factory: pytest.TempPathFactory) -> Saved:
    return Saved(tmp_path_factory.mktemp("saved"))


@pytest.mark.parametrize("name", ASKED)
def test_a_plan_that_is_loaded_equals_the_one_that_was_saved(name: str, saved: Saved) -> None:
    folder, made = saved[name]
    again = vs.load_plan(folder)
    assert type(again) is type(made)
    assert again == made
    assert hash(again) == hash(made)
    assert vs.load_plan(str(folder / "plan.json"), made.mission) == made
    assert again.ledger == made.ledger
    if isinstance(again, vs.Plan):
        assert again.drivability.verdict == made.drivability.verdict
        assert again.preferred_clearance == made.preferred_clearance
        assert (again.timed is None) == (made.timed is None)
        if again.timed is not None:
            assert again.timed.candidates == made.timed.candidates
            assert again.timed.waits == made.timed.waits


def test_what_was_saved_has_something_to_keep_of_every_kind(saved: Saved) -> None:
    assert saved["plain"][1].ledger
    assert saved["roomy"][1].preferred_clearance.tried
    assert saved["among"][1].timed.candidates
    assert saved["flight"][1].ledger
    assert saved["flight among"][1].waits


def test_a_loaded_plan_is_saved_simulated_and_drawn_as_any_other(
    saved: Saved, tmp_path: Path
) -> None:
    folder, made = saved["plain"]
    again = vs.load_plan(folder)
    again.save(tmp_path / "again")
    assert vs.load_plan(tmp_path / "again") == made
    assert isinstance(again, vs.Plan)
    assert vs.simulate(again.mission, plan=again).reached
    assert again._repr_png_()


@pytest.mark.parametrize("name", ["depot-round", "hill-survey", "oncoming-niche", "yard-rover"])
def test_an_example_is_loaded_again_with_its_maps(name: str, tmp_path: Path) -> None:
    made = vs.plan(EXAMPLES / f"{name}.yaml")
    made.save(tmp_path)
    assert vs.load_plan(tmp_path) == made


def edited(source: Path, target: Path, change: Callable[[Any], None]) -> Path:
    shutil.copytree(source, target, dirs_exist_ok=True)
    data = json.loads((target / "plan.json").read_text())
    change(data)
    (target / "plan.json").write_text(json.dumps(data))
    return target


def through_the_tank(data: Any) -> None:
    for span in data["path"]["spans"]:
        for point in span:
            if 30 < point[0] < 60:
                point[1] = 52.0
    for via in data["path"]["vias"]:
        if via["kind"] == "detour":
            via["at"][1] = 52.0


def nudge(*keys: Any, by: float = 0.01) -> Callable[[Any], None]:
    def change(data: Any) -> None:
        for key in keys[:-1]:
            data = data[key]
        data[keys[-1]] += by

    return change


def put(value: Any, *keys: Any) -> Callable[[Any], None]:
    def change(data: Any) -> None:
        for key in keys[:-1]:
            data = data[key]
        data[keys[-1]] = value

    return change


def faster(data: Any) -> None:
    law = data["trajectory"]["law"]
    begin = law["times_s"][0]
    law["times_s"] = [begin + 0.5 * (time - begin) for time in law["times_s"]]
    law["speeds_mps"] = [2.0 * speed for speed in law["speeds_mps"]]
    law["accelerations_mps2"] = [4.0 * accel for accel in law["accelerations_mps2"]]


CHANGES: list[tuple[str, str, Callable[[Any], None], str]] = [
    ("plain", "through the tank", through_the_tank, "isn't on the path|clearance|jumps|starts"),
    ("plain", "more clearance", nudge("certificate", "clearance_m"), "says .* of clearance"),
    ("plain", "sooner", nudge("trajectory", "duration_s", by=-1.0), "says .* of duration"),
    ("plain", "another neighbour", put("bounds", "certificate", "nearest"), "is nearest"),
    ("plain", "a via elsewhere", nudge("path", "vias", 1, "at", 0), "isn't on the path"),
    ("plain", "no dwell", put(0.0, "path", "vias", -2, "dwell_s"), "stays 0 s"),
    ("plain", "no points of the route", put([], "path", "vias"), "doesn't run through point 0"),
    ("plain", "kept more", put(0.2, "tracking_error_m"), "clearance|keep"),
    ("plain", "no spans", put([], "path", "spans"), "path is none"),
    ("plain", "words for numbers", put([[["a", 1]]], "path", "spans"), "else than numbers"),
    ("plain", "no certificate", put(5, "certificate"), "has no certificate.clearance_m"),
    ("plain", "not a number", put("much", "certificate", "clearance_m"), "not a number"),
    ("stiff", "less curved", nudge("path", "curvature_bound_1pm", by=-0.1), "of curvature"),
    ("among", "faster than it may", faster, "faster than the robot"),
    ("among", "no motion", nudge("trajectory", "law", "speeds_mps", 1), "isn't a motion"),
    ("among", "begun later", nudge("trajectory", "law", "times_s", 0, by=-0.5), "begin|motion"),
    ("among", "nearer", nudge("certificate", "moving", "clearance_m"), "to what moves"),
    ("among", "shorter columns", put([0.0], "trajectory", "law", "times_s"), "isn't as long"),
    ("among", "no stations", put(7, "trajectory", "stations"), "stations are none"),
    ("flight", "on the ground all the way", put([80.0, 85.0], "airborne_m"), "take-off"),
    ("flight", "airborne nowhere", put([5.0, 1.0], "airborne_m"), "isn't a part"),
    ("flight", "more clearance", nudge("certificate", "clearance_m"), "of clearance"),
    ("flight", "sooner", nudge("trajectory", "duration_s", by=-1.0), "of duration"),
    ("flight among", "faster than it may", faster, "faster than the robot"),
    ("flight among", "nearer", nudge("certificate", "moving", "clearance_m"), "to what moves"),
    ("plain", "no ledger", put(5, "ledger"), "ledger isn't what it has to be"),
    ("plain", "a side that isn't", put("up", "ledger", 0, "candidates", 0, "side"), "ledger isn't"),
    ("among", "no waits", put(None, "trajectory", "waits"), "trajectory.waits isn't"),
]


@pytest.mark.parametrize(
    ("name", "change", "words"),
    [(name, change, words) for name, _, change, words in CHANGES],
    ids=[f"{name}: {what}" for name, what, _, _ in CHANGES],
)
def test_a_file_that_somebody_changed_is_refused(
    name: str, change: Callable[[Any], None], words: str, saved: Saved, tmp_path: Path
) -> None:
    folder = edited(saved[name][0], tmp_path / "edited", change)
    with pytest.raises(vs.SavedPlanError, match=words) as told:
        vs.load_plan(folder)
    assert told.value.path.endswith("plan.json")


def test_a_mission_that_somebody_changed_is_refused(saved: Saved, tmp_path: Path) -> None:
    folder, made = saved["plain"]
    grown = vs.Mission.model_validate(
        {**ASKED["plain"], "world": {"known": [{"circle": {"center": [50, 52], "radius": 12}}]}}
    )
    with pytest.raises(vs.SavedPlanError, match="clearance"):
        vs.load_plan(folder, grown)
    farther = vs.Mission.model_validate({**ASKED["plain"], "route": {**ROUTE, "goal": [91, 20]}})
    with pytest.raises(vs.SavedPlanError, match="doesn't run through point 2"):
        vs.load_plan(folder, farther)
    slower = made.mission.model_copy(
        update={"robot": made.mission.robot.model_copy(update={"max_speed_mps": 1.0})}
    )
    with pytest.raises(vs.SavedPlanError, match="faster than the robot's limits"):
        vs.load_plan(folder, slower)


def leaves(data: Any, *keys: Any) -> list[tuple[Any, ...]]:
    """The keys of every number in a file."""
    if isinstance(data, dict):
        return [leaf for key, item in data.items() for leaf in leaves(item, *keys, key)]
    if isinstance(data, list):
        return [leaf for key, item in enumerate(data) for leaf in leaves(item, *keys, key)]
    return [keys]


@given(data=st.data())
@settings(
    max_examples=60, deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)  # fmt: skip
def test_whatever_is_put_into_a_file_it_is_loaded_or_refused(
    data: st.DataObject, saved: Saved, tmp_path: Path
) -> None:
    name = data.draw(st.sampled_from(["plain", "among", "flight among"]))
    folder, made = saved[name]
    content = json.loads((folder / "plan.json").read_text())
    keys = data.draw(st.sampled_from(leaves(content)))
    junk = data.draw(
        st.one_of(
            st.none(), st.booleans(), st.text(max_size=3), st.floats(-1e9, 1e9), st.just([]),
            st.just({}), st.just(1e308), st.just([[1, 2], [3]]),
        )
    )  # fmt: skip
    depth = data.draw(st.integers(1, len(keys)))
    changed = edited(folder, tmp_path / "junk", put(junk, *keys[:depth]))
    try:
        again = vs.load_plan(changed)
    except vs.SavedPlanError:
        return
    assert again.certificate.holds
    assert again.mission == made.mission


def test_what_is_no_plan_is_told(saved: Saved, tmp_path: Path) -> None:
    with pytest.raises(vs.MissionError, match="there is no such file"):
        vs.load_plan(tmp_path)
    (tmp_path / "plan.json").write_text("{")
    with pytest.raises(vs.SavedPlanError, match="isn't JSON"):
        vs.load_plan(tmp_path, EXAMPLES / "fig8-patrol.yaml")
    (tmp_path / "plan.json").write_text("[" * 100_000)
    with pytest.raises(vs.SavedPlanError, match="isn't JSON"):
        vs.load_plan(tmp_path, EXAMPLES / "fig8-patrol.yaml")
    (tmp_path / "plan.json").write_text("[1]")
    with pytest.raises(vs.SavedPlanError, match="holds no plan"):
        vs.load_plan(tmp_path, EXAMPLES / "fig8-patrol.yaml")
    shutil.copy(saved["plain"][0] / "plan.json", tmp_path)
    with pytest.raises(vs.SavedPlanError, match=r"no planned-mission\.yaml beside it"):
        vs.load_plan(tmp_path)
    with pytest.raises(vs.GeometryError, match="folder is of the class int"):
        vs.load_plan(5)  # type: ignore[arg-type]


def test_the_plan_of_a_fleet_is_loaded_robot_by_robot_with_what_each_waits(tmp_path: Path) -> None:
    routes = {"a": ([0, 0], [40, 0]), "b": ([20, -20], [20, 20]), "c": ([20, 30], [22, -30])}
    fleet = vs.Fleet.model_validate(
        {
            "separation_m": 1,
            "fleet": [
                {"name": name, "depart_s": 2, "route": {"start": start, "goal": goal}}
                for name, (start, goal) in routes.items()
            ],
        }
    )
    planned = vs.plan_fleet(fleet)
    planned.save(tmp_path)
    assert any(one.waits_s > 0.0 for one in planned.precedences)
    with pytest.raises(vs.SavedPlanError, match=r"call load_fleet_plan.* load_plan\(folder / NAME"):
        vs.load_plan(tmp_path)
    for member in fleet.members:
        assert vs.load_plan(tmp_path / member.name, member.mission) == planned.plans[member.name]


def test_a_map_that_was_made_in_memory_is_given_again(tmp_path: Path) -> None:
    cells = np.zeros((40, 40), bool)
    cells[18:22, 18:22] = True
    mission = vs.Mission.model_validate(
        {
            "world": {"known": [vs.Obstacle(grid=vs.Grid(cells, 0.5))]},
            "route": {"start": [2, 2], "goal": [18, 18]},
        }
    )
    made = vs.plan(mission)
    (tmp_path / "planned-mission.yaml").write_text("of an earlier plan")
    with pytest.warns(vs.MissionWarning, match="made in memory.*give it to load_plan"):
        made.save(tmp_path)
    with pytest.raises(vs.SavedPlanError, match="give load_plan the mission"):
        vs.load_plan(tmp_path)
    assert vs.load_plan(tmp_path, made.mission) == made
