"""Missions among a few obstacles, as tests of plans write them, and what plans of them keep."""

from collections.abc import Callable
from typing import Any

import numpy as np

import viaspline as vs

Oracle = Callable[..., Any]
BOUNDS = [0, 0, 100, 100]


def disc(x: float, y: float, radius: float, **more: Any) -> dict[str, Any]:
    return {"circle": {"center": [x, y], "radius": radius}, **more}


def mission(
    *stops: Any,
    known: Any = (),
    bounds: Any = None,
    robot: Any = None,
    **more: Any,
) -> vs.Mission:
    world: dict[str, Any] = {"known": list(known)}
    if bounds:
        world["bounds"] = bounds
    route: dict[str, Any] = {"start": stops[0], "via": list(stops[1:-1]), "goal": stops[-1]}
    if more.pop("closed", False):
        route = {"start": stops[0], "via": list(stops[1:]), "closed": True}
    data = {"world": world, "route": route, **more}
    if robot:
        data["robot"] = robot
    return vs.Mission.model_validate(data)


def clear(found: vs.Plan, oracle: Oracle, required: float = 1.0) -> None:
    """The certificate holds, and shapely agrees on a dense sampling of the curve."""
    assert found.certificate.holds
    end = found.path.domain[1]
    points = found.path.evaluate(np.linspace(0, end, int(400 * end) + 1))[:, :2]
    spec = found.mission.world
    least = oracle(points, spec.known, spec.bounds, spec.fences).min()
    assert least >= required - 2e-6
    assert found.certificate.clearance <= least - found.mission.robot.radius_m + 1e-9
