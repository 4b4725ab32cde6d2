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
from viaspline.kernels.fleet.blocked_times import blocks_of, know_passage
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.random_numbers import random_below
from viaspline.kernels.fleet.ride_law import take_law
from viaspline.kernels.fleet.yielding_ride import CLEAR, RideScene, yielding_ride
from viaspline.kernels.jit import inner, kernel

MOST: Final = 8
"""Robots in a neighbourhood."""
LATEST_OF = 3
"""Of so many robots the latest is the first of a neighbourhood."""
CLOSE_S = 0.5
"""A robot that enters a crossing so soon after another one may have waited for it."""
GAIN_S = 1e-6
"""By less than this nothing gets better: rounding could go round in circles."""
UNSERVED_SHARE = 4
"""Each so manieth neighbourhood is that of a robot without a law, if there is one."""
UNSERVED_S = 1e9
"""What a robot without a law counts, beside seconds of lateness."""


@inner
def _cost(scene: RideScene, alone: Floats, weight: Floats, robot: int) -> float:
    """What the lateness of a robot counts [s]."""
    if not scene.laws.is_timed[robot]:
        return UNSERVED_S
    arrives = scene.laws.arrive[scene.courses.first[robot + 1] - 1]
    return weight[robot] * (arrives - scene.rides.depart[robot] - alone[robot])


@inner
def _unserved(scene: RideScene, movable: Flags, state: Ints) -> int:
    """Any of the robots that have no law and may get one; -1 if there is none."""
    robots = scene.laws.is_timed.size
    begin = random_below(state, robots)
    for k in range(robots):
        robot = (begin + k) % robots
        if movable[robot] and not scene.laws.is_timed[robot]:
            return robot
    return -1


@inner
def _late_robot(
    scene: RideScene, alone: Floats, weight: Floats, movable: Flags, state: Ints
) -> int:
    """A robot, the later the likelier: the latest of some; now and then one without a law."""
    if random_below(state, UNSERVED_SHARE) == 0:
        robot = _unserved(scene, movable, state)
        if robot >= 0:
            return robot
    best, worst = -1, GAIN_S
    for _ in range(LATEST_OF):
        robot = random_below(state, alone.size)
        if movable[robot]:
            late = _cost(scene, alone, weight, robot)
            if late > worst:
                best, worst = robot, late
    return best


@inner
def _in_the_way(scene: RideScene, robot: int, movable: Flags, chosen: Ints) -> int:
    """Choose those that keep a robot from having a law, one after the other. How many then."""
    count = 1
    while count < chosen.size:
        _, box = yielding_ride(scene, robot)
        if box == CLEAR:
            break
        other = scene.crossings.other[box]
        if not movable[other]:
            break
        scene.laws.is_timed[other] = False
        chosen[count] = other
        count += 1
    for other in chosen[1:count]:
        scene.laws.is_timed[other] = True
    return count


@inner
def _waits_for(scene: RideScene, robot: int, movable: Flags, chosen: Ints, most: int) -> int:
    """Choose those that a robot may have waited for. How many then."""
    count = 1
    courses, passages, laws = scene.courses, scene.passages, scene.laws
    blocks = blocks_of(courses, passages, laws, robot)
    for i in range(blocks.since.size):
        p = blocks.begin + i
        goes = laws.arrive[passages.exit[p] + 1]
        if blocks.until[i] == -np.inf or blocks.since[i] > goes:
            continue
        if laws.arrive[passages.entry[p]] > blocks.until[i] + CLOSE_S:
            continue
        at, begin = (
            know_passage(courses, passages, laws, blocks, i),
            passages.box_first[p],
        )
        is_close = False
        for j in range(passages.box_first[p + 1] - begin):
            gap = laws.arrive[passages.cell[begin + j]] - blocks.times[at + j, 1]
            is_close = is_close or 0.0 <= gap < CLOSE_S
        other = passages.other[p]
        if is_close and count < most and movable[other] and not (chosen[:count] == other).any():
            chosen[count] = other
            count += 1
    return count


@inner
def _neighbourhood(scene: RideScene, robot: int, movable: Flags, state: Ints) -> Ints:
    """A robot, those that it may have waited for, and some that it meets."""
    chosen = np.empty(MOST, np.int64)
    chosen[0] = robot
    begin, end = scene.passages.first[robot], scene.passages.first[robot + 1]
    if begin == end:
        return chosen[:1]
    if not scene.laws.is_timed[robot]:
        return chosen[: _in_the_way(scene, robot, movable, chosen)]
    most = 2 + random_below(state, MOST - 1)
    count = _waits_for(scene, robot, movable, chosen, most)
    for _ in range(most):
        other = scene.passages.other[begin + random_below(state, end - begin)]
        if count < most and movable[other] and not (chosen[:count] == other).any():
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
def _put_back(
    courses: PackedCourses, laws: PackedLaws, robots: Ints, kept: Floats, was_timed: Flags
) -> None:
    """Undo what was done to the laws of some robots."""
    at = 0
    for i in range(robots.size):
        robot = robots[i]
        laws.is_timed[robot] = was_timed[i]
        for node in range(courses.first[robot], courses.first[robot + 1]):
            laws.arrive[node], laws.leave[node] = kept[at, 0], kept[at, 1]
            laws.speed[node] = kept[at, 2]
            at += 1


@inner
def _timed_anew(
    scene: RideScene, robots: Ints, most: float, weight: Floats, alone: Floats
) -> tuple[float, int]:
    """Give robots new laws in their order.

    Returns:
        (what their lateness counts, infinite if it comes to ``most``; for how many of them a ride
        was sought).
    """
    total = 0.0
    for i in range(robots.size):
        robot = robots[i]
        ride, box = yielding_ride(scene, robot)
        if box == CLEAR:
            late = ride.arrive[ride.arrive.size - 1] - scene.rides.depart[robot] - alone[robot]
            total += weight[robot] * late
        else:
            total += UNSERVED_S
        if total >= most:
            return np.inf, i + 1
        if box == CLEAR:
            take_law(ride, scene.laws)
    return total, robots.size


@inner
def _shuffle(robots: Ints, state: Ints) -> None:
    """Put a neighbourhood in another order; half of the time the late one stays in front."""
    for i in range(robots.size - 1, 1, -1):
        j = 1 + random_below(state, i)
        robots[i], robots[j] = robots[j], robots[i]
    if random_below(state, 2) == 1 and robots.size > 1:
        j = random_below(state, robots.size)
        robots[0], robots[j] = robots[j], robots[0]


@kernel
def improved_laws(
    courses: PackedCourses, crossings: PackedCrossings, passages: PackedPassages,
    rides: PackedRides, laws: PackedLaws, alone: Floats, weight: Floats, movable: Flags,
    work: int, state: Ints,
) -> int:  # fmt: skip
    """Make laws sooner by taking a few away and giving them back in another order.

    A robot that has no law yet counts as very late: it is given one as soon as nobody loses his for
    it.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        passages: Of these.
        rides: PackedRides.
        laws: Written to.
        alone: How long each robot takes if it is alone [s], (n,).
        weight: What a second of its lateness counts, (n,).
        movable: Whether a robot's law may be changed, (n,).
        work: How many nodes and passages may be looked at.
        state: Of the random numbers, (1,).

    Returns:
        How many were.
    """
    scene = RideScene(courses, crossings, passages, rides, laws)
    done, changes = 0, 0
    hopeless = np.full(alone.size, -1)  # how many changes there had been when it had no ride
    while done < work:
        done += 1
        robot = _late_robot(scene, alone, weight, movable, state)
        if robot < 0:
            continue
        if hopeless[robot] == changes:  # the same is tried again, and counts as it does
            random_below(state, 2)
            done += 2 * (passages.first[robot + 1] - passages.first[robot])
            done += courses.first[robot + 1] - courses.first[robot]
            continue
        robots = _neighbourhood(scene, robot, movable, state)
        done += passages.first[robot + 1] - passages.first[robot]
        before = 0.0
        was_timed = np.ones(robots.size, np.bool_)
        _shuffle(robots, state)
        for i in range(robots.size):
            before += _cost(scene, alone, weight, robots[i])
            was_timed[i] = laws.is_timed[robots[i]]
        kept = _copied(courses, laws, robots)
        for other in robots:
            laws.is_timed[other] = False
        after, sought = _timed_anew(scene, robots, before - GAIN_S, weight, alone)
        for other in robots[:sought]:
            done += passages.first[other + 1] - passages.first[other]
            done += courses.first[other + 1] - courses.first[other]
        if after < before - GAIN_S:
            changes += 1
            continue
        _put_back(courses, laws, robots, kept, was_timed)
        if robots.size == 1 and not was_timed[0]:  # who is in its way can't be moved
            hopeless[robot] = changes
    return done
