"""Laws of a whole fleet by settling who passes first as robots meet, in the order of time.

At first all drive as if they were alone. Then the two that meet first are given an order, and all
whom that holds up are timed anew, until nobody meets anybody. Who would be held up longer passes
first; where that holds up others as well, or robots would wait for each other in a circle, both
orders are tried. What is late so spreads over the fleet, instead of piling up with those that are
timed last.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.fleet.foreseen_waits import (
    SeenAhead,
    chance_of,
    foresee_all,
    foresee_touched,
    more_foreseen,
)
from viaspline.kernels.fleet.laws_in_turn import (
    gained,
    next_meeting,
    sooner_leader,
    timed_in_turn,
)
from viaspline.kernels.fleet.order_state import (
    FIRST,
    NOBODY,
    OPEN,
    SECOND,
    TOUCHED,
    WORK,
    OrderState,
    keep,
    new_order_state,
    settle,
    show_law,
    undo,
)
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.ride_law import new_ride, take_law
from viaspline.kernels.fleet.yielding_ride import RideScene
from viaspline.kernels.jit import inner, kernel

MOST_RIDES = 40
"""So many rides are looked for to try an order,"""
MOST_RIDES_AT_LAST = 600
"""and so many where with fewer neither one would do."""
RIDES_EACH = 40
"""So many rides of each robot are looked for at first, by the orders that are forced."""
ASIDE_SHARE = 1.05
"""Both orders are tried where all are held up longer than the second one by this share,"""
ASIDE_S = 0.1
"""and by so much [s]."""


@inner
def _cost(scene: RideScene, state: OrderState, weight: Floats, passage: int, most: int) -> float:
    """Let a robot pass second; what it counts that all are held up by that [s].

    Infinite if it can't be.
    """
    settle(state, passage, SECOND)
    leader, second = scene.passages.other[passage], state.owner[passage]
    steady = leader if most == MOST_RIDES else NOBODY
    if not timed_in_turn(scene, state, np.array([second]), steady, most):
        return np.inf
    return -gained(scene, state, weight)


@inner
def _undo(scene: RideScene, state: OrderState) -> None:
    undo(scene.courses, scene.passages, scene.laws, state)


@inner
def _settle_best(
    scene: RideScene, state: OrderState, weight: Floats, passage: int, sight: SeenAhead
) -> bool:
    """Settle who passes first where two robots meet. Whether that could be."""
    behind, late = sooner_leader(scene, state, weight, passage)
    if late == np.inf:
        return False
    ahead = state.mate[behind]
    leader, second = scene.passages.other[behind], state.owner[behind]
    cost = _cost(scene, state, weight, behind, MOST_RIDES)
    if sight.share <= 0.0 and cost <= ASIDE_SHARE * late + ASIDE_S:
        return True
    cost += more_foreseen(scene, state, sight)
    _undo(scene, state)
    if state.movable[leader] and (cost == np.inf or weight[leader] == weight[second]):
        other_cost = _cost(scene, state, weight, ahead, MOST_RIDES)
        other_cost += more_foreseen(scene, state, sight)
        if other_cost < cost + chance_of(sight):
            return True
        _undo(scene, state)
    most = MOST_RIDES if cost < np.inf else MOST_RIDES_AT_LAST
    if _cost(scene, state, weight, behind, most) < np.inf:
        return True
    _undo(scene, state)
    if not state.movable[leader]:
        return False
    if _cost(scene, state, weight, ahead, most) < np.inf:
        return True
    _undo(scene, state)
    return False


@inner
def _settle_forced(scene: RideScene, state: OrderState) -> None:
    """Let robots leave before others pass their starts, and rest after others have passed there.

    Undone where robots would wait for each other in a circle by that.
    """
    courses, passages = scene.courses, scene.passages
    for p in range(passages.crossing.size):
        robot, other = state.owner[p], passages.other[p]
        rests = passages.exit[p] == courses.first[robot + 1] - 2
        rank = OPEN
        if passages.entry[p] == courses.first[robot]:
            rank = FIRST
        elif rests and not scene.rides.vanishes[robot]:
            rank = SECOND
        both = state.movable[robot] and state.movable[other]
        if rank != OPEN and state.rank[p] == OPEN and both:
            settle(state, p, rank)
    robots = np.flatnonzero(state.movable)
    if timed_in_turn(scene, state, robots, NOBODY, RIDES_EACH * robots.size):
        keep(state)
    else:
        _undo(scene, state)


@inner
def _leave_out(scene: RideScene, state: OrderState, robot: int) -> None:
    """Take a robot's law away, and time those anew whom it held up."""
    passages = scene.passages
    scene.laws.is_timed[robot] = False
    state.movable[robot] = False
    show_law(scene.courses, passages, scene.laws, state, robot, scene.courses.first[robot])
    held = np.zeros(state.movable.size, np.bool_)
    for p in range(passages.first[robot], passages.first[robot + 1]):
        other = passages.other[p]
        if state.movable[other] and state.binds[state.mate[p]]:
            held[other] = True
    robots = np.flatnonzero(held)
    if not timed_in_turn(scene, state, robots, NOBODY, MOST_RIDES_AT_LAST):
        _undo(scene, state)


@kernel
def first_come_laws(
    courses: PackedCourses, crossings: PackedCrossings, passages: PackedPassages,
    rides: PackedRides, laws: PackedLaws, weight: Floats, movable: Flags, sight: SeenAhead,
) -> int:  # fmt: skip
    """Give robots their laws all at once, by settling who passes first where they meet.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        passages: Of these.
        rides: PackedRides.
        laws: Of those that aren't movable, who have theirs; written to. Afterwards robots that wait
            for each other in a circle whatever the order have none.
        weight: What a second of a robot's lateness counts, (n,).
        movable: The robots that are to get laws, (n,).
        sight: How much counts what lies ahead, and what is left to chance; written to.

    Returns:
        How many nodes and passages were looked at.
    """
    scene = RideScene(courses, crossings, passages, rides, laws)
    for robot in range(movable.size):
        if movable[robot]:
            take_law(new_ride(courses, rides, robot), laws)
    state = new_order_state(courses, passages, laws, crossings.robots.shape[0], movable.copy())
    _settle_forced(scene, state)
    soonest = np.full(movable.size, np.inf)
    for robot in range(movable.size):
        if movable[robot]:
            soonest[robot] = next_meeting(scene, state, robot)[0]
    foresee_all(scene, state, movable, sight)
    while True:
        robot = int(np.argmin(soonest))
        if soonest[robot] == np.inf:
            break
        soonest[robot], passage = next_meeting(scene, state, robot)
        if passage < 0 or soonest[robot] > soonest.min():
            continue
        other = passages.other[passage]
        if not _settle_best(scene, state, weight, passage, sight):
            out = robot
            if movable[other] and weight[other] < weight[robot]:
                out = other
            _leave_out(scene, state, out)
            soonest[out] = np.inf
        for i in range(state.counts[TOUCHED]):
            one = state.touched[i]
            if state.has_law[one] and one not in (robot, other):
                soonest[one] = next_meeting(scene, state, one)[0]
        for one in (robot, other):
            if state.movable[one]:
                soonest[one] = next_meeting(scene, state, one)[0]
        foresee_touched(scene, state, sight)
        keep(state)
    return state.counts[WORK]
