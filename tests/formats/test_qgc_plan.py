import json
import warnings
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import MissionError, MissionWarning
from viaspline.formats.interpret import mission_of
from viaspline.formats.load import load
from viaspline.formats.qgc_plan import QgcPlan

DATA = Path(__file__).parent / "data"


def simple(latitude: float | None, longitude: float | None, command: int = 16) -> dict[str, Any]:
    params = [0, 0, 0, None, latitude, longitude, 20]
    return {"type": "SimpleItem", "command": command, "frame": 3, "params": params}


def plan(**changes: Any) -> dict[str, Any]:
    mission = {
        "version": 2,
        "vehicleType": 2,
        "hoverSpeed": 5,
        "cruiseSpeed": 15,
        "plannedHomePosition": [47.0, 8.0, 400],
        "items": [simple(47.001, 8.0), simple(47.001, 8.001)],
    }
    top = {"fileType": "Plan", "version": 1, "geoFence": {}, "rallyPoints": {}}
    return {**top, "mission": mission} | changes


def loaded(data: Any) -> Any:
    return mission_of(QgcPlan().parse(json.dumps(data), "x.plan"))


def test_a_plan_of_a_real_vehicle_becomes_a_mission() -> None:
    with pytest.warns(MissionWarning, match=r"item 3: photograph|climb"):
        mission = load(DATA / "qgroundcontrol_sample.plan")
    assert mission.route.start.at == (0, 0, 50)
    assert mission.route.via[0].at[0] == pytest.approx(75.8, abs=0.1)
    assert mission.robot.max_speed_mps == 5


def test_a_survey_is_its_way_points() -> None:
    with pytest.warns(MissionWarning, match="camera"):
        mission = load(DATA / "qgroundcontrol_sample_with_survey.plan")
    assert len(mission.route.via) == 7


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("qgroundcontrol_sample_with_survey_missing_items.plan", "survey"),
        ("qgroundcontrol_sample_with_structured_scan.plan", "StructureScan"),
    ],
)
def test_what_is_not_resolved_is_named_in_warning_and_error(name: str, kind: str) -> None:
    words = rf"mission.items\[1\] is a {kind} that isn't resolved"
    with pytest.warns(MissionWarning) as caught, pytest.raises(MissionError, match=words):
        load(DATA / name)
    named = f"mission.items[1]: {kind} that isn't resolved"
    assert sum(named in str(warning.message) for warning in caught) == 1


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("qgroundcontrol_sample_without_mission.plan", "mission: is missing"),
        ("qgroundcontrol_sample_wrong_mission_version.plan", "mission.version: version 7"),
        ("qgroundcontrol_sample_wrong_overall_version.plan", "version: version 42"),
    ],
)
def test_plans_that_cannot_be_read_say_why(name: str, words: str) -> None:
    with pytest.raises(MissionError, match=words):
        load(DATA / name)


def test_a_plan_that_says_no_version_is_told_so() -> None:
    with pytest.raises(MissionError, match=r"\bversion: is missing; it should be 1"):
        loaded(plan(version=None))
    data = plan()
    del data["mission"]["version"]
    with pytest.raises(MissionError, match=r"mission\.version: is missing; it should be 2"):
        loaded(data)


def test_other_vehicles_go_at_cruise_speed() -> None:
    data = plan()
    data["mission"]["vehicleType"] = 10
    assert loaded(data).robot.max_speed_mps == 15


def test_fences_become_fences_and_obstacles_and_nothing_is_dropped_in_silence() -> None:
    square = [[46.99, 7.99], [46.99, 8.02], [47.02, 8.02], [47.02, 7.99]]
    small = [[47.01, 8.01], [47.01, 8.011], [47.011, 8.011]]
    circle = {"center": [47.0, 8.0], "radius": 800.0}
    fence = {
        "polygons": [
            {"polygon": square, "inclusion": True},
            {"polygon": small, "inclusion": False},
        ],
        "circles": [{"circle": circle, "inclusion": True}],
        "breachReturn": [47.0, 8.0, 1],
    }
    data = plan(geoFence=fence, rallyPoints={"points": [[47.0, 8.0, 1]]})
    with pytest.warns(MissionWarning) as caught:
        world = loaded(data).world
    messages = " | ".join(str(warning.message) for warning in caught)
    assert len(caught) == 3
    assert "geoFence.circles[0]: inclusion circle" in messages
    assert "rallyPoints.points[0]: rally point" in messages
    assert "geoFence.breachReturn: breach return point" in messages
    assert [len(ring) for ring in world.fences] == [4, 64]
    assert all(x * x + y * y <= 800**2 + 1e-6 for x, y in world.fences[1])
    assert [obstacle.name for obstacle in world.known] == ["exclusion 1"]


def test_headings_and_halves_of_positions_are_named() -> None:
    turned, half = simple(47.001, 8.001), simple(None, 8.002)
    turned["params"][3] = 45
    items = [simple(47.001, 8.0), turned, half]
    with pytest.warns(MissionWarning) as told:
        mission = loaded(plan(mission={**plan()["mission"], "items": items}))
    assert [str(one.message).split(": ", 1)[1].split(" (")[0] for one in told] == [
        "item 2: way point with a heading", "item 3: way point with half a position: left out",
    ]  # fmt: skip
    assert len(mission.route.via) == 1


def test_a_return_from_above_a_terrain_is_no_item_without_an_altitude() -> None:
    items = [{**simple(47.001, 8.0), "frame": 10}, simple(0, 0, command=20)]
    with pytest.warns(MissionWarning) as told:
        loaded(plan(mission={**plan()["mission"], "items": items}))
    assert ["above terrain" in str(one.message) for one in told] == [True]


def test_a_way_point_outside_the_fence_is_told_by_its_key_in_the_plan() -> None:
    square = [[46.999, 7.999], [46.999, 8.0005], [47.002, 8.0005], [47.002, 7.999]]
    data = plan(geoFence={"polygons": [{"polygon": square, "inclusion": True}]})
    with pytest.raises(MissionError, match=r"x.plan: mission.items\[1\]: .* outside fence"):
        loaded(data)


def test_a_syntax_error_has_its_line(tmp_path: Path) -> None:
    file = tmp_path / "x.plan"
    file.write_text('{\n  "fileType": "Plan",,\n}')
    with pytest.raises(MissionError, match=r"x.plan:2:\d+: is not JSON"):
        load(file)


def test_all_faults_of_a_plan_come_at_once() -> None:
    data = plan()
    data["mission"]["items"] = [5, {"command": "go"}, simple(47.0, 8.0) | {"params": [1, 2]}]
    with pytest.raises(MissionError) as caught:
        loaded(data)
    keys = [fault.key for fault in caught.value.faults]
    assert "mission.items[0]" in keys
    assert "mission.items[1].command" in keys
    assert "mission.items[2].params" in keys


def test_the_older_json_files_are_read() -> None:
    items = [
        {"command": 16, "frame": 3, "coordinate": [47.0, 8.0, 9], "params": [4, 0, 0, 0]},
        {"command": 16, "frame": 3, "coordinate": [47.001, 8.0, 9], "param1": 3},
    ]
    mission = loaded({"items": items, "plannedHomePosition": {"coordinate": [46.9999, 8.0, 0]}})
    assert [via.dwell_s for via in mission.route.via] == [4]
    assert mission.route.goal.dwell_s == 3


def test_other_files_are_refused_with_a_list_of_what_is_understood(tmp_path: Path) -> None:
    file = tmp_path / "x.kml"
    file.write_text("<kml/>")
    with pytest.raises(MissionError, match=r"\.yaml, \.yml.*\.plan.*QGC WPL 110"):
        load(file)
    file.write_text("")
    with pytest.raises(MissionError, match="is empty"):
        load(file)


junk = st.recursive(
    st.none() | st.booleans() | st.integers(-200, 6000) | st.floats() | st.text(max_size=4),
    lambda inner: st.lists(inner, max_size=7) | st.dictionaries(st.text(max_size=2), inner),
    max_leaves=6,
)


def paths(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    items = value.items() if isinstance(value, dict) else ()
    items = enumerate(value) if isinstance(value, list) else items
    return [path] * bool(path) + [deep for key, x in items for deep in paths(x, (*path, key))]


@settings(deadline=None, max_examples=300)
@given(data=st.data())
def test_any_plan_is_a_mission_or_a_mission_error(data: st.DataObject) -> None:
    fence = {
        "polygons": [
            {"polygon": [[47.01, 8.01], [47.01, 8.02], [47.02, 8.02]], "inclusion": False}
        ],
        "circles": [{"circle": {"center": [47.0, 8.0], "radius": 8000}, "inclusion": True}],
    }
    spoiled = plan(geoFence=fence)
    *parents, last = data.draw(st.sampled_from(paths(spoiled)))
    node: Any = spoiled
    for part in parents:
        node = node[part]
    node[last] = data.draw(junk)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissionWarning)
        try:
            mission = loaded(spoiled)
        except MissionError:
            return
    assert mission.route.start.at
