"""How far along its path a robot with a lidar knows that it can go.

Tested through ``robot/replanning/test_sight_limit``.
"""

from __future__ import annotations

import math

from viaspline.curve.path import Path
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.perception.belief import Belief


def certain_until(
    belief: Belief | None,
    distance: float,
    schedule: Schedule,
    path: Path,
    required: float,
    shared: float,
) -> float:
    """How far along a path the robot can go for certain [m].

    Without a lidar it trusts what it knows, and that is to the end.

    Args:
        belief: What its lidar has shown; None without one.
        distance: Where it is along the path [m].
        schedule: What it means to do.
        path: What is asked about.
        required: Distance that is kept from everything [m].
        shared: Up to this distance the path is the schedule's own [m].
    """
    if belief is None:
        return path.length
    sighted = sighted_until(belief, distance, schedule, path, required, shared)
    for start, end, floor in schedule.kept(distance, sighted, required):
        clear = belief.clear_until(path, start, end, floor)
        if clear < end:
            return clear
    return sighted


def sighted_until(
    belief: Belief,
    distance: float,
    schedule: Schedule,
    path: Path,
    required: float,
    shared: float = math.inf,
) -> float:
    """How far along a path the robot has seen where its body will be [m].

    Args:
        belief: What its lidar has shown.
        distance: Where it is along the path [m].
        schedule: What it means to do, and how far it had seen.
        path: What is asked about.
        required: Distance that is kept from everything [m].
        shared: Up to this distance the path is the schedule's own [m].
    """
    end = min(distance + belief.lookahead, path.length)
    floor = min(floor for _, _, floor in schedule.kept(distance, end, required))
    start = max(distance, min(schedule.sighted_until, shared))
    return belief.seen_until(path, start, end, floor)
