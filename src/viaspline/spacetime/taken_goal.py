"""The proof that the goal is taken for good before the robot can be there for as long as is asked.

What stays where it is from a time on, or goes its round over and over, is on the goal for good if
it is there then. Before that the goal is free for whiles, which are followed by steps that nothing
can be faster than; if none of them is long enough after the first time at which the robot may have
come, there is no drive.

Tested through ``spacetime/test_plan_among``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.errors import Change, NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.kernels.motion.packed_motion import (
    BEGINS,
    PRESENT,
    SPEED_X,
    SPEED_Y,
    TURNING,
)
from viaspline.kernels.timing.yielding.near_miss import (
    JUST_M,
    TOUCH,
    standing_conflicts,
    standing_taken,
)
from viaspline.spacetime.timed_problem import TimedProblem

MAX_LOOKS, MAX_WHILES = 20_000, 1_000  # then nothing is said
LEAST_HOLD_S = 0.1  # a shorter while is no remedy


def check_goal(problem: TimedProblem) -> None:
    """Refuse a goal that something stays on for good, if it isn't free for long enough before.

    Raises:
        NoPathError: With what stays there, and for how long the goal is free before.
    """
    goal = problem.mission.route.goal
    if goal is None:
        return
    point = np.asarray(goal.at[:2], float)
    begin = problem.mission.route.depart_s + _soonest(problem, point)
    taken = _taken_for_good(problem, point, begin)
    if taken is None:
        return
    since, index = taken
    hold = problem.mission.route.hold_s
    longest = _longest_while(problem, point, begin, since, hold)
    if longest is None:
        return
    name = problem.moving.name(index)
    remedy = "move the goal, or take the obstacle off it"
    changes: tuple[Change, ...] = ()
    if longest >= LEAST_HOLD_S:
        least = math.floor(10.0 * longest) / 10.0
        remedy = f"hold {least:g} s at most (route.hold_s: {least:g})"
        changes = (Change("route.hold_s", least),)
    when = "always is" if since <= begin else f"is from {since:.1f} s on"
    raise NoPathError(
        f"the goal can't be held for {hold:g} s: '{name}' {when} nearer than {problem.least:g} m",
        where=goal.at,
        remedy=remedy,
        obstacles=(name,),
        changes=changes,
    )


def _soonest(problem: TimedProblem, goal: Floats) -> float:
    """No drive from rest at the start comes to rest at the goal in less time [s]."""
    limits = problem.limits
    far = math.dist(problem.mission.route.start.at[:2], goal.tolist())
    hardest = max(limits.max_accel, limits.brake)
    return max(far / limits.max_speed, 2.0 * math.sqrt(far / hardest))


def _taken_for_good(problem: TimedProblem, goal: Floats, begin: float) -> tuple[float, int] | None:
    """From when on something never leaves the goal [s], and what; None: nothing is known to."""
    motion, (x, y) = problem.moving.packed, goal.tolist()
    found: list[tuple[float, int]] = []
    for i in range(len(problem.moving)):
        period = float(motion.rounds[i, 1])
        last = motion.pieces[motion.first_piece[i + 1] - 1]
        since, until = begin, begin + period
        if period == 0.0:
            if np.abs(last[[SPEED_X, SPEED_Y, TURNING]]).max() > 0.0 or last[PRESENT] == 0.0:
                continue
            since = until = max(float(last[BEGINS]), begin)
        alone = problem.moving.alone(i).packed
        until = max(until, math.nextafter(since, math.inf))
        if standing_taken(alone, problem.least, x, y, since, until, MAX_LOOKS) >= until:
            found.append((since, i))
    return min(found, default=None)


def _longest_while(
    problem: TimedProblem, goal: Floats, begin: float, end: float, hold: float
) -> float | None:
    """For how long the goal is free at once from one time to another [s].

    None where that is long enough, or not known.
    """
    motion, (x, y) = problem.moving.packed, goal.tolist()
    freed = problem.least - JUST_M - 2.0 * TOUCH
    longest, time = 0.0, begin
    for _ in range(MAX_WHILES):
        time = standing_taken(motion, problem.least, x, y, time, end, MAX_LOOKS)
        if time >= end:
            return longest
        until = min(float(standing_conflicts(motion, freed, x, y, time, end)[0]), end)
        longest = max(longest, until - time)
        if longest >= hold:
            return None
        time = until
    return None
