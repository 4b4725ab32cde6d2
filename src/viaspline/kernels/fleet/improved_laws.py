"""Better laws for a fleet: take a few away, give them back in another order, keep what is sooner.

Large-neighbourhood search (Shaw 1998; for many robots Li et al., IJCAI 2021). A neighbourhood is a
robot that comes late, those that it lets pass, and a few that let it pass or the like of it. At any
moment the laws of the fleet are whole and clear of each other.

Tested through ``fleet/timing/test_improve_laws``.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.blocked_times import blocked_times
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.yielding_ride import CLEAR, take_law, yielding_ride
from viaspline.kernels.jit import inner, kernel

MOST: Final = 8
"""Robots in a neighbourhood."""
CLOSE_S = 0.5
"""A robot that enters a crossing so soon after another one may have waited for it."""
MULTIPLIER, INCREMENT, MODULUS = 6364136223846793005, 1442695040888963407, 2**31
GAIN_S = 1e-6
"""By less than this nothing gets better: rounding could go round in circles."""


@inner
def _next(state: Ints, below: int) -> int:
    """A number from 0 to ``below`` - 1, the same on every machine."""
    state[0] = state[0] * MULTIPLIER + INCREMENT
    return ((state[0] >> 33) & (MODULUS - 1)) % below


@inner
def _lateness_of(
    courses: PackedCourses, rides: PackedRides, laws: PackedLaws, alone: Floats, robot: int
) -> float:
    """How much later than if it were alone a robot arrives [s]."""
    return laws.arrive[courses.first[robot + 1] - 1] - rides.depart[robot] - alone[robot]


@inner
def _late_robot(
    courses: PackedCourses, rides: PackedRides, laws: PackedLaws, alone: Floats, settled: Flags,
    state: Ints,
) -> int:  # fmt: skip
    """A robot, the later the likelier: the latest of three."""
    count = alone.size
    best, worst = -1, -1.0
    for _ in range(3):
        robot = _next(state, count)
        if laws.is_timed[robot] and not settled[robot]:
            late = _lateness_of(courses, rides, laws, alone, robot)
            if late > worst:
                best, worst = robot, late
    return best


@inner
def _neighbourhood(
    courses: PackedCourses, crossings: PackedCrossings, laws: PackedLaws, settled: Flags,
    robot: int, state: Ints,
) -> Ints:  # fmt: skip
    """A robot, those that it may have waited for, and some that it meets."""
    chosen = np.empty(MOST, np.int64)
    chosen[0] = robot
    count = 1
    begin, end = crossings.box_first[robot], crossings.box_first[robot + 1]
    if begin == end:
        return chosen[:count]
    blocked = blocked_times(courses, crossings, laws, robot)
    most = 2 + _next(state, MOST - 1)
    for b in range(begin, end):
        gap = laws.arrive[crossings.cell[b]] - blocked[b - begin, 1]
        other = crossings.other[b]
        is_close = 0.0 <= gap < CLOSE_S and not settled[other]
        if count < most and is_close and not (chosen[:count] == other).any():
            chosen[count] = other
            count += 1
    for _ in range(most):
        other = crossings.other[begin + _next(state, end - begin)]
        is_free = laws.is_timed[other] and not settled[other]
        if count < most and is_free and not (chosen[:count] == other).any():
            chosen[count] = other
            count += 1
    return chosen[:count]


@inner
def _copied(courses: PackedCourses, laws: PackedLaws, robots: Ints) -> Floats:
    """The laws of some robots, one behind the other, (their nodes, 3)."""
    total = 0
    for robot in robots:
        total += courses.first[robot + 1] - courses.first[robot]
    kept = np.empty((total, 3))
    at = 0
    for robot in robots:
        for node in range(courses.first[robot], courses.first[robot + 1]):
            kept[at, 0], kept[at, 1] = laws.arrive[node], laws.leave[node]
            kept[at, 2] = laws.speed[node]
            at += 1
    return kept


@inner
def _put_back(courses: PackedCourses, laws: PackedLaws, robots: Ints, kept: Floats) -> None:
    """Undo what was done to the laws of some robots."""
    at = 0
    for robot in robots:
        laws.is_timed[robot] = True
        for node in range(courses.first[robot], courses.first[robot + 1]):
            laws.arrive[node], laws.leave[node] = kept[at, 0], kept[at, 1]
            laws.speed[node] = kept[at, 2]
            at += 1


@inner
def _timed_anew(
    courses: PackedCourses, crossings: PackedCrossings, rides: PackedRides, laws: PackedLaws,
    robots: Ints, most: float, weight: Floats, alone: Floats,
) -> float:  # fmt: skip
    """Give robots new laws in their order; infinite if one has none or they get later than most."""
    total = 0.0
    for robot in robots:
        ride, box = yielding_ride(courses, crossings, rides, laws, robot)
        if box != CLEAR:
            return np.inf
        late = ride.arrive[ride.arrive.size - 1] - rides.depart[robot] - alone[robot]
        total += weight[robot] * late
        if total >= most:
            return np.inf
        take_law(ride, laws)
    return total


@kernel
def improved_laws(
    courses: PackedCourses, crossings: PackedCrossings, rides: PackedRides, laws: PackedLaws,
    alone: Floats, weight: Floats, settled: Flags, work: int, seed: int,
) -> tuple[float, int]:  # fmt: skip
    """Make laws sooner by taking a few away and giving them back in another order.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        rides: PackedRides.
        laws: Of all robots that are served; written to.
        alone: How long each robot takes if it is alone [s], (n,).
        weight: What a second of its lateness counts, (n,).
        settled: Whether its law stays as it is, (n,).
        work: How many boxes may be looked at.
        seed: Of what is chosen.

    Returns:
        By how much the weighed sum of lateness shrank [s], and how many boxes were looked at.
    """
    state = np.array([seed * 2 + 1], np.int64)
    gained, done = 0.0, 0
    while done < work:
        done += 1
        robot = _late_robot(courses, rides, laws, alone, settled, state)
        if robot < 0 or _lateness_of(courses, rides, laws, alone, robot) <= GAIN_S:
            continue
        robots = _neighbourhood(courses, crossings, laws, settled, robot, state)
        before = 0.0
        for other in robots:
            late = _lateness_of(courses, rides, laws, alone, other)
            before += weight[other] * late
            done += crossings.box_first[other + 1] - crossings.box_first[other]
            done += courses.first[other + 1] - courses.first[other]
        for i in range(robots.size - 1, 1, -1):  # the late one stays first, half of the time
            j = 1 + _next(state, i)
            robots[i], robots[j] = robots[j], robots[i]
        if _next(state, 2) == 1 and robots.size > 1:
            j = _next(state, robots.size)
            robots[0], robots[j] = robots[j], robots[0]
        kept = _copied(courses, laws, robots)
        for other in robots:
            laws.is_timed[other] = False
        after = _timed_anew(courses, crossings, rides, laws, robots, before - GAIN_S, weight, alone)
        if after < before - GAIN_S:
            gained += before - after
        else:
            _put_back(courses, laws, robots, kept)
    return gained, done
