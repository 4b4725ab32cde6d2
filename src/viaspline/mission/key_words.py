"""What each key of a mission expects, and which key a mistyped one was meant to be."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from typing import Final

from pydantic import BaseModel

from viaspline.mission.drives.drive import DRIVE_KINDS, Drive
from viaspline.mission.drives.drive_kind import DriveKey, DriveKind
from viaspline.mission.parts import (
    Corridor,
    EndPoint,
    MapSpec,
    MissionParts,
    Route,
    SpeedZone,
    SplineSpec,
    ViaPoint,
    WorldSpec,
)
from viaspline.mission.robot_parts import (
    Lidar,
    Localization,
    RobotSpec,
    Sensor,
)
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.unplaced_faults import Path

_POINT = "[x, y] or [x, y, z] in metres"
_STATION = "[x, y] or {at: [x, y], name: ..., dwell_s: ...}"
_RING = "at least three points [[x, y], [x, y], [x, y]] in metres"
_OBSTACLES = (
    "a list of obstacles such as - circle: {center: [x, y], radius: 5} or - map: depot.yaml"
)
_TENSION = "one number up to 1, a list with one for each span, or auto"


def _of_drives(kinds: Mapping[str, type[DriveKind]]) -> dict[str, str]:
    """What the keys of all drives expect, as each says of its own."""
    expected = {}
    for name, kind in kinds.items():
        example = ", ".join(f"{key}: {value}" for key, value in kind.example.items())
        expected[name] = f"a mapping such as {{{example}}}"
        for key, field in kind.model_fields.items():
            for part in field.metadata:
                if isinstance(part, DriveKey):
                    expected[key] = part.expected
    return expected


EXPECTED: Final[dict[str, str]] = {
    **_of_drives(DRIVE_KINDS),
    "": "a mapping with the keys world, robot, route and spline",
    "world": "a mapping with the keys bounds, fences, known, unseen and speed_zones",
    "bounds": "[x_min, y_min, x_max, y_max] in metres",
    "fences": "a list of polygons, each " + _RING,
    "known": _OBSTACLES,
    "unseen": _OBSTACLES,
    "circle": "{center: [x, y], radius: 5}",
    "center": "[x, y] in metres",
    "radius": "a number of metres greater than 0",
    "polygon": _RING,
    "map": "the path of a map such as depot.yaml",
    "unknown": "blocked or free",
    "resolution_m": "a number of metres greater than 0",
    "holes": "a list of polygons, each " + _RING,
    "name": "a text of at least one letter",
    "pass_on": "left or right",
    "never_pass_on": "left or right",
    "robot": "a mapping such as {radius_m: 0.5, clearance_m: 0.5, max_speed_mps: 2}",
    "radius_m": "a number of metres, 0 or more",
    "clearance_m": "a number of metres, 0 or more",
    "footprint": "at least three corners [[x, y], ...] in metres, x forward and y left",
    "min_turn_radius_m": "a number of metres greater than 0",
    "turn_on_spot": "never, stations or vias",
    "max_speed_mps": "a number of metres per second greater than 0",
    "max_accel_mps2": "a number of m/s² greater than 0",
    "max_lateral_accel_mps2": "a number of m/s² greater than 0",
    "max_brake_mps2": "a number of m/s² greater than 0",
    "max_yaw_rate_degps": "a number of degrees per second greater than 0",
    "max_yaw_accel_degps2": "a number of degrees/s² greater than 0",
    "max_jerk_mps3": "a number of m/s³ greater than 0",
    "drive": "a mapping such as {ackermann: {wheelbase_m: 2.5, max_steer_deg: 35}, delay_s: 0.1}",
    "delay_s": "a number of seconds, 0 to 60",
    "lag_s": "a number of seconds, 0 to 60",
    "speed_noise_mps": "a number of metres per second, 0 or more",
    "yaw_rate_noise_degps": "a number of degrees per second, 0 or more",
    "localization": "a mapping such as {position_noise_m: 0.02, heading_noise_deg: 0.5}",
    "position_noise_m": "a number of metres, 0 or more",
    "heading_noise_deg": "a number of degrees, 0 to 180",
    "tracking_error_m": "a number of metres, 0 or more",
    "sensor": "{range_m: 40} or {lidar: {range_m: 5}}",
    "range_m": "a number of metres greater than 0",
    "lidar": "a mapping such as {range_m: 5, fov_deg: 270, beams: 720, noise_m: 0.01}",
    "fov_deg": "a number of degrees greater than 0, up to 360",
    "beams": "a whole number, 1 or more",
    "noise_m": "a number of metres, 0 or more",
    "route": "a mapping with the keys start, via, goal and closed",
    "start": _STATION,
    "goal": _STATION,
    "via": "a list of points such as [[10, 20], {at: [30, 40], dwell_s: 5}]",
    "at": _POINT,
    "dwell_s": "a number of seconds, 0 or more",
    "heading_deg": "a number of degrees, anticlockwise from x",
    "closed": "true or false",
    "laps": "a whole number, 1 to 1000",
    "corridor": "{left_m: 2, right_m: 2}, or {csv: track.csv} with rows x, y, right, left",
    "left_m": "a number of metres greater than 0",
    "right_m": "a number of metres greater than 0",
    "line": "rows [[x, y, right, left], ...] in metres",
    "csv": "the path of a file with rows x, y, right, left in metres",
    "speed_zones": "a list of zones such as - {polygon: [[x, y], ...], max_speed_mps: 0.5}",
    "spline": "a mapping such as {tension: 0.1}",
    "tension": _TENSION,
    "slack": "one number, 0 or more, or a list with one for each span",
    "knots": "uniform, centripetal or chordal",
    "tangents": "cardinal or continuous",
}

_XY = "[x, y] in metres"
_OBSTACLE = "an obstacle such as {circle: {center: [x, y], radius: 5}}"

_ITEMS: Final[dict[tuple[str, int], str]] = {
    ("via", 1): _STATION,
    ("known", 1): _OBSTACLE,
    ("unseen", 1): _OBSTACLE,
    ("fences", 1): _RING,
    ("fences", 2): _XY,
    ("polygon", 1): _XY,
    ("holes", 1): _RING,
    ("holes", 2): _XY,
    ("speed_zones", 1): "a zone such as {polygon: [[x, y], ...], max_speed_mps: 0.5}",
    ("footprint", 1): _XY,
    ("line", 1): "a row [x, y, right, left] in metres",
    ("tension", 1): "a number up to 1",
    ("slack", 1): "a number, 0 or more",
}
"""What the items of a list, and the items of those, expect."""

_MODELS: Final[dict[str, type[BaseModel]]] = {
    "": MissionParts,
    "world": WorldSpec,
    "known": Obstacle,
    "unseen": Obstacle,
    "circle": Circle,
    "robot": RobotSpec,
    "sensor": Sensor,
    "lidar": Lidar,
    "drive": Drive,
    **DRIVE_KINDS,
    "localization": Localization,
    "speed_zones": SpeedZone,
    "corridor": Corridor,
    "route": Route,
    "start": EndPoint,
    "goal": EndPoint,
    "via": ViaPoint,
    "spline": SplineSpec,
}


def field_of(path: Path) -> str:
    """The last key of a path, without indices; empty for the mission itself."""
    return next((part for part in reversed(path) if isinstance(part, str)), "")


def expectation(path: Path) -> str:
    """What would be right at a path.

    >>> expectation(("robot", "radius_m"))
    'a number of metres, 0 or more'
    """
    field = field_of(path)
    depth = len(path) - 1 - path.index(field) if field in path else 0
    if depth == 0:
        return EXPECTED.get(field, "something else")
    return _ITEMS.get((field, depth), "a number of metres")


def keys_at(path: Path) -> tuple[str, ...]:
    """The keys that the mapping at a path may have."""
    field = field_of(path)
    if field in ("known", "unseen"):
        both = dict.fromkeys((*Obstacle.model_fields, *MapSpec.model_fields))
        return tuple(key for key in both if key != "grid")
    model = _MODELS.get(field)
    return tuple(model.model_fields) if model is not None else ()


def suggestion(key: str, path: Path) -> tuple[str, str | None]:
    """What to do about an unknown key in the mapping at ``path``, and the key that was meant.

    >>> suggestion("raduis", ("world", "known", 0, "circle"))
    ("did you mean 'radius'?", 'radius')
    """
    known = keys_at(path)
    folded = key.strip().lower().replace("-", "_").replace(" ", "_")
    home = [name for name, model in _MODELS.items() if name and folded in model.model_fields]
    if home and folded not in known:
        return f"'{folded}' belongs under {home[0]}", None
    near = difflib.get_close_matches(folded, known, n=1, cutoff=0.6)
    if not near:
        near = [name for name in known if folded and name.startswith(folded)]
    if near:
        return f"did you mean '{near[0]}'?", near[0]
    return "the keys here are " + ", ".join(known), None
