"""The proof that a point of the route is taken for good before the robot can be there.

What stays where it is from a time on, or goes its round over and over, is on a point for good if
it is there then. Before that the point is free for whiles, which are followed by steps that nothing
can be faster than; if none of them is long enough for the stay there, after the first time at which
the robot may have come, there is no drive.

Tested through ``spacetime/test_taken_points``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from viaspline.errors import Change, NoPathError
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
from viaspline.world.moving_obstacles import MovingObstacles

MAX_LOOKS, MAX_WHILES = 20_000, 1_000  # then nothing is said
LEAST_HOLD_S = 0.1  # a shorter while is no remedy


@dataclass(frozen=True)
class _Point:
    """A point of the route that has to be free when the robot is there.

    Attributes:
        name: What it is called.
        at: Where it is [m].
        stay: For how long the robot is there [s].
        soonest: No drive from rest at the start is there sooner [s].
        is_end: Whether the route ends there.
    """

    name: str
    at: tuple[float, ...]
    stay: float
    soonest: float
    is_end: bool = False


def check_points(problem: TimedProblem) -> None:
    """Refuse a point that something stays on for good, if it isn't free for long enough before.

    Raises:
        NoPathError: With what stays there, and for how long the point is free before.
    """
    points = tuple(_points(problem))
    if not points:
        return
    places, times = np.array([one.at for one in points]), np.array([one.soonest for one in points])
    taken: list[tuple[int, float, int]] = []
    for index in range(len(problem.moving)):
        alone = problem.moving.alone(index)
        stands = _stands_from(alone)
        if stands is None:
            continue
        since = np.maximum(times, stands)
        near = np.flatnonzero(alone.distance(places, since) < problem.least)
        for_good = (k for k in near.tolist() if _is_taken(problem, alone, points[k], since[k]))
        taken.extend((k, float(since[k]), index) for k in for_good)
    for k, since_k, index in sorted(taken):
        longest = _longest_while(problem, points[k], since_k)
        if longest is not None:
            raise _refusal(problem, points[k], index, longest)


def _points(problem: TimedProblem) -> Iterator[_Point]:
    """The points of the route after the start, as far as the robot has to be clear there."""
    route, limits = problem.mission.route, problem.limits
    hardest, here = max(limits.max_accel, limits.brake), route.start.at[:2]
    way = stayed = 0.0  # at least, from point to point

    def soonest(stops: bool) -> float:
        speeding = math.sqrt((4.0 if stops else 2.0) * way / hardest)
        return route.depart_s + stayed + max(way / limits.max_speed, speeding)

    for i, via in enumerate(route.via):
        way, here = way + math.dist(here, via.at[:2]), via.at[:2]
        yield _Point(via.name or f"via {i + 1}", here, via.dwell_s, soonest(via.dwell_s > 0.0))
        stayed += via.dwell_s
    if route.goal is not None:
        way += math.dist(here, route.goal.at[:2])
        yield _Point("goal", route.goal.at[:2], route.hold_s, soonest(True), is_end=True)
    elif route.closed:
        way, stayed = route.laps * (way + math.dist(here, route.start.at[:2])), route.laps * stayed
        end = "end of the round"
        stops = not route.is_patrol
        yield _Point(end, route.start.at[:2], route.hold_s, soonest(stops), is_end=True)


def _stands_from(alone: MovingObstacles) -> float | None:
    """From when on something is where it stays [s]; 0: it goes its round; None: it goes away."""
    motion = alone.packed
    if float(motion.rounds[0, 1]) > 0.0:
        return 0.0
    last = motion.pieces[motion.first_piece[1] - 1]
    if np.abs(last[[SPEED_X, SPEED_Y, TURNING]]).max() > 0.0 or last[PRESENT] == 0.0:
        return None
    return float(last[BEGINS])


def _is_taken(problem: TimedProblem, alone: MovingObstacles, point: _Point, since: float) -> bool:
    """Whether something never leaves a point from a time on [s]."""
    until = max(since + float(alone.packed.rounds[0, 1]), math.nextafter(since, math.inf))
    x, y = point.at
    taken = standing_taken(alone.packed, problem.least, x, y, since, until, MAX_LOOKS)
    return bool(taken >= until)


def _refusal(problem: TimedProblem, point: _Point, index: int, longest: float) -> NoPathError:
    """The error that a point is taken.

    Args:
        problem: What is asked.
        point: Of the route.
        index: What stays there.
        longest: For how long it is free at once before, and after the robot may have come [s].
    """
    name, stay = problem.moving.name(index), point.stay
    what = "hold" if point.is_end else "stay"
    key = "route.hold_s" if point.is_end else f"dwell_s of '{point.name}'"
    changes: tuple[Change, ...] = ()
    if longest >= LEAST_HOLD_S:
        least = math.floor(10.0 * longest) / 10.0
        remedy = f"{what} {least:g} s at most ({key}: {least:g})"
        changes = (Change("route.hold_s", least),) if point.is_end else ()
    elif point.is_end:
        what = "goal" if problem.mission.route.goal is not None else "start"
        remedy = f"move the {what}, or take the obstacle off it"
    else:
        remedy = f"move '{point.name}', leave it out, or take '{name}' off it"
    stands = _stands_from(problem.moving.alone(index)) or 0.0
    if point.is_end:
        is_always = stands <= problem.mission.route.depart_s
        when = "always is" if is_always else f"is from {stands:.1f} s on"
        words = f"the {point.name} can't be held for {stay:g} s: '{name}' {when} nearer than"
        too_soon = not is_always and stands <= point.soonest
        late = f", and the robot can't be there before {point.soonest:.1f} s" if too_soon else ""
        return _no_path(f"{words} {problem.least:g} m{late}", point, remedy, name, changes)
    when = f"from {stands:.1f} s on, for good" if stands else "all the time, on its round"
    return _no_path(
        f"'{point.name}' can't be served: '{name}' is nearer than {problem.least:g} m to it "
        f"{when}, and the robot can't be there before {point.soonest:.1f} s",
        point, remedy, name, changes,
    )  # fmt: skip


def _no_path(
    words: str, point: _Point, remedy: str, name: str, changes: tuple[Change, ...]
) -> NoPathError:
    return NoPathError(words, where=point.at, remedy=remedy, obstacles=(name,), changes=changes)


def _longest_while(problem: TimedProblem, point: _Point, end: float) -> float | None:
    """For how long a point is free at once from when the robot may have come up to a time [s].

    None where that is long enough, or not known.
    """
    motion, (x, y) = problem.moving.packed, point.at
    freed = problem.least - JUST_M - 2.0 * TOUCH
    longest, time = 0.0, point.soonest
    for _ in range(MAX_WHILES):
        time = standing_taken(motion, problem.least, x, y, time, end, MAX_LOOKS)
        if time >= end:
            return longest
        until = min(float(standing_conflicts(motion, freed, x, y, time, end)[0]), end)
        longest = max(longest, until - time)
        if longest >= point.stay:
            return None
        time = until
    return None
