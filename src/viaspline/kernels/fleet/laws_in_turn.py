"""The laws of a fleet by the orders that are settled, and the next order that is to be.

A robot whose law changes has those timed anew that pass after it and are held up by it, or were.
That ends unless robots wait for each other in a circle; then each is timed ever later.

Tested through ``kernels/fleet/test_first_come_laws``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.order_state import (
    FIRST,
    NOBODY,
    OPEN,
    SECOND,
    TOUCHED,
    WORK,
    OrderState,
    keep_law,
    settle,
    show_law,
    touch,
)
from viaspline.kernels.fleet.ride_in_turn import NEARLY_S, meets, ride_in_turn, too_early
from viaspline.kernels.fleet.ride_law import first_change, take_law
from viaspline.kernels.fleet.yielding_ride import RideScene
from viaspline.kernels.jit import inner, uncounted

MOST_VISITS = 12
"""How often a robot is timed at a time, before robots are taken to wait in a circle,"""
PATIENT_VISITS = 6
"""and how often before it waits as near to crossings as it can."""


@uncounted
def _queue_followers(scene: RideScene, state: OrderState, robot: int, tail: int) -> int:
    """Queue those who pass after a robot and have to be timed anew. Where the queue then ends."""
    passages, laws = scene.passages, scene.laws
    last = scene.courses.first[robot + 1] - 1
    for p in range(passages.first[robot], passages.first[robot + 1]):
        other = passages.other[p]
        mate = state.mate[p]
        if state.rank[p] != FIRST or mate == NOBODY or state.is_queued[other]:
            continue
        if not state.movable[other]:
            continue
        after = passages.exit[p] + 1
        gone = laws.leave[after] if after == last else laws.arrive[after]
        if state.binds[mate] or (
            gone > laws.arrive[passages.entry[mate]]
            and too_early(scene, laws.arrive, 0, scene.courses.first[other], mate) > -NEARLY_S
        ):
            state.is_queued[other] = True
            state.queue[tail] = other
            tail = (tail + 1) % state.queue.size
    return tail


@inner
def timed_in_turn(
    scene: RideScene, state: OrderState, robots: Ints, steady: int, most: int
) -> bool:
    """Time robots, and all whom that holds up or lets go, until no law changes.

    Args:
        scene: Its laws are written to.
        state: The orders; what a try changes is written to.
        robots: Those to begin with, each once, (k,).
        steady: A robot whose law must not change by that; ``NOBODY`` if any may.
        most: So many rides may be looked for.

    Returns:
        Whether it came to an end.
    """
    for i in range(state.counts[TOUCHED]):
        state.visits[state.touched[i]] = 0
    head, tail = 0, robots.size
    for i in range(tail):
        state.queue[i] = robots[i]
        state.is_queued[robots[i]] = True
    ends, rides = True, 0
    while head != tail:
        robot = state.queue[head]
        head = (head + 1) % state.queue.size
        state.is_queued[robot] = False
        if not ends:
            continue
        touch(scene.passages, state, robot)
        state.visits[robot] += 1
        rides += 1
        if rides > most or state.visits[robot] > MOST_VISITS:
            ends = False
            continue
        ride, ends = ride_in_turn(scene, state, robot, state.visits[robot] > PATIENT_VISITS)
        state.counts[WORK] += ride.square.size
        state.counts[WORK] += scene.passages.first[robot + 1] - scene.passages.first[robot]
        change = first_change(ride, scene.laws) if ends else -1
        if change < 0:
            continue
        keep_law(scene.courses, scene.laws, state, robot)
        take_law(ride, scene.laws)
        show_law(scene.courses, scene.passages, scene.laws, state, robot, ride.first + change)
        ends = robot != steady
        tail = _queue_followers(scene, state, robot, tail)
    return ends


@uncounted
def gained(scene: RideScene, state: OrderState, weight: Floats) -> float:
    """How much sooner the robots that a try touched arrive by it, weighed [s]."""
    total = 0.0
    for i in range(state.counts[TOUCHED]):
        robot = state.touched[i]
        end = scene.courses.first[robot + 1] - 1
        if state.has_law[robot]:
            total += weight[robot] * (state.law[end, 0] - scene.laws.arrive[end])
    return total


@uncounted
def next_meeting(scene: RideScene, state: OrderState, robot: int) -> tuple[float, int]:
    """When a robot first meets another one with which no order is settled [s], and its passage.

    Infinite and -1 where it meets none.
    """
    courses, passages, laws, window = scene.courses, scene.passages, scene.laws, state.window
    first, last = courses.first[robot], courses.first[robot + 1] - 1
    soonest, found = np.inf, -1
    for p in range(passages.first[robot], passages.first[robot + 1]):
        if state.rank[p] != OPEN:
            continue
        comes = laws.arrive[passages.entry[p]] if passages.entry[p] > first else -np.inf
        if comes >= soonest:
            break
        both = max(comes, window[p, 0])
        if both < soonest and meets(scene, window, laws.arrive, laws.leave, 0, first, last, p):
            soonest, found = both, p
    return soonest, found


@inner
def sooner_leader(
    scene: RideScene, state: OrderState, weight: Floats, passage: int
) -> tuple[int, float]:
    """Who should pass a crossing first: who counts more, else who would be held up longer.

    Args:
        scene: What the robots ride among.
        state: Who may be held up.
        weight: What a second of a robot's lateness counts, (n,).
        passage: The crossing, from the side of one robot.

    Returns:
        (the passage of the second one, what it counts that this one is held up [s], infinite where
        neither can pass after the other).
    """
    courses, laws, passages = scene.courses, scene.laws, scene.passages
    mate = state.mate[passage]
    one, other = state.owner[passage], passages.other[passage]
    late, other_late = np.inf, np.inf
    if state.movable[one]:
        late = weight[one] * too_early(scene, laws.arrive, 0, courses.first[one], passage)
    if state.movable[other] and mate != NOBODY:
        other_late = weight[other] * too_early(scene, laws.arrive, 0, courses.first[other], mate)
    is_second = late < other_late
    if weight[one] != weight[other] and late < np.inf and other_late < np.inf:
        is_second = weight[one] < weight[other]
    return (passage, late) if is_second else (mate, other_late)


@inner
def _look_for_meetings(scene: RideScene, state: OrderState, begin: int) -> None:
    """Find the next meetings of robots that were timed last, and of those touched from one on."""
    for i in range(state.counts[TOUCHED]):
        robot = state.touched[i]
        if i >= begin or state.visits[robot] > 0:
            state.when[robot], _ = next_meeting(scene, state, robot)
            state.counts[WORK] += scene.passages.first[robot + 1] - scene.passages.first[robot]


@inner
def settle_meetings(
    scene: RideScene, state: OrderState, weight: Floats, most: int, tries: int, gain: float
) -> bool:
    """Settle the orders in which robots that a try touched meet others, the next one first.

    Each order makes robots later, so it ends where the try gains no more than it has to.

    Args:
        scene: Its laws are written to.
        state: The orders; what a try changes is written to.
        weight: What a second of a robot's lateness counts, (n,).
        most: See ``timed_in_turn``.
        tries: So many orders may be settled.
        gain: What the try has to gain [s].

    Returns:
        Whether nobody meets another one any more, and the try gains more than that.
    """
    second, begin = np.empty(1, np.int64), 0
    while gained(scene, state, weight) > gain:
        _look_for_meetings(scene, state, begin)
        begin = state.counts[TOUCHED]
        passage = -1
        while passage < 0:
            robot = state.touched[0]
            for one in state.touched[1:begin]:
                if state.when[one] < state.when[robot]:
                    robot = one
            if state.when[robot] == np.inf:
                return True
            when, passage = next_meeting(scene, state, robot)
            if when > state.when[robot]:  # the other one is gone meanwhile
                passage = -1
            state.when[robot] = when
        behind, late = sooner_leader(scene, state, weight, passage)
        tries -= 1
        if tries < 0 or late == np.inf:
            return False
        settle(state, behind, SECOND)
        second[0] = state.owner[behind]
        if not timed_in_turn(scene, state, second, NOBODY, most):
            return False
        state.when[robot], _ = next_meeting(scene, state, robot)
    return False
