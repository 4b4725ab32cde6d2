"""How soon a robot can be at the end of a path at best: what is later needn't be timed.

Tested through ``robot/yielding/test_soonest_end``.
"""

from __future__ import annotations

import math

from viaspline.curve.path import Path
from viaspline.robot.navigation.law_horizon import reach_ahead
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.trajectory.limits import Limits

ROUNDING_S = 1e-6
"""A law may be said to end so much sooner than it does [s]."""


def soonest_end(context: ReplanContext, path: Path) -> float:
    """No law of a robot under way on a path ends before this [s].

    Args:
        context: The robot under way.
        path: What it would drive; all of what it has driven so far belongs to it.

    Returns:
        Minus infinity where a law may end before the path does, or begin later than now.
    """
    progress, schedule = context.progress, context.schedule
    is_whole = context.knowledge.belief is None and reach_ahead(context.task, schedule) == math.inf
    if not is_whole or schedule.committed_until > progress.time:
        return -math.inf
    left = max(path.length - progress.distance, 0.0)
    return progress.time + least_time(context.task.limits, left, context.speed) - ROUNDING_S


def least_time(limits: Limits, distance: float, speed: float) -> float:
    """The least time for a straight way, to rest at its end [s].

    Args:
        limits: Of speed, acceleration and braking; what bends ask for is left out.
        distance: How long it is [m].
        speed: At its start [m/s].

    Example:
        >>> limits = Limits(max_speed=2, max_accel=1)
        >>> [least_time(limits, *way) for way in ((20.0, 0.0), (1.0, 0.0), (4.0, 2.0))]
        [12.0, 2.0, 3.0]
    """
    accel, brake, top = limits.max_accel, limits.brake, limits.max_speed
    square = (2.0 * accel * brake * distance + brake * speed**2) / (accel + brake)
    peak = min(math.sqrt(square), top)
    if peak <= speed:  # it is as fast as it may be, or can't stop in time
        peak, even = speed, distance - 0.5 * speed**2 / brake
        return distance / max(top, speed) if even < 0.0 else even / max(top, speed) + peak / brake
    even = distance - 0.5 * (peak**2 - speed**2) / accel - 0.5 * peak**2 / brake
    return (peak - speed) / accel + max(even, 0.0) / peak + peak / brake
