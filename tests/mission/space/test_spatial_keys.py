"""What makes a mission one in space, and how its keys are read and written."""

from typing import Any

import pytest

from viaspline.errors import GeometryError, MissionError
from viaspline.formats.mission_yaml import yaml_text
from viaspline.formats.yaml_document import yaml_document
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.planner import plan
from viaspline.world.world import World


def mission(**changes: Any) -> dict[str, Any]:
    route = {"start": [0, 0, 10], "goal": [90, 0, 10]}
    data: dict[str, Any] = {"world": {}, "robot": {}, "route": route}
    for path, value in changes.items():
        part, _, key = path.partition("__")
        data[part] = {**data[part], key: value}
    return data


FLAT = {"flat_m": 0}
GATE = {"at": [40, 0, 10], "facing_deg": 0, "width_m": 5, "height_m": 4}
SPATIAL: list[dict[str, Any]] = [
    {"world__altitude": {"max_m": 120}},
    {"world__ground": FLAT},
    {"world__known": [{"circle": {"center": [40, 40], "radius": 2}, "height_m": [0, 9]}]},
    {"world__known": [{"ball": {"center": [40, 40, 4], "radius": 2}}]},
    {"world__known": [{"box": {"min": [40, 40, 4], "max": [41, 41, 5]}}]},
    {"world__known": [{"capsule": {"from": [40, 40, 4], "to": [50, 40, 4], "radius": 1}}]},
    {
        "world__known": [
            {"ball": {"center": [40, 40, 5], "radius": 2}, "pass_on": "over", "name": "tank"}
        ]
    },
    {
        "world__unseen": [{"ball": {"center": [40, 40, 4], "radius": 2}}],
        "robot__sensor": {"range_m": 40},
    },
    {"robot__half_height_m": 0.2},
    {"robot__max_climb_mps": 2.5},
    {"robot__max_descent_mps": 1.5},
    {"robot__max_vertical_accel_mps2": 1},
    {"world__ground": FLAT, "route__via": [{"at": [40, 0], "agl_m": 10}]},
    {"route__via": [{"at": [40, 0, 9], "look_at": [40, 9, 0]}]},
    {"route__via": [{"gate": GATE}]},
    {"route__takeoff": {"to_agl_m": 12}},
    {"route__goal": None, "route__land": {"at": [90, 0]}},
    {"route__yaw": "along"},
    {"route__yaw": {"fixed_deg": 90}},
    {"route__yaw": {"to": [0, 50, 5]}},
]


@pytest.mark.parametrize("changes", SPATIAL, ids=lambda changes: next(iter(changes)))
def test_each_key_of_space_makes_a_mission_one_in_space(changes: dict[str, Any]) -> None:
    assert Mission.model_validate(mission(**changes)).is_spatial


@pytest.mark.parametrize("changes", SPATIAL, ids=lambda changes: next(iter(changes)))
def test_a_mission_in_space_is_the_same_when_it_was_written(changes: dict[str, Any]) -> None:
    there = Mission.model_validate(mission(**changes))
    text = yaml_text(there)
    assert Mission.model_validate(yaml_document(text, "x.yaml").data) == there
    assert Mission.model_validate(there.model_dump(by_alias=True)) == there


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"route__start": [0, 0], "route__goal": [90, 0]},
        {"robot__max_yaw_rate_dps": 60},
        {"world__known": [{"circle": {"center": [40, 40], "radius": 2}, "pass_on": "left"}]},
    ],
)
def test_heights_of_via_points_alone_leave_a_mission_in_the_plane(changes: dict[str, Any]) -> None:
    assert not Mission.model_validate(mission(**changes)).is_spatial


def test_a_yaw_rate_has_two_names_and_one_place() -> None:
    there = Mission.model_validate(mission(robot__max_yaw_rate_dps=60))
    assert there == Mission.model_validate(mission(robot__max_yaw_rate_degps=60))
    assert there.robot.max_yaw_rate_degps == 60
    assert "max_yaw_rate_dps" not in yaml_text(there)
    twice = mission(robot__max_yaw_rate_dps=60, robot__max_yaw_rate_degps=60)
    with pytest.raises(MissionError, match="which exclude each other"):
        Mission.model_validate(twice)


def test_a_gate_says_its_place_once() -> None:
    there = Mission.model_validate(mission(route__via=[{"gate": GATE, "name": "door"}]))
    assert there.route.via[0].at == (40, 0, 10)
    assert yaml_text(there).count("[40, 0, 10]") == 1
    elsewhere = mission(route__via=[{"at": [41, 0, 10], "gate": GATE}])
    with pytest.raises(MissionError, match=r"via\[0\].at: has at and gate"):
        Mission.model_validate(elsewhere)
    wrong = mission(route__via=[{"gate": {**GATE, "at": [40, 0]}}])
    with pytest.raises(MissionError) as caught:
        Mission.model_validate(wrong)
    (fault,) = caught.value.faults
    assert fault.key == "route.via[0].gate.at"


def test_a_mission_in_space_has_no_flat_world() -> None:
    there = Mission.model_validate(mission(route__yaw="along"))
    with pytest.raises(GeometryError, match="flat"):
        World.known(there)
    with pytest.raises(GeometryError, match="one in space"):
        plan(there)


def test_a_copy_with_other_parts_is_asked_anew() -> None:
    flat = Mission.model_validate(mission())
    assert not flat.is_spatial
    drone = RobotSpec(half_height_m=0.2)
    assert flat.model_copy(update={"robot": drone}).is_spatial
