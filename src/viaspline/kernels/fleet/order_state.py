"""Who passes each crossing first, as far as that is settled, and how to undo what was tried.

Laws follow from orders: see ``ride_in_turn``. A *try* settles some orders and times some robots by
them; it is kept or undone as a whole. What others are to know of a law is kept passage by passage,
so that looking along a robot's passages is looking along an array.

Tested through ``kernels/fleet/test_first_come_laws``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints, Steps
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.jit import inlined, inner, uncounted

NOBODY: Final = -1
"""No robot, or no passage."""
OPEN: Final = 0
"""No order of a crossing is settled: its robots haven't met there so far."""
FIRST: Final = 1
"""The robot of a passage passes before the other one,"""
SECOND: Final = 2
"""or after it."""
TOUCHED: Final = 0
"""Where ``OrderState.counts`` has how many robots a try has timed,"""
SETTLED: Final = 1
"""how many orders it has settled,"""
WORK: Final = 2
"""and how many nodes and passages were looked at in all."""


class OrderState(NamedTuple):
    """Orders, and what a try changes; all of it is written to.

    Attributes:
        rank: Whether the robot of a passage passes ``FIRST`` or ``SECOND``, or ``OPEN``, (p,).
        owner: The robot of a passage, (p,).
        mate: The passage of the same crossing from the other robot's side, (p,); ``NOBODY`` where
            that has none, for it isn't a robot and only moves.
        seen: The nodes of its own path from and to which the robot of a passage is in the other's
            boxes, (p, 2).
        window: From when to when the other robot may be in a passage, by such nodes of its law [s];
            from infinity to minus infinity where it has none, (p, 2).
        reach: The last cell in which a robot has a box of this passage or of any before it, (p,).
        binds: Whether a robot is held up, or nearly so, by the one that passes before it, (p,).
        gave: Passages in which the last ride of a robot gave way, in the order in which it did,
            from its first passage on, (p,);
        gave_at: the node round which it was slowed down there, (p,);
        gave_by: how much too early it came [s], the square of the speed to which it was slowed down
            [m²/s²], and how long it stood then [s], (p, 3).
        given: How often it gave way, (n,).
        movable: Whether a robot's law may be changed, (n,).
        counts: See ``TOUCHED``, ``SETTLED`` and ``WORK``, (3,).
        is_touched: Whether a try has timed a robot, (n,).
        touched: These robots, (n,).
        has_law: Whether it has given a robot another law, (n,).
        law: The laws of these before: when they came, when they went on, how fast, (nodes, 3).
        bound: ``binds`` of the touched ones before it, (p,).
        settled: The passages whose orders it has settled, and their ranks before, (most, 2).
        queue: Robots that are to be timed, in a ring, (n + 1,).
        is_queued: Whether a robot is one of them, (n,).
        visits: How often a robot was timed at a time, (n,).
        when: When a robot next meets another one with which no order is settled [s], (n,).
    """

    rank: Steps
    owner: Ints
    mate: Ints
    seen: Ints
    window: Floats
    reach: Ints
    binds: Flags
    gave: Ints
    gave_at: Ints
    gave_by: Floats
    given: Ints
    movable: Flags
    counts: Ints
    is_touched: Flags
    touched: Ints
    has_law: Flags
    law: Floats
    bound: Flags
    settled: Ints
    queue: Ints
    is_queued: Flags
    visits: Ints
    when: Floats


@inner
def new_order_state(
    courses: PackedCourses, passages: PackedPassages, laws: PackedLaws, crossings: int,
    movable: Flags,
) -> OrderState:  # fmt: skip
    """Orders none of which is settled, of so many crossings."""
    robots, count = movable.size, passages.crossing.size
    owner, mate = np.empty(count, np.int64), np.full(count, NOBODY)
    met = np.full(crossings, NOBODY)
    seen, reach = np.empty((count, 2), np.int64), np.empty(count, np.int64)
    for robot in range(robots):
        last = -1
        for p in range(passages.first[robot], passages.first[robot + 1]):
            last = max(last, passages.exit[p])
            reach[p], owner[p] = last, robot
            c = passages.crossing[p]
            if met[c] == NOBODY:
                met[c] = p
            else:
                mate[p], mate[met[c]] = met[c], p
    window = np.empty((count, 2))
    for p in range(count):
        other, low, after = passages.other[p], passages.low[p], passages.high[p] + 1
        window[p, 0], window[p, 1] = _there(courses, laws, other, low, after)
        if mate[p] != NOBODY:
            seen[mate[p], 0], seen[mate[p], 1] = low, after
    return OrderState(
        np.zeros(count, np.int32), owner, mate, seen, window, reach,
        np.zeros(count, np.bool_), np.empty(count, np.int64), np.empty(count, np.int64),
        np.empty((count, 3)), np.zeros(robots, np.int64), movable, np.zeros(3, np.int64),
        np.zeros(robots, np.bool_), np.empty(robots, np.int64), np.zeros(robots, np.bool_),
        np.empty((courses.distance.size, 3)), np.empty(count, np.bool_),
        np.empty((count + 1, 2), np.int64), np.empty(robots + 1, np.int64),
        np.zeros(robots, np.bool_), np.zeros(robots, np.int64), np.full(robots, np.inf),
    )  # fmt: skip


@inlined
def _there(
    courses: PackedCourses, laws: PackedLaws, robot: int, low: int, after: int
) -> tuple[float, float]:
    """From when to when a robot may be between two of its nodes [s]."""
    if not laws.is_timed[robot]:
        return np.inf, -np.inf
    last = courses.first[robot + 1] - 1
    comes = laws.arrive[low] if low > courses.first[robot] else -np.inf
    return comes, laws.leave[last] if after == last else laws.arrive[after]


@uncounted
def show_law(
    courses: PackedCourses, passages: PackedPassages, laws: PackedLaws, state: OrderState,
    robot: int, since: int,
) -> None:  # fmt: skip
    """Let the others know of a robot's law, which is another one from a node on."""
    for p in range(passages.first[robot], passages.first[robot + 1]):
        mate = state.mate[p]
        if mate == NOBODY or state.seen[p, 1] < since:
            continue
        comes, goes = _there(courses, laws, robot, state.seen[p, 0], state.seen[p, 1])
        state.window[mate, 0], state.window[mate, 1] = comes, goes


@uncounted
def settle(state: OrderState, passage: int, rank: int) -> None:
    """Let the robot of a passage pass first, or second."""
    k = state.counts[SETTLED]
    state.settled[k, 0], state.settled[k, 1] = passage, state.rank[passage]
    state.counts[SETTLED] = k + 1
    rank_both(state, passage, rank)


@uncounted
def rank_both(state: OrderState, passage: int, rank: int) -> None:
    """Write down the rank of the robot of a passage, and that of the other one."""
    state.rank[passage] = rank
    if state.mate[passage] != NOBODY:
        state.rank[state.mate[passage]] = OPEN if rank == OPEN else FIRST + SECOND - rank


@uncounted
def touch(passages: PackedPassages, state: OrderState, robot: int) -> None:
    """Remember by whom a robot is held up, once in a try."""
    if state.is_touched[robot]:
        return
    state.is_touched[robot] = True
    state.touched[state.counts[TOUCHED]] = robot
    state.counts[TOUCHED] += 1
    for p in range(passages.first[robot], passages.first[robot + 1]):
        state.bound[p] = state.binds[p]


@uncounted
def keep_law(courses: PackedCourses, laws: PackedLaws, state: OrderState, robot: int) -> None:
    """Remember the law that a touched robot has, once in a try."""
    if state.has_law[robot]:
        return
    state.has_law[robot] = True
    for k in range(courses.first[robot], courses.first[robot + 1]):
        state.law[k, 0], state.law[k, 1] = laws.arrive[k], laws.leave[k]
        state.law[k, 2] = laws.speed[k]


@uncounted
def keep(state: OrderState) -> None:
    """Keep what was tried."""
    for i in range(state.counts[TOUCHED]):
        robot = state.touched[i]
        state.is_touched[robot], state.has_law[robot] = False, False
        state.visits[robot] = 0
    state.counts[TOUCHED], state.counts[SETTLED] = 0, 0


@uncounted
def undo(
    courses: PackedCourses, passages: PackedPassages, laws: PackedLaws, state: OrderState
) -> None:
    """Undo what was tried."""
    for i in range(state.counts[TOUCHED]):
        robot = state.touched[i]
        for p in range(passages.first[robot], passages.first[robot + 1]):
            state.binds[p] = state.bound[p]
        if not state.has_law[robot]:
            continue
        for k in range(courses.first[robot], courses.first[robot + 1]):
            laws.arrive[k], laws.leave[k] = state.law[k, 0], state.law[k, 1]
            laws.speed[k] = state.law[k, 2]
        show_law(courses, passages, laws, state, robot, courses.first[robot])
    for i in range(state.counts[SETTLED] - 1, -1, -1):
        rank_both(state, state.settled[i, 0], state.settled[i, 1])
    keep(state)
