"""On which sides a path in space passes things, by where its samples cross their gates.

A gate is the upright plane through a thing's middle, across the leg (``docs/space.md``).
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from strange_flight_oracle import AskedFlight, Faults
from strange_oracle import polygon_of

HAIR_M = 1e-3
SIDES = ("left", "right", "over", "under")


def side_faults(
    asked: AskedFlight, plan: dict[str, Any], places: np.ndarray, of: np.ndarray
) -> Faults:
    """Crossings on a side that isn't allowed."""
    through = [via for via in plan["path"]["vias"] if via["kind"] == "user"]
    near = 2.0 * (asked.robot.get("radius_m", 0.5) + asked.robot["clearance_m"])
    for one in asked.things(("known",), moving=False):
        allowed = (one["pass_on"],) if "pass_on" in one else SIDES
        if "never_pass_on" in one:
            allowed = tuple(side for side in SIDES if side != one["never_pass_on"])
        if allowed == SIDES:
            continue
        shape, low, high = plan_of(one)
        box = shape.bounds
        middle = np.array([0.5 * (box[0] + box[2]), 0.5 * (box[1] + box[3])])
        for begin, end in pairwise(through):
            leg = np.subtract(end["at"][:2], begin["at"][:2])
            if np.hypot(*leg) < 1e-9:
                continue
            straight = shapely.LineString([begin["at"][:2], end["at"][:2]])
            if straight.distance(shape) > 0.95 * near:
                continue
            ahead = leg / np.hypot(*leg)
            part = places[(of >= round(begin["u"])) & (of < round(end["u"]))]
            for at in crossings(part, middle, ahead):
                if (side := side_at(one, shape, middle, ahead, (low, high), at)) not in (
                    *allowed, None):  # fmt: skip
                    yield "side", f"{one['name']} is passed {side} at {at}, not {allowed}"


def plan_of(one: dict[str, Any]) -> tuple[Any, float, float]:
    """What a solid covers in plan, and its heights [m]."""
    if ball := one.get("ball"):
        x, y, z = ball["center"]
        return (
            shapely.Point(x, y).buffer(ball["radius"], 64),
            z - ball["radius"],
            z + ball["radius"],
        )
    if box := one.get("box"):
        from shapely.affinity import rotate

        (x0, y0, z0), (x1, y1, z1) = box["min"], box["max"]
        return rotate(shapely.box(x0, y0, x1, y1), box.get("yaw_deg", 0.0), "center"), z0, z1
    if (capsule := one.get("capsule")) and len(capsule["from"]) == 3:
        a, b, r = np.array(capsule["from"]), np.array(capsule["to"]), capsule["radius"]
        line = shapely.LineString([a[:2], b[:2]])
        return line.buffer(r, 64), min(a[2], b[2]) - r, max(a[2], b[2]) + r
    core, radius = polygon_of(one)
    low, high = one.get("height_m", (-np.inf, np.inf))
    return core.buffer(radius, 64) if radius else core, low, high


def crossings(part: np.ndarray, middle: np.ndarray, ahead: np.ndarray) -> np.ndarray:
    """Where samples go through an upright plane (n, 3)."""
    before = (part[:, :2] - middle) @ ahead
    k = np.flatnonzero(before[1:] * before[:-1] < 0)
    share = (before[k] / (before[k] - before[k + 1]))[:, None]
    return part[k] + share * (part[k + 1] - part[k])


def side_at(
    one: dict[str, Any], shape: Any, middle: np.ndarray, ahead: np.ndarray,
    heights: tuple[float, float], at: np.ndarray,
) -> str | None:  # fmt: skip
    """The side of a thing on which a place of its gate lies; None where that is a near thing."""
    left = np.array([-ahead[1], ahead[0]])
    line = shapely.LineString([middle - 500 * left, middle + 500 * left])
    low, high = heights
    section = shapely.get_coordinates(shape.intersection(line))
    if (capsule := one.get("capsule")) and len(capsule["from"]) == 3:
        share = np.linspace(0, 1, 20001)[:, None]
        points = np.array(capsule["from"]) * (1 - share) + share * np.array(capsule["to"])
        radius = capsule["radius"]
        points = points[np.abs((points[:, :2] - middle) @ ahead) <= radius]
        section = points[:, :2]
        low, high = points[:, 2].min() - radius, points[:, 2].max() + radius
        spread = radius
    else:
        spread = 0.0
    across = (section - middle) @ left
    here = float((at[:2] - middle) @ left)
    least, most = across.min() - spread, across.max() + spread
    if here > most + 0.05:
        return "left"
    if here < least - 0.05:
        return "right"
    if here > most - 0.05 or here < least + 0.05:
        return None
    center = low if low == -np.inf else high if high == np.inf else 0.5 * (low + high)
    if abs(at[2] - center) < 0.05:
        return None
    return "over" if at[2] > center else "under"
