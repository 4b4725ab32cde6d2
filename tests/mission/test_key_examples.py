"""Every key has an example, and every example is read by the very reader of missions."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import viaspline as vs
from viaspline.mission.fleet.file_schema import file_schema
from viaspline.mission.value import Value

EXAMPLES = Path(__file__).parents[2] / "examples"
ROUTE = {"start": [0, 0], "goal": [40, 0]}
FLOWN = {"start": [0, 0, 20], "goal": [40, 0, 20]}
FAR = {"start": [-500, -500], "goal": [-400, -500]}
HIGH = {"start": [-500, -500, 90], "goal": [-400, -500, 90]}
GROUND = {"ground": {"flat_m": 0}}
Wrap = Callable[[Any], dict[str, Any]]


def robot(key: str) -> Wrap:
    return lambda said: {"robot": {key: said}, "route": ROUTE}


def world(key: str, route: Any = ROUTE) -> Wrap:
    return lambda said: {"world": {key: said}, "route": route}


def shape(key: str, route: Any = FAR) -> Wrap:
    return lambda said: {"world": {"known": [{key: said}]}, "route": route}


def drive(key: str) -> Wrap:
    return lambda said: {"robot": {"drive": {key: said}}, "route": ROUTE}


def as_obstacle(said: Any) -> dict[str, Any]:
    solid = {"ball", "box", "voxels", "height_m"} & said.keys()
    return {"world": {"known": [said]}, "route": HIGH if solid else FAR}


def as_route(said: Any) -> dict[str, Any]:
    return {"world": GROUND if "takeoff" in said else {}, "route": said}


def as_point(key: str) -> Wrap:
    def wrap(said: Any) -> dict[str, Any]:
        ends: dict[str, Any] = {"start": [-50, -50], "goal": [60, -50]}
        if not {"agl_m", "gate"} & said.keys():
            return {"route": ends | {key: said}}
        ends = {"start": [-50, -50, 20], "goal": [60, -50, 20]}
        return {"world": GROUND, "route": ends | {key: said}}

    return wrap


def as_via(said: Any) -> dict[str, Any]:
    flies = bool({"agl_m", "gate"} & said.keys())
    ends = {"start": [-50, -50, 20], "goal": [60, -50, 20]} if flies else FAR
    return {"world": GROUND if flies else {}, "route": {**ends, "via": [said]}}


def as_member(said: Any) -> dict[str, Any]:
    return {"robots": {"cart": {"radius_m": 0.4}}, "fleet": [said]}


WRAPS: dict[str, Wrap] = {
    "MissionParts": lambda said: said,
    "FleetParts": lambda said: said,
    "WorldSpec": lambda said: {
        "world": said, "route": {"start": [4, 4, 410], "goal": [12, 4, 410]},
        "robot": {"sensor": {"range_m": 40}},
    },
    "RobotSpec": lambda said: {
        "robot": said, "route": FLOWN if "half_height_m" in said else ROUTE
    },
    "Route": as_route,
    "SplineSpec": lambda said: {"spline": said, "route": ROUTE},
    "MemberSpec": as_member,
    "RosSpec": lambda said: {"ros": said, "route": ROUTE},
    "Obstacle": as_obstacle,
    "MapSpec": lambda said: {
        "world": {"known": [said]},
        "route": HIGH if "height_m" in said else {"start": [2, 2], "goal": [4, 2]},
    },
    "TracksSpec": lambda said: {"world": {"known": [said]}, "route": FAR},
    "SpeedZone": lambda said: {"world": {"speed_zones": [said]}, "route": ROUTE},
    "AltitudeSpec": lambda said: {"world": {**GROUND, "altitude": said}, "route": FLOWN},
    "GroundSpec": world("ground", {"start": [40, 40, 900], "goal": [60, 40, 900]}),
    "Drive": robot("drive"),
    "Localization": robot("localization"),
    "Sensor": robot("sensor"),
    "MovingThings": lambda said: {
        "robot": {"moving": said, "sensor": {"lidar": {"range_m": 9}}}, "route": ROUTE
    },
    "EndPoint": as_point("start"),
    "ViaPoint": as_via,
    "Corridor": lambda said: {"route": {**ROUTE, "corridor": said}},
    "Takeoff": lambda said: {
        "world": GROUND, "route": {"start": [0, 0], "takeoff": said, "goal": [40, 0, 20]}
    },
    "Landing": lambda said: {"world": GROUND, "route": {"start": [0, 0, 20], "land": said}},
    "FixedYaw": lambda said: {"world": GROUND, "route": {**FLOWN, "yaw": said}},
    "Circle": shape("circle"),
    "Capsule": shape("capsule"),
    "Ball": shape("ball", HIGH),
    "Box": shape("box", HIGH),
    "VoxelSpec": shape("voxels", HIGH),
    "Motion": lambda said: {
        "world": {"known": [{"circle": {"center": [0, 0], "radius": 1}, "motion": said}]},
        "route": FAR,
    },
    "MotionError": lambda said: {
        "world": {"known": [{
            "circle": {"center": [0, 0], "radius": 1},
            "motion": {"from": [1, 2], "velocity_mps": [1, 0], "error": said},
        }]},
        "route": FAR,
    },
    "Differential": drive("differential"),
    "Ackermann": drive("ackermann"),
    "SkidSteer": drive("skid_steer"),
    "Omnidirectional": drive("omnidirectional"),
    "Lidar": lambda said: {"robot": {"sensor": {"lidar": said}}, "route": ROUTE},
    "GateSpec": lambda said: as_via({"gate": said}),
}  # fmt: skip


def kinds(of: type[Value] = Value) -> Iterator[type[Value]]:
    """The classes that say examples of their own."""
    for one in of.__subclasses__():
        if one.__module__.startswith("viaspline") and "examples" in one.key_rules:
            above = [base for base in one.__mro__[1:] if base in WITH]
            if not above or one.key_rules["examples"] != above[0].key_rules.get("examples"):
                WITH.append(one)
                yield one
        yield from kinds(one)


WITH: list[type[Value]] = []
SAID = [(one.__name__, said) for one in kinds() for said in one.key_rules["examples"]]


def test_every_key_of_a_file_has_an_example() -> None:
    schema = file_schema()
    parts = {"a file": schema, **schema["$defs"]}
    lacking = [
        f"{name}.{key}"
        for name, part in parts.items()
        for key, said in part.get("properties", {}).items()
        if not said.get("examples")
    ]
    assert lacking == ["EndPoint.gate"]  # which is refused: a route ends behind its last gate
    assert {name for name, _ in SAID} == WRAPS.keys()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with all files that examples name."""
    root = tmp_path_factory.mktemp("files")
    for name in ("maps", "tracks"):
        (root / name).symlink_to(EXAMPLES / name)
    ring = [[9, 9], [19, 9], [19, 19], [9, 9]]
    (root / "site.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [ring]}))
    svg = '<svg xmlns="http://www.w3.org/2000/svg"><rect x="9" y="9" width="4" height="4"/></svg>'
    (root / "site.svg").write_text(svg)
    # Of an OctoMap's sixteen levels each has one node, whose first child is the next one; the last
    # has one free cube and one blocked.
    nodes = [3 << (14 if level == 12 else 0) for level in range(15)] + [0b1001]
    data = b"".join(node.to_bytes(2, "little") for node in nodes)
    head = f"# Octomap OcTree binary file\nid OcTree\nsize {len(nodes) + 2}\nres 0.5\ndata\n"
    (root / "site.bt").write_bytes(head.encode() + data)
    (root / "track.csv").write_text("0, 0, 2, 2\n40, 0, 2, 2\n")
    (root / "r2.yaml").write_text("route: {start: [0, 20], goal: [9, 20]}\n")
    return root


@pytest.mark.parametrize(
    ("name", "said"), SAID, ids=[f"{name}-{k}" for k, (name, _) in enumerate(SAID)]
)
def test_every_example_is_read(name: str, said: Any, folder: Path) -> None:
    file = folder / "asked.yaml"
    file.write_text(json.dumps(WRAPS[name](said)))  # which is YAML, too
    vs.load(file)
