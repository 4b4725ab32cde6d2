"""Routes of strange missions in space; see ``strange_flights.py``."""

from __future__ import annotations

import math
from typing import Any

import numpy as np


def route_of(draws: Any, points: np.ndarray, room: float) -> dict[str, Any]:
    """A route through places (n, 3) [m]: how it begins, what it looks at, how it ends."""
    is_, rng = draws._is, draws.rng
    has_ground = draws.flat is not None or draws.terrain is not None
    places = [_place(draws, point, room, may_be_gate=0 < k < len(points) - 1, at=k, points=points)
              for k, point in enumerate(points)]  # fmt: skip
    route: dict[str, Any] = {"start": places[0]}
    if draws.kind == "patrol" or is_(0.1):
        route |= {"via": places[1:], "closed": True}
        if is_(0.6):
            route["laps"] = int(rng.integers(1, 4))
    elif has_ground and is_(0.5):
        x, y = points[-1, :2].tolist()
        route |= {"via": places[1:-1] or places[1:], "land": {"at": [x, y]}}
        if len(places) == 2:
            route["via"] = []
    else:
        route |= {"via": places[1:-1], "goal": places[-1]}
    if has_ground and is_(0.5):
        x, y, z = points[0].tolist()
        route["takeoff"] = {"to_agl_m": round(z - _true_ground(draws, x, y), 2)}
        route["start"] = {"at": [x, y], **{k: places[0][k] for k in ("dwell_s",) if k in places[0]}}
    route["optimise"] = "time" if is_(0.7) else "length"
    if is_(0.1) and not any("gate" in place for place in places):
        route["order"] = "shortest"
    chance = rng.random()
    if chance < 0.2:
        route["yaw"] = {"fixed_deg": draws._within(-180, 180)}
    elif chance < 0.4:
        x, y = rng.uniform(0, 60, 2)
        route["yaw"] = {"to": np.round([x, y, 5.0], 2).tolist()}
    elif chance < 0.5:
        route["yaw"] = "along"
    if draws.kind in ("moving", "hidden"):
        if is_(0.3):
            route["depart_s"] = draws._within(0, 20)
        if is_(0.3):
            route["hold_s"] = draws._within(0, 10)
    return route


def _true_ground(draws: Any, x: float, y: float) -> float:
    """The bilinear ground at a place [m]."""
    if draws.terrain is None:
        return float(draws.flat or 0.0)
    u, v = (x + 20) / 5.0, (y + 20) / 5.0
    i, j = int(u), int(v)
    a, b, h = u - i, v - j, draws.terrain
    low = (1 - a) * h[j, i] + a * h[j, i + 1]
    return float((1 - b) * low + b * ((1 - a) * h[j + 1, i] + a * h[j + 1, i + 1]))


def _place(
    draws: Any, point: np.ndarray, room: float, *, may_be_gate: bool, at: int, points: np.ndarray
) -> dict[str, Any]:
    x, y, z = point.tolist()
    gates = 0.7 if draws.kind == "gates" else 0.05
    if may_be_gate and draws._is(gates):
        before, behind = points[at - 1, :2], points[at + 1, :2]
        way = behind - before
        facing = math.degrees(math.atan2(way[1], way[0])) + float(draws.rng.uniform(-60, 60))
        side = round(2 * room + 0.5, 2)
        facing_deg = round(facing, 1)
        gate = {"at": [x, y, z], "facing_deg": facing_deg, "width_m": side, "height_m": side}
        return {"gate": gate}
    has_ground = draws.flat is not None or draws.terrain is not None
    place: dict[str, Any] = {"at": [x, y, z]}
    if has_ground and draws._is(0.4):
        place = {"at": [x, y], "agl_m": round(z - _true_ground(draws, x, y), 2)}
    if draws._is(0.25):
        place["dwell_s"] = draws._within(0.5, 5)
    if draws._is(0.3):
        u, v = draws.rng.uniform(0, 60, 2)
        place["look_at"] = np.round([u, v, z - 2], 2).tolist()
    return place
