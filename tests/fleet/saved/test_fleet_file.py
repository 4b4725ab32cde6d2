"""Files of a fleet's plan that somebody has changed: refused, with what is wrong."""

import io
import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fleets_to_save import Saved
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import viaspline as vs


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
