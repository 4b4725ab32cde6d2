"""Small missions that lead a robot of a kind through all that may come before it.

Each is planned and driven for what it compiles: a round among known shapes with unseen ones in the
way, a pocket that is deeper than the sensor sees, a field of posts, a way that is closed, things
that cross the way. What moves as is known and a map of cells are in all kinds: a robot that has
neither may still come to search a lattice, of times or of places, in a step.

Tested through ``warming/test_warm_up``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Final

import numpy as np

from viaspline.maps.grid import Grid
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.warming.mission_kind import MissionKind

Parts = dict[str, Any]

ROBOT: Final[Parts] = {"radius_m": 0.3, "clearance_m": 0.1, "max_speed_mps": 1.5}
RANGE: Final[Parts] = {"sensor": {"range_m": 5}}

OF_PART: Final[Mapping[str, Parts]] = {
    "lidar": {"sensor": {"lidar": {"range_m": 4, "fov_deg": 270, "beams": 120, "noise_m": 0.01}}},
    "differential": {"drive": {"differential": {"track_m": 0.5}, "delay_s": 0.1, "lag_s": 0.1}},
    "ackermann": {"drive": {"ackermann": {"wheelbase_m": 0.6, "max_steer_deg": 35}}},
    "skid_steer": {"drive": {"skid_steer": {"track_m": 0.5}, "delay_s": 0.1}},
    "omnidirectional": {
        "drive": {
            "omnidirectional": {"max_speed_along_mps": 1.2, "max_speed_across_mps": 0.8},
            "delay_s": 0.1,
        }
    },
    "localization": {"localization": {"position_noise_m": 0.01}},
    "footprint": {"footprint": [[-0.3, -0.25], [0.5, -0.25], [0.5, 0.25], [-0.3, 0.25]]},
    "turning": {"min_turn_radius_m": 0.9},
    "jerk": {"max_jerk_mps3": 2.0},
    "yaw": {"max_yaw_rate_degps": 60.0, "max_yaw_accel_degps2": 120.0},
    "passive": {"moving": {"max_speed_mps": 1.0}},
}
"""What a robot is that has a part."""


SPLINES: Final[Mapping[str, Parts]] = {
    "curve": {"tension": 0.2, "knots": "uniform", "tangents": "cardinal"},
    "loose": {"tension": -0.5, "tangents": "cardinal"},
}
"""The splines of missions by their names; the others take what a mission has of itself."""

ACROSS: Final[Parts] = {"start": [0, 0], "goal": [12, 0]}


def missions_of(kind: MissionKind) -> Iterator[tuple[str, Mission]]:
    """The missions of one robot of a kind that isn't one in space, each with its name."""
    robot = robot_of(kind)
    for name, world, route in _scenes(kind):
        parts = {"world": world, "robot": robot, "route": route, "spline": SPLINES.get(name)}
        given = {key: value for key, value in parts.items() if value is not None}
        yield name, Mission.model_validate(given)


def robot_of(kind: MissionKind) -> Parts:
    """The robot of a kind; one without a sensor may be told of obstacles as well."""
    robot = ROBOT | RANGE
    for part in kind.parts:
        robot |= OF_PART.get(part, {})
    if "footprint" in kind.parts:
        del robot["radius_m"]
    return robot


def _scenes(kind: MissionKind) -> Iterator[tuple[str, Parts, Parts]]:
    yield "round", _round(kind), _round_route(kind)
    points: Parts = {"start": [0, 0], "via": [[4, 3], [9, -2], [9.5, -2.2]], "goal": [14, 1]}
    for name in SPLINES:
        yield name, {"known": [{"circle": {"center": [7, 4], "radius": 0.5}}]}, points
    yield "pocket", _pocket(), {"start": {"at": [0, 0], "heading_deg": 0}, "goal": [6, 0]}
    crossing = _crossing()
    if "moving" not in kind.parts:
        yield "crossing", {**crossing, "unseen": crossing["known"], "known": []}, ACROSS
    yield "timed", crossing, ACROSS
    yield "posts", _posts(), ACROSS
    yield "map", {"known": [Obstacle(grid=_map())]}, {"start": [1.5, 1.5], "goal": [18, 13]}


def _round(kind: MissionKind) -> Parts:
    known: list[Parts] = [
        {"circle": {"center": [5, 0.2], "radius": 0.8}},
        {"polygon": [[10, 1.5], [12, 1.5], [12, 4], [10, 4]]},
        {"capsule": {"from": [13, -4], "to": [13, -1], "radius": 0.2}},
    ]
    unseen: list[Parts] = [
        {"polygon": [[8, -0.5], [8.6, -0.5], [8.6, 0.7], [8, 0.7]]},
        {"circle": {"center": [15.5, -0.3], "radius": 0.4}},
    ]
    if "moving" in kind.parts:
        known.append(_mover([3, 3], [3, -3], 3.0))
    world: Parts = {"bounds": [-2, -6, 24, 8], "known": known, "unseen": unseen}
    if "zones" in kind.parts:
        yard = {"polygon": [[7, -3], [11, -3], [11, 3], [7, 3]], "max_speed_mps": 0.6}
        world["speed_zones"] = [yard]
    return world


def _mover(first: list[float], last: list[float], start: float) -> Parts:
    frames = [[start, *first], [start + 4.0, *last]]
    return {
        "circle": {"center": [0, 0], "radius": 0.3},
        "motion": {"keyframes": frames, "after": "bounce"},
    }


def _crossing() -> Parts:
    """Somebody who walks to and fro across the way, and a cart that comes along it."""
    walker = _mover([5, 2], [5, -2], 0.0)
    cart: Parts = {
        "polygon": [[-0.4, -0.3], [0.4, -0.3], [0.4, 0.3], [-0.4, 0.3]],
        "motion": {"from": [13, 0.1], "velocity_mps": [-0.4, 0]},
    }
    return {"bounds": [-3, -5, 15, 5], "known": [walker, cart]}


def _round_route(kind: MissionKind) -> Parts:
    route: Parts = {"start": [0, 0], "via": [{"at": [14, 0.5], "dwell_s": 0.5}, [21, 0]]}
    if "laps" in kind.parts:
        return route | {"via": [*route["via"], [12, 6]], "closed": True, "laps": 3}
    if "corridor" in kind.parts:
        route["corridor"] = {"left_m": 3, "right_m": 3}
    return route | {"goal": {"at": [21, 5], "heading_deg": 90}}


def _pocket() -> Parts:
    """Three walls that are seen late, and behind them one that leaves no way."""
    walls = [([-1, 1.2], [3, 1.2]), ([3, 1.2], [3, -1.2]), ([3, -1.2], [-1, -1.2])]
    walls.append(([5, -3], [5, 3]))
    unseen = [{"capsule": {"from": a, "to": b, "radius": 0.1}} for a, b in walls]
    return {"bounds": [-4, -3, 7, 3], "unseen": unseen}


def _posts() -> Parts:
    rng = np.random.default_rng(3)
    centres = rng.uniform([2, -3], [10, 3], (45, 2)).round(2).tolist()
    posts = [{"circle": {"center": centre, "radius": 0.12}} for centre in centres]
    return {"bounds": [-2, -5, 14, 5], "known": posts[:25], "unseen": posts[25:]}


def _map() -> Grid:
    blocked = np.zeros((30, 40), np.bool_)
    blocked[:, [0, -1]] = blocked[[0, -1]] = True
    blocked[8:20, 12:14] = blocked[18:, 24:26] = blocked[3:6, 20:30] = True
    return Grid(blocked, 0.5, (0.0, 0.0, 0.0))
