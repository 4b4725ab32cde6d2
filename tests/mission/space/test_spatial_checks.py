"""Every fault that a mission in space can have, at once, with its place and its remedy."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from viaspline.errors import MissionError
from viaspline.formats.load import load
from viaspline.maps.terrain import Terrain
from viaspline.mission.model import Mission
from viaspline.plan_mission import plan
from viaspline.report.summary import summary

FAR = np.abs(np.arange(-50.0, 51.0, 5.0))
STEEP = np.maximum(30.0 - 0.6 * np.maximum(FAR, FAR[:, None]), 0.0)
STEEP[18:, 18:] = np.nan
HILL = Terrain(STEEP, 5.0, (0.0, 0.0))
HALL = {
    "polygon": [[100, 100], [140, 100], [140, 140], [100, 140]],
    "height_m": [0, 35],
    "name": "hall",
}  # fmt: skip
BRIDGE = {"box": {"min": [-20, -5, 12], "max": [20, 5, 14]}, "name": "bridge"}
GATE = {"at": [200, 0, 20], "facing_deg": 0, "width_m": 4, "height_m": 3}


def mission(**changes: Any) -> dict[str, Any]:
    """A sound one: flat ground, a hall, take-off, a via point, landing."""
    data: dict[str, Any] = {
        "world": {
            "bounds": [-50, -50, 500, 500],
            "altitude": {"min_m": 5, "max_m": 120},
            "ground": {"flat_m": 0},
            "known": [HALL],
        },
        "robot": {"radius_m": 0.4, "half_height_m": 0.2, "clearance_m": 1},
        "route": {
            "start": [0, 0],
            "takeoff": {"to_agl_m": 10},
            "via": [{"at": [200, 200], "agl_m": 20}],
            "land": {"at": [350, 250]},
        },
    }
    for path, value in changes.items():
        part, _, key = path.partition("__")
        data[part] = {**data[part], key: value}
        if value is None:
            del data[part][key]
    return data


def faults_of(data: object) -> list[str]:
    with pytest.raises(MissionError) as caught:
        Mission.model_validate(data)
    return [str(fault).removeprefix("<mission>: ") for fault in caught.value.faults]


def test_the_sound_one_is_sound() -> None:
    assert Mission.model_validate(mission()).is_spatial


ONE_FAULT: list[tuple[dict[str, Any], str, str]] = [
    # Heights of points.
    ({"route__via": [[9, 9]]}, "route.via[0].at", "has no height.*at: .9, 9, 10., or agl_m: 10"),
    ({"route__takeoff": None}, "route.start.at", r"has no height.*takeoff: \{to_agl_m: 10\}"),
    ({"route__via": [{"at": [9, 9, 9], "agl_m": 9}]}, "route.via[0].agl_m", "both a z and"),
    ({"world__ground": None}, "route.via[0].agl_m", "the world has none; give world.ground"),
    ({"route__via": [[9, 9, float("nan")]]}, "route.via[0].at[2]", "NaN is not a place"),
    # Ground.
    ({"route__via": [[200, 0, -3]], "world__altitude": None}, "route.via[0].at",
     "the via point lies 3 m under the ground; set its z to 1.2"),
    ({"route__via": [{"at": [200, 0], "agl_m": 0.5}], "world__altitude": None},
     "route.via[0].agl_m", "0.7 m inside the clearance of the ground; set agl_m to 1.2"),
    # Altitude.
    ({"world__altitude": {"min_m": 9, "max_m": 3}}, "world.altitude", "min_m 9 is not less than"),
    ({"route__via": [[200, 0, 130]]}, "route.via[0].at",
     "lies 10 m above the altitude band above home; set its z to 120"),
    ({"route__via": [{"at": [200, 0], "agl_m": 3}]}, "route.via[0].agl_m",
     "lies 2 m below the altitude band above home; set agl_m to 5"),
    ({"route__takeoff": {"to_agl_m": 3}}, "route.takeoff.to_agl_m",
     "2 m below .* set to_agl_m to 5"),
    # Solids.
    ({"route__via": [[120, 120, 20]]}, "route.via[0].at",
     "lies inside obstacle 'hall'; set its z to 36.2"),
    ({"route__via": [[120, 120, 36]]}, "route.via[0].at",
     "0.2 m inside the clearance of obstacle 'hall'; set its z to 36.2"),
    ({"route__via": [[98.7, 120, 20]]}, "route.via[0].at", "0.1 m inside the clearance of obst"),
    ({"world__known": [{**HALL, "height_m": None}], "route__via": [[120, 120, 20]]},
     "route.via[0].at", "inside obstacle 'hall'; move it: there is no height near by"),
    ({"world__known": [{"ball": {"center": [0, 0, 3], "radius": 2}}]}, "route.takeoff",
     r"climb of take-off goes through obstacle world.known\[0\]"),
    ({"world__known": [BRIDGE], "route__takeoff": {"to_agl_m": 13}}, "route.takeoff.to_agl_m",
     "the end of take-off lies inside obstacle 'bridge'"),
    ({"world__known": [BRIDGE], "route__takeoff": {"to_agl_m": 20}}, "route.takeoff",
     "the climb of take-off goes through obstacle 'bridge'"),
    ({"world__known": [{"ball": {"center": [350, 250, 0], "radius": 2}}]}, "route.land.at",
     r"the landing lies inside obstacle world.known\[0\]"),
    ({"route__start": [0, 0, 40]}, "route.takeoff.to_agl_m", "no higher than it begins; give 41"),
    # Walls.
    ({"route__via": [[499, 0, 20]]}, "route.via[0].at", "0.4 m inside the clearance of the bounds"),
    ({"route__land": {"at": [350, 501]}}, "route.land.at", "lies 1 m outside the bounds"),
    # Shapes.
    ({"world__known": [{**HALL, "height_m": [35, 0]}]}, "world.known[0].height_m",
     "floor at 35 isn't below its roof at 0"),
    ({"world__known": [{**HALL, "height_m": [0, float("nan")]}]}, "world.known[0].height_m[1]",
     "NaN is not"),
    ({"world__known": [{**BRIDGE, "height_m": [0, 3]}]}, "world.known[0].height_m",
     "a box has heights of its own"),
    ({"world__known": [{"box": {"min": [90, 9, 9], "max": [91, 8, 10]}}]}, "world.known[0].box.max",
     "y of min is 9, not less"),
    ({"world__known": [{"capsule": {"from": [90, 9, 9], "to": [99, 9], "radius": 1}}]},
     "world.known[0].capsule.to", "2 coordinates, but from has 3"),
    ({"world__known": [{**HALL, "height_m": None, "pass_on": "over"}]}, "world.known[0].pass_on",
     "it has no roof"),
    # Gates.
    ({"route__via": [{"gate": {**GATE, "width_m": 2}}]}, "route.via[0].gate.width_m",
     "2 m wide, and the robot with its clearance 2.8 m; give width_m: 2.8 or more.*at most 0.6"),
    ({"route__via": [{"gate": {**GATE, "height_m": 2}}]}, "route.via[0].gate.height_m",
     "2 m high, and the robot with its clearance 2.4 m"),
    ({"route__via": [{"gate": {**GATE, "facing_deg": 200}}]}, "route.via[0].gate.facing_deg",
     "faces away.*turn it round: facing_deg: 20"),
    ({"route__via": [{"gate": {**GATE, "at": [120, 120, 20]}}]}, "route.via[0].gate.at",
     "the gate lies inside obstacle 'hall'"),
    ({"route__land": None, "route__goal": {"gate": GATE}}, "route.goal.gate", "can't be a gate"),
    ({"route__via": [{"gate": {**GATE, "facing_deg": 200}}],
      "route__order": "shortest"}, "route.via[0].gate.facing_deg", "faces away"),
    # What contradicts.
    ({"route__goal": [9, 9, 9]}, "route.land", "leave out goal"),
    ({"route__closed": True}, "route.land", "a closed route ends at its start"),
    ({"route__via": [[0, 0, 10]]}, "route.via[0].at", "same place as the end of take-off"),
    ({"route__via": [[9, 9, 9], [9, 9, 9]]}, "route.via[1].at", r"same place as route.via\[0\]"),
    ({"route__via": [[9, 9, 9], [9, 0, 9], [0, 0, 10]], "route__order": "shortest"},
     "route.via[2].at", "same place as the end of take-off, and the shortest order"),
    ({"route__via": [[9, 9, 9], [0, 0, 10]], "route__land": None, "route__closed": True},
     "route.via[1].at", "same place as the end of take-off, to which a closed route returns"),
]  # fmt: skip


@pytest.mark.parametrize(("changes", "key", "words"), ONE_FAULT)
def test_each_mistake_is_one_fault_with_its_remedy(
    changes: dict[str, Any], key: str, words: str
) -> None:
    (told,) = faults_of(mission(**changes))
    assert told.startswith(f"{key}: ")
    assert re.search(words, told), told


@pytest.mark.parametrize(
    "route",
    [
        {"route__via": [{"gate": {**GATE, "facing_deg": 180}}, [450, 0, 20]],
         "route__order": "shortest", "route__land": [150, 0]},
        {"route__via": [[300, 9, 20], {"gate": {**GATE, "facing_deg": 0}}],
         "route__land": None, "route__closed": True, "route__start": [250, 0]},
    ],
)  # fmt: skip
def test_a_gate_that_some_order_or_the_way_home_passes_forwards_is_sound(
    route: dict[str, Any],
) -> None:
    Mission.model_validate(mission(**route))


TERRAIN: list[tuple[dict[str, Any], str, str]] = [
    ({"route__start": [90, 90]}, "route.start.at", "takes off from the ground, but nobody knows"),
    ({"route__start": [-9, 0]}, "route.start.at", r"terrain reaches from \(0, 0\) to \(100, 100\)"),
    ({"route__via": [{"at": [90, 90], "agl_m": 9}]}, "route.via[0].at", "counts from the ground"),
    ({"route__land": [90, 90]}, "route.land.at", "it lands on the ground, but nobody knows"),
    ({"route__via": [[90, 90, 40]]}, "route.via[0].at", "where the height of the ground isn't"),
    ({"route__via": [[50, 50, 25]]}, "route.via[0].at",
     "5 m under the ground; set its z to 31.2, or give agl_m: 25 if that is meant above the"),
    # Under the ground's columns, though above the ground itself.
    ({"route__via": [[30, 40, 20]]}, "route.via[0].at", "inside the clearance of the ground"),
]  # fmt: skip


@pytest.mark.parametrize(("changes", "key", "words"), TERRAIN)
def test_a_terrain_with_holes_tells_where_its_heights_lack(
    changes: dict[str, Any], key: str, words: str
) -> None:
    base = {"world__ground": {"terrain": HILL}, "world__altitude": None, "route__land": [60, 20]}
    base["route__via"] = [{"at": [20, 20], "agl_m": 30}]
    base["route__start"] = [25, 75]
    Mission.model_validate(mission(**base))
    (told,) = faults_of(mission(**{**base, **changes}))
    assert told.startswith(f"{key}: ")
    assert re.search(words, told), told


def test_what_nobody_knows_of_the_ground_may_be_taken_for_free() -> None:
    ground = {"terrain": HILL, "nodata": "free"}
    route = {"route__via": [[90, 90, 40]], "route__start": [25, 75], "route__land": [60, 20]}
    Mission.model_validate(mission(world__ground=ground, world__altitude=None, **route))


@pytest.mark.parametrize(("above", "highest"), [("home", 138), ("ground", 114), ("amsl", 120)])
def test_heights_count_from_home_from_the_ground_or_from_its_zero(
    above: str, highest: float
) -> None:
    x = np.arange(0.0, 305.0, 5.0)
    slope = Terrain(np.tile(20.0 - 0.1 * x, (61, 1)), 5.0, (0.0, 0.0))
    changes: dict[str, Any] = {
        "world__ground": {"terrain": slope},
        "world__altitude": {"max_m": 120, "above": above},
        "world__known": [],
        "route__start": [20, 150],
        "route__land": [260, 20],
    }
    Mission.model_validate(mission(**changes, route__via=[[260, 150, highest - 0.01]]))
    (told,) = faults_of(mission(**changes, route__via=[[260, 150, highest + 0.01]]))
    assert "lies 0.01 m above the altitude band" in told


@pytest.mark.parametrize("above", ["ground", "amsl"])
def test_heights_above_a_ground_need_one(above: str) -> None:
    altitude = {"max_m": 120, "above": above}
    told = faults_of(mission(world__ground=None, world__altitude=altitude, route__via=[]))
    assert told[0].startswith("world.altitude.above: ")
    assert len(told) == 1


def test_every_key_of_the_plane_is_told_at_once() -> None:
    data = {
        "robot": {
            "half_height_m": 0.2,
            "drive": {"differential": {"track_m": 0.5}},
            "sensor": {"lidar": {"range_m": 5}},
            "min_turn_radius_m": 2,
            "prefer_clearance_m": 0,
        },
        "route": {
            "start": {"at": [0, 0, 5], "heading_deg": 0},
            "goal": [9, 0, 5],
            "corridor": {"left_m": 2, "right_m": 2},
        },
    }
    told = faults_of(data)
    assert [line.partition(":")[0] for line in told] == [
        "robot.drive",
        "robot.sensor.lidar",
        "robot.min_turn_radius_m",
        "route.start.heading_deg",
        "route.corridor",
    ]
    assert all("for missions in the plane" in line for line in told)


def test_all_faults_come_at_once_with_their_lines(tmp_path: Path) -> None:
    file = tmp_path / "m.yaml"
    file.write_text(
        """world:
  altitude: {min_m: 5, max_m: 120, above: home}
  ground: {flat_m: 0}
  known:
    - {circle: {center: [60, 0], radius: 5}, height_m: [40, 0]}
    - {ball: {center: [90, 0, 20], radius: 5}, name: tank}
    - {box: {min: [1, 2], max: [3, 4, 5]}}
robot: {radius_m: 0.4, half_height_m: 0.2, climb_mps: 2}
route:
  start: [0, 0]
  takeoff: {to_agl: 10}
  via:
    - [30, 0]
    - [90, 0, 22]
    - {at: [30, 30], agl_m: 200}
    - {gate: {at: [40, 40, 20], facing_deg: 0, width_m: 1, height_m: 9}}
  yaw: {to: [3, 4]}
  land: [60, 60]
"""
    )
    with pytest.raises(MissionError) as caught:
        load(file)
    told = [(fault.line, fault.key) for fault in caught.value.faults]
    assert told == [
        (5, "world.known[0].height_m"),
        (7, "world.known[2].box.min"),
        (8, "robot.climb_mps"),
        (11, "route.takeoff.to_agl"),
        (13, "route.via[0].at"),
        (14, "route.via[1].at"),
        (15, "route.via[2].agl_m"),
        (16, "route.via[3].gate.width_m"),
        (17, "route.yaw.to"),
    ]


def test_the_mission_of_the_documentation_is_sound(tmp_path: Path) -> None:
    page = Path(__file__).resolve().parents[3] / "docs" / "space.md"
    piece, moving, sensing = re.findall(r"```yaml\n(.*?)```", page.read_text(), re.DOTALL)
    (tmp_path / "m.yaml").write_text(piece)
    route = {"start": [0, 0, 5], "goal": [9, 0, 5]}
    sees = yaml.safe_load(sensing)
    among = Mission.model_validate({"world": yaml.safe_load(moving), **sees, "route": route})
    assert among.robot.moving is not None
    assert [one.name for one in among.world.moving] == ["hook", "airship"]
    assert among.is_spatial
    mission = load(tmp_path / "m.yaml")
    assert isinstance(mission, Mission)
    assert mission.is_spatial
    told = dict(summary(mission))
    assert "555.0 m from point to point, z 0.2 m to 20 m, takes off, lands" in told["route"]
    assert "flat ground at 0 m, altitude from 5 m up to 120 m above home" in told["world"]


@pytest.mark.parametrize("via", [[], [[10, 3, 9]]])
@pytest.mark.parametrize("end", [{"goal": [20, 0, 5]}, {"land": {"at": [20, 0]}}])
def test_a_leg_to_where_it_lands_has_a_tension_as_one_to_a_goal_has(
    via: list[Any], end: dict[str, Any]
) -> None:
    data: dict[str, Any] = {"route": {"start": [0, 0, 5], "via": via, **end}}
    legs = len(via) + 1
    for count in (1, 2, 3):
        data["spline"] = {"tension": [0.1] * count}
        if count == legs:
            assert plan(Mission.model_validate(data)).certificate.holds
            continue
        with pytest.raises(MissionError, match=f"has {count} values? for {legs} span"):
            Mission.model_validate(data)
