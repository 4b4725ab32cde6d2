"""Better laws for a fleet: let a robot pass before one that it waits for, and keep what is sooner.

Local search among orders, as for job shops (van Laarhoven, Aarts and Lenstra 1992): only orders
that hold somebody up are turned round, and only those are timed anew whom that reaches. At any
moment the laws of the fleet are whole and clear of each other.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.laws_in_turn import settle_meetings, timed_in_turn
from viaspline.kernels.fleet.order_state import (
    FIRST,
    NOBODY,
    SECOND,
    WORK,
    OrderState,
    keep,
    new_order_state,
    rank_both,
    settle,
    undo,
)
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.random_numbers import random_below
from viaspline.kernels.fleet.ride_in_turn import NEARLY_S, too_early
from viaspline.kernels.fleet.yielding_ride import RideScene
from viaspline.kernels.jit import inner, kernel

LATEST_OF = 3
"""Of so many robots the latest is let pass."""
GAIN_S = 1e-6
"""By less than this nothing gets better: rounding could go round in circles."""
MOST_RIDES = 60
"""So many rides are looked for after one order."""
MOST_MEETINGS = 40
"""So many orders may have to be settled by turning one round."""
ALL_SHARE = 4
"""Each so manieth time a robot passes before all whom it waits for."""


@inner
def _settle_as_driven(scene: RideScene, state: OrderState) -> None:
    """Settle the orders by which robots are held up, as their laws have it; the rest stays open."""
    courses, passages, laws = scene.courses, scene.passages, scene.laws
    for p in range(passages.crossing.size):
        robot, other = state.owner[p], passages.other[p]
        first, after = courses.first[robot], passages.high[p] + 1
        if not (state.movable[robot] and laws.is_timed[other]) or passages.entry[p] == first:
            continue
        gone = laws.leave[after] if after == courses.first[other + 1] - 1 else laws.arrive[after]
        comes = laws.arrive[passages.entry[p]]
        if gone <= comes - NEARLY_S or laws.arrive[passages.low[p]] > comes:
            continue
        if abs(too_early(scene, laws.arrive, 0, first, p)) < NEARLY_S:
            rank_both(state, p, SECOND)
            state.binds[p] = True


@inner
def _late_robot(
    scene: RideScene, state: OrderState, alone: Floats, weight: Floats, random: Ints
) -> int:
    """A robot, the later the likelier: the latest of some; -1 where none of these is late."""
    best, worst = NOBODY, GAIN_S
    for _ in range(LATEST_OF):
        robot = random_below(random, alone.size)
        arrives = scene.laws.arrive[scene.courses.first[robot + 1] - 1]
        late = weight[robot] * (arrives - scene.rides.depart[robot] - alone[robot])
        if state.movable[robot] and late > worst:
            best, worst = robot, late
    return best


@inner
def _turned(scene: RideScene, state: OrderState, robot: int, random: Ints) -> Ints:
    """Let a robot pass before one that it waits for, or before all. Who is to be timed anew."""
    passages = scene.passages
    begin, end = passages.first[robot], passages.first[robot + 1]
    waits = np.flatnonzero(state.binds[begin:end]) + begin
    movable = np.empty(waits.size, np.int64)
    count = 0
    for p in waits:
        if state.movable[passages.other[p]]:
            movable[count] = p
            count += 1
    if count == 0:
        return movable[:0]
    if random_below(random, ALL_SHARE) > 0:
        movable[0] = movable[random_below(random, count)]
        count = 1
    robots = np.empty(count + 1, np.int64)
    robots[0] = robot
    known = 1
    for p in movable[:count]:
        settle(state, p, FIRST)
        other = passages.other[p]
        if not (robots[:known] == other).any():
            robots[known] = other
            known += 1
    return robots[:known]


@kernel
def turned_orders(
    courses: PackedCourses, crossings: PackedCrossings, passages: PackedPassages,
    rides: PackedRides, laws: PackedLaws, alone: Floats, weight: Floats, movable: Flags,
    work: int, random: Ints,
) -> int:  # fmt: skip
    """Make laws sooner by letting robots pass before those that they wait for.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        passages: Of these.
        rides: PackedRides.
        laws: Clear of each other; written to.
        alone: How long each robot takes if it is alone [s], (n,).
        weight: What a second of its lateness counts, (n,).
        movable: Whether a robot's law may be changed; it has one then, (n,).
        work: How many nodes and passages may be looked at.
        random: The state of the random numbers, (1,).

    Returns:
        How many were.
    """
    scene = RideScene(courses, crossings, passages, rides, laws)
    state = new_order_state(courses, passages, laws, crossings.robots.shape[0], movable)
    _settle_as_driven(scene, state)
    state.counts[WORK] = passages.crossing.size
    while state.counts[WORK] < work:
        state.counts[WORK] += 1
        robot = _late_robot(scene, state, alone, weight, random)
        if robot == NOBODY:
            continue
        robots = _turned(scene, state, robot, random)
        state.counts[WORK] += passages.first[robot + 1] - passages.first[robot]
        if (
            robots.size > 0
            and timed_in_turn(scene, state, robots, NOBODY, MOST_RIDES)
            and settle_meetings(scene, state, weight, MOST_RIDES, MOST_MEETINGS, GAIN_S)
        ):
            keep(state)
        else:
            undo(courses, passages, laws, state)
    return state.counts[WORK]
