"""Who passes each crossing first, as far as that is settled, and how to undo what was tried.

Laws follow from orders: see ``ride_in_turn``. A *try* settles some orders and times some robots by
them; it is kept or undone as a whole.

Tested through ``kernels/fleet/test_first_come_laws``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.jit import inner

OPEN: Final = -1
"""No order of a crossing is settled: its robots haven't met there so far."""
TOUCHED: Final = 0
"""Where ``OrderState.counts`` has how many robots a try has timed,"""
SETTLED: Final = 1
"""how many orders it has settled,"""
WORK: Final = 2
"""and how many nodes and passages were looked at in all."""


class OrderState(NamedTuple):
    """Orders, and what a try changes; all of it is written to.

    Attributes:
        leader: The robot that passes first, or ``OPEN``, (c,).
        mate: The passage of the same crossing from the other robot's side, (p,).
        binds: Whether a robot is held up, or nearly so, by the one that passes before it, (p,).
        movable: Whether a robot's law may be changed, (n,).
        counts: See ``TOUCHED``, ``SETTLED`` and ``WORK``, (3,).
        is_touched: Whether a try has timed a robot, (n,).
        touched: These robots, (n,).
        law: Their laws before it: when they came, when they went on, how fast, (nodes, 3).
        bound: ``binds`` of theirs before it, (p,).
        settled: The crossings that it has settled, and their leaders before, (most, 2).
        queue: Robots that are to be timed, in a ring, (n + 1,).
        is_queued: Whether a robot is one of them, (n,).
        visits: How often a robot was timed at a time, (n,).
        when: When a robot next meets another one with which no order is settled [s], (n,).
    """

    leader: Ints
    mate: Ints
    binds: Flags
    movable: Flags
    counts: Ints
    is_touched: Flags
    touched: Ints
    law: Floats
    bound: Flags
    settled: Ints
    queue: Ints
    is_queued: Flags
    visits: Ints
    when: Floats


@inner
def new_order_state(
    courses: PackedCourses, passages: PackedPassages, crossings: int, movable: Flags
) -> OrderState:
    """Orders none of which is settled."""
    robots, count = movable.size, passages.crossing.size
    mate, met = np.empty(count, np.int64), np.full(crossings, -1)
    for p in range(count):
        c = passages.crossing[p]
        if met[c] < 0:
            met[c] = p
        else:
            mate[p], mate[met[c]] = met[c], p
    return OrderState(
        np.full(crossings, OPEN), mate, np.zeros(count, np.bool_), movable,
        np.zeros(3, np.int64), np.zeros(robots, np.bool_), np.empty(robots, np.int64),
        np.empty((courses.distance.size, 3)), np.empty(count, np.bool_),
        np.empty((2 * crossings + 1, 2), np.int64), np.empty(robots + 1, np.int64),
        np.zeros(robots, np.bool_), np.zeros(robots, np.int64), np.full(robots, np.inf),
    )  # fmt: skip


@inner
def settle(state: OrderState, crossing: int, leader: int) -> None:
    """Let a robot pass a crossing first."""
    k = state.counts[SETTLED]
    state.settled[k, 0], state.settled[k, 1] = crossing, state.leader[crossing]
    state.counts[SETTLED] = k + 1
    state.leader[crossing] = leader


@inner
def touch(
    courses: PackedCourses, passages: PackedPassages, laws: PackedLaws, state: OrderState,
    robot: int,
) -> None:  # fmt: skip
    """Remember the law that a robot has, once in a try."""
    if state.is_touched[robot]:
        return
    state.is_touched[robot] = True
    state.touched[state.counts[TOUCHED]] = robot
    state.counts[TOUCHED] += 1
    for k in range(courses.first[robot], courses.first[robot + 1]):
        state.law[k, 0], state.law[k, 1] = laws.arrive[k], laws.leave[k]
        state.law[k, 2] = laws.speed[k]
    for p in range(passages.first[robot], passages.first[robot + 1]):
        state.bound[p] = state.binds[p]


@inner
def keep(state: OrderState) -> None:
    """Keep what was tried."""
    for i in range(state.counts[TOUCHED]):
        state.is_touched[state.touched[i]] = False
        state.visits[state.touched[i]] = 0
    state.counts[TOUCHED], state.counts[SETTLED] = 0, 0


@inner
def undo(
    courses: PackedCourses, passages: PackedPassages, laws: PackedLaws, state: OrderState
) -> None:
    """Undo what was tried."""
    for i in range(state.counts[TOUCHED]):
        robot = state.touched[i]
        for k in range(courses.first[robot], courses.first[robot + 1]):
            laws.arrive[k], laws.leave[k] = state.law[k, 0], state.law[k, 1]
            laws.speed[k] = state.law[k, 2]
        for p in range(passages.first[robot], passages.first[robot + 1]):
            state.binds[p] = state.bound[p]
    for i in range(state.counts[SETTLED] - 1, -1, -1):
        state.leader[state.settled[i, 0]] = state.settled[i, 1]
    keep(state)
