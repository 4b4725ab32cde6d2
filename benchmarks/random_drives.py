"""Random drives of every kind of robot, among obstacles of which it knows a part."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator

import numpy as np

import viaspline as vs

FIELD_M = 36.0
"""Side of the square in which they drive."""

ROBOTS: dict[str, dict] = {
    "point": {"radius_m": 0.0, "clearance_m": 0.3},
    "radius": {"radius_m": 0.4, "clearance_m": 0.3},
    "turning circle": {"radius_m": 0.4, "clearance_m": 0.3, "min_turn_radius_m": 1.5},
    "differential": {
        "radius_m": 0.35, "clearance_m": 0.25, "max_lateral_accel_mps2": 0.8,
        "drive": {"differential": {"track_m": 0.5, "max_wheel_speed_mps": 2}, "delay_s": 0.1,
                  "lag_s": 0.1},
    },
    "omnidirectional": {
        "radius_m": 0.4, "clearance_m": 0.2,
        "drive": {"omnidirectional": {"max_speed_along_mps": 1.5, "max_speed_across_mps": 1.0},
                  "delay_s": 0.05, "lag_s": 0.1},
    },
    "steered": {
        "radius_m": 0.5, "clearance_m": 0.3, "max_lateral_accel_mps2": 0.8,
        "drive": {"ackermann": {"wheelbase_m": 1, "max_steer_deg": 32}, "delay_s": 0.1,
                  "lag_s": 0.1},
    },
    "footprint": {
        "footprint": [[-0.4, -0.3], [0.8, -0.3], [0.8, 0.3], [-0.4, 0.3]], "clearance_m": 0.15,
    },
    "footprint, differential": {
        "footprint": [[-0.35, -0.25], [0.35, -0.25], [0.35, 0.25], [-0.35, 0.25]],
        "clearance_m": 0.1, "max_lateral_accel_mps2": 0.6,
        "drive": {"differential": {"track_m": 0.4, "max_wheel_speed_mps": 2}, "delay_s": 0.1,
                  "lag_s": 0.1},
    },
    "footprint, steered": {
        "footprint": [[-0.3, -0.35], [1.2, -0.35], [1.2, 0.35], [-0.3, 0.35]], "clearance_m": 0.15,
        "drive": {"ackermann": {"wheelbase_m": 1, "max_steer_deg": 32}, "delay_s": 0.1,
                  "lag_s": 0.1},
    },
}  # fmt: skip
"""By family: the body, the drive and its limits."""


def drives(count: int, seed: int, parts: Collection[str] = ()) -> Iterator[tuple[str, vs.Mission]]:
    """So many random drives that have a plan, the families in turn.

    Args:
        count: How many.
        seed: Of all that is random.
        parts: What all of them have besides; see ``with_parts``.

    Yields:
        The family, and the mission.
    """
    families = list(ROBOTS)
    for k in range(count):
        family = families[k % len(families)]
        mission = _mission(family, np.random.default_rng((seed, k)))
        yield family, with_parts(mission, parts, np.random.default_rng((seed, k, 77)))


def with_parts(
    mission: vs.Mission, parts: Collection[str], random: np.random.Generator
) -> vs.Mission:
    """A drive with parts that few have: a ``lidar``, a limit of the ``jerk``, ``yaw`` limits,
    speed ``zones``; the same where there are none.

    With any, there is a limit of the jerk only if it is among them.
    """
    if not parts:
        return mission
    data = mission.model_dump(exclude_none=True, exclude_defaults=True, mode="json")
    robot = data["robot"]
    robot.pop("max_jerk_mps3", None)
    if "lidar" in parts:
        reach, fov = float(random.uniform(3, 8)), float(random.choice([120.0, 270, 360]))
        robot["sensor"] = {"lidar": {"range_m": reach, "fov_deg": fov}}
    if "jerk" in parts:
        robot["max_jerk_mps3"] = float(random.uniform(0.5, 3))
    if "yaw" in parts:
        for key in ("max_yaw_rate_degps", "max_yaw_accel_degps2"):
            robot[key] = float(random.uniform(20, 90))
    if "zones" in parts:
        data["world"]["speed_zones"] = [_random_zone(random) for _ in range(6)]
    return vs.Mission.model_validate(data)


def _random_zone(random: np.random.Generator) -> dict:
    middle, size = random.uniform(0, FIELD_M, 2), random.uniform(2, 8, 2)
    corners = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
    polygon = [(middle + size * corner).tolist() for corner in corners]
    return {"polygon": polygon, "max_speed_mps": float(random.uniform(0.3, 0.8))}


def _mission(family: str, random: np.random.Generator) -> vs.Mission:
    robot = {"max_speed_mps": float(random.uniform(0.8, 2.0)), "max_accel_mps2": 1.0}
    robot |= ROBOTS[family]
    if random.random() < 0.5:
        robot["sensor"] = {"range_m": float(random.uniform(2, 8))}
    else:
        fov = float(random.choice([120, 270, 360]))
        robot["sensor"] = {"lidar": {"range_m": float(random.uniform(3, 8)), "fov_deg": fov}}
    if random.random() < 0.25:
        robot["max_jerk_mps3"] = float(random.uniform(0.5, 3))
    body = max((math.hypot(*corner) for corner in robot.get("footprint", ())), default=0.0)
    room = max(body, robot.get("radius_m", 0.0)) + robot["clearance_m"] + 0.5
    points = places_apart(random, int(random.integers(3, 6)), 7.0)
    things = [random_thing(random) for _ in range(int(random.integers(4, 16)))]
    things = [(reach, thing) for reach, at, thing in things
              if np.hypot(*(points - at).T).min() > reach + room]  # fmt: skip
    seen = random.random(len(things)) < 0.5
    vias = [{"at": point.tolist()} for point in points]
    for via in vias[1:]:
        if random.random() < 0.3:
            via["dwell_s"] = 2.0
    start, *rest = vias
    route: dict = {"start": start["at"], "via": rest}
    if random.random() < 0.3:
        route |= {"closed": True, "laps": int(random.integers(1, 4))}
    else:
        route["goal"] = rest.pop()["at"]
    return vs.Mission.model_validate({
        "world": {
            "bounds": [-3, -3, FIELD_M + 3, FIELD_M + 3],
            "known": [thing for (_, thing), known in zip(things, seen, strict=True) if known],
            "unseen": [thing for (_, thing), known in zip(things, seen, strict=True) if not known],
        },
        "robot": robot,
        "route": route,
    })  # fmt: skip


def places_apart(random: np.random.Generator, count: int, least: float) -> np.ndarray:
    """Random places, no two of them nearer than a distance [m]."""
    points = [random.uniform(0, FIELD_M, 2)]
    while len(points) < count:
        point = random.uniform(0, FIELD_M, 2)
        if np.hypot(*(np.array(points) - point).T).min() > least:
            points.append(point)
    return np.array(points)


def random_thing(random: np.random.Generator) -> tuple[float, np.ndarray, dict]:
    """The reach, the place and the shape of an obstacle."""
    at, reach = random.uniform(1, FIELD_M - 1, 2), float(random.uniform(0.3, 3.0))
    if random.random() < 0.5:
        return reach, at, {"circle": {"center": at.tolist(), "radius": reach}}
    angles = np.sort(random.uniform(0, math.tau, int(random.integers(4, 8))))
    if np.diff(angles, append=angles[0] + math.tau).max() > 0.9 * math.pi:
        angles = np.linspace(0, math.tau, 5)[:-1] + random.uniform(0, 1)
    corners = at + reach * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    return reach, at, {"polygon": corners.tolist()}
