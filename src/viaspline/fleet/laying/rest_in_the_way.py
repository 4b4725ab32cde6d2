"""What would help where a robot rests on the path of another: the least change, in words."""

from __future__ import annotations

import numpy as np

from viaspline.fleet.laying.resting_places import RestingPlace
from viaspline.planner import Plan
from viaspline.world.world import World

LOOKS = 64
"""Places on a span that are looked at for the nearest one."""
SPARE_M = 0.1
"""By how much more than it must a robot is to rest aside, and to what its place is rounded [m]."""


def rest_in_the_way(name: str, plan: Plan, rest: RestingPlace, reach: float) -> tuple[str, str]:
    """Why a robot can't get past the place where another rests, and what would let it.

    Args:
        name: The robot.
        plan: Its path.
        rest: The place that the path comes too near to.
        reach: Of the robot that drives the path [m]; see ``PackedCourses``.

    Returns:
        (reason, remedy).

    Example:
        >>> from viaspline.mission.model import Mission
        >>> from viaspline.planner import plan
        >>> path = plan(Mission.model_validate({"route": {"start": [0, 0], "goal": [40, 0]}}))
        >>> why, helps = rest_in_the_way("a", path, RestingPlace("b", "goal", (30, 0.5), 1.0), 1.0)
        >>> why
        "'b' rests at its goal where 'a' has to pass, 30.0 m along its path"
        >>> helps
        "let 'b' leave (rest: leave), or rest 1.6 m farther left, at (30.0, 2.1)"
    """
    path = plan.path
    u = np.linspace(*path.domain, LOOKS * len(path.spans) + 1)
    apart = np.hypot(*(np.asarray(path.evaluate(u))[:, :2] - rest.at).T)
    nearest = float(u[int(apart.argmin())])
    place = np.asarray(path.evaluate(nearest))[:2]
    heading = float(path.heading(nearest))
    left = np.array([-np.sin(heading), np.cos(heading)])
    out = float(left @ (np.array(rest.at) - place))
    side = 1.0 if out >= 0.0 else -1.0
    far = reach + rest.reach + SPARE_M
    words = "left" if side > 0 else "right"
    along = float(path.distance(nearest))
    reason = f"'{rest.robot}' rests at its {rest.kind} where '{name}' has to pass, {along:.1f} m"
    other = place + side * far * left
    is_start = rest.kind != "goal"
    remedy = f"let '{rest.robot}' {'depart sooner' if is_start else 'leave (rest: leave)'}"
    if _has_room(plan.world, other, rest.reach):
        x, y = other.tolist()
        verb = "start" if is_start else "rest"
        aside = far - abs(out)
        remedy += f", or {verb} {aside:.1f} m farther {words}, at ({x:.1f}, {y:.1f})"
    return f"{reason} along its path", remedy


def _has_room(world: World, place: np.ndarray, reach: float) -> bool:
    return bool(world.distance(place) >= reach)
