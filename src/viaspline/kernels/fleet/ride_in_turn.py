"""The ride of a robot that comes to each crossing after those that pass it before.

It drives as if it were alone, except where it would come too early: there it is slowed down, if it
can with a running start, and where it then meets as few others as it can.

Tested through ``kernels/fleet/test_first_come_laws``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.blocked_times import comes_between, goes_between
from viaspline.kernels.fleet.order_state import OrderState
from viaspline.kernels.fleet.ride_law import Ride, can_slow_at, new_ride, slow_down
from viaspline.kernels.fleet.yielding_ride import TIME_SLACK_S, RideScene, waits_at
from viaspline.kernels.jit import inner

NEARLY_S = 1e-7
"""Who comes so little after it may is held up as well."""
ALL = 1 << 30
"""More meetings than there can be."""


@inner
def too_early(scene: RideScene, arrive: Floats, first: int, passage: int) -> float:
    """How much too early a robot comes for letting the other one pass before it [s].

    Args:
        scene: What it rides among.
        arrive: When it comes to its nodes [s], (m,).
        first: The first one of these.
        passage: Where the other one is to pass; infinite where that can't be.
    """
    crossings, passages = scene.crossings, scene.passages
    if passages.entry[passage] == first:
        return np.inf  # it begins there
    other, low, after = passages.other[passage], passages.low[passage], passages.high[passage] + 1
    late = -np.inf
    for j in range(passages.box_first[passage], passages.box_first[passage + 1]):
        b = passages.box[j]
        gone = goes_between(scene.courses, scene.laws, other, low, after, crossings.high[b])
        late = max(late, gone - arrive[crossings.cell[b] - first])
    return late


@inner
def meets(scene: RideScene, arrive: Floats, leave: Floats, first: int, passage: int) -> bool:
    """Whether a robot is in a box of a passage while the other one is there.

    Args:
        scene: What it rides among.
        arrive: When it comes to its nodes [s], (m,).
        leave: When it goes on [s], (m,).
        first: The first one of these.
        passage: Where they may meet.
    """
    courses, crossings, passages = scene.courses, scene.crossings, scene.passages
    other, low, after = passages.other[passage], passages.low[passage], passages.high[passage] + 1
    laws, end = scene.laws, arrive.size - 1
    if not laws.is_timed[other]:
        return False
    k, last = passages.entry[passage] - first, passages.exit[passage] - first
    comes = arrive[k] if k > 0 else -np.inf
    goes = arrive[last + 1] if last + 1 < end else leave[end]
    there = laws.arrive[low] if low > courses.first[other] else -np.inf
    gone = laws.leave[after] if after == courses.first[other + 1] - 1 else laws.arrive[after]
    if comes >= gone or goes <= there:
        return False
    for j in range(passages.box_first[passage], passages.box_first[passage + 1]):
        b = passages.box[j]
        k = crossings.cell[b] - first
        comes = arrive[k] if k > 0 else -np.inf
        goes = arrive[k + 1] if k + 1 < end else leave[end]
        if (
            comes < goes_between(courses, laws, other, low, after, crossings.high[b])
            and goes > comes_between(courses, laws, other, low, after, crossings.low[b])
        ):  # fmt: skip
            return True
    return False


@inner
def _meetings(scene: RideScene, ride: Ride, since: int, entry: int, most: int) -> int:
    """How many others a ride meets between two nodes; ``most`` is enough."""
    count = 0
    for p in range(scene.passages.first[ride.robot], scene.passages.first[ride.robot + 1]):
        if scene.passages.entry[p] - ride.first >= entry or count >= most:
            break
        if scene.passages.exit[p] - ride.first < since:
            continue
        if meets(scene, ride.arrive, ride.leave, ride.first, p):
            count += 1
    return count


@inner
def _give_way(scene: RideScene, ride: Ride, entry: int, late: float) -> None:
    """Slow a ride down so that it comes later to a node, and meets few before that."""
    courses, rides = scene.courses, scene.rides
    places = waits_at(ride, courses, rides, entry)
    square, waits = ride.square.copy(), ride.waits.copy()
    arrive, leave = ride.arrive.copy(), ride.leave.copy()
    best, fewest = 0, ALL
    for i in range(places.size):
        slow_down(ride, courses, rides, places[i], entry, late)
        since = 0  # from where on the robot is later than before
        while ride.square[since] == square[since] and ride.waits[since] == waits[since]:
            since += 1
        met = _meetings(scene, ride, max(since - 1, 0), entry, fewest)
        if met == 0:
            return
        if met < fewest:
            best, fewest = i, met
        for k in range(max(since - 1, 0), square.size):
            ride.square[k], ride.waits[k] = square[k], waits[k]
            ride.arrive[k], ride.leave[k] = arrive[k], leave[k]
    slow_down(ride, courses, rides, places[best], entry, late)


@inner
def _wait_before(scene: RideScene, ride: Ride, entry: int, late: float) -> None:
    """Slow a ride down right before a node, wherever it meets others by that."""
    courses, rides = scene.courses, scene.rides
    back, centre = waits_at(ride, courses, rides, entry)[0], entry
    while centre > back and not can_slow_at(ride, courses, rides, centre):
        centre -= 1
    slow_down(ride, courses, rides, centre, entry, late)


@inner
def ride_in_turn(
    scene: RideScene, state: OrderState, robot: int, is_near: bool
) -> tuple[Ride, bool]:
    """The ride of a robot after all that pass before it.

    Args:
        scene: What it rides among.
        state: Who passes before it; ``binds`` of the robot is written to.
        robot: Which one.
        is_near: Whether it waits as near to crossings as it can.

    Returns:
        (ride, whether it comes after all of them).
    """
    courses, passages, laws = scene.courses, scene.passages, scene.laws
    ride = new_ride(courses, scene.rides, robot)
    for p in range(passages.first[robot], passages.first[robot + 1]):
        other = passages.other[p]
        state.binds[p] = False
        if state.leader[passages.crossing[p]] != other or not laws.is_timed[other]:
            continue
        after = passages.high[p] + 1
        gone = laws.leave[after] if after == courses.first[other + 1] - 1 else laws.arrive[after]
        entry = passages.entry[p] - ride.first
        if entry > 0 and gone <= ride.arrive[entry]:
            continue
        late = too_early(scene, ride.arrive, ride.first, p)
        if math.isinf(late):
            return ride, False
        state.binds[p] = late > -NEARLY_S
        if late > 0.0 and is_near:
            _wait_before(scene, ride, entry, late + TIME_SLACK_S)
        elif late > 0.0:
            _give_way(scene, ride, entry, late + TIME_SLACK_S)
    return ride, True
