"""The ride of a robot that comes to each crossing after those that pass it before.

It drives as if it were alone, except where it would come too early: there it is slowed down, if it
can with a running start, and where it then meets as few others as it can. Where it gives way to the
same ones by as much as in its last ride, it does as it did then.

Tested through ``kernels/fleet/test_first_come_laws``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.blocked_times import comes_in_cell, goes_in_cell, node_near
from viaspline.kernels.fleet.notches import can_slow_at, cut_notch, notch_for
from viaspline.kernels.fleet.order_state import SECOND, OrderState
from viaspline.kernels.fleet.ride_law import Ride, copy_ride, new_ride
from viaspline.kernels.fleet.yielding_ride import TIME_SLACK_S, RideScene, waits_at
from viaspline.kernels.jit import inner, uncounted

NEARLY_S = 1e-7
"""Who comes so little after it may is held up as well."""
ALL = 1 << 30
"""More meetings than there can be."""


@uncounted
def too_early(scene: RideScene, arrive: Floats, shift: int, first: int, passage: int) -> float:
    """How much too early a robot comes for letting the other one pass before it [s].

    Args:
        scene: What it rides among.
        arrive: When it comes to nodes [s].
        shift: Which node of the courses the first of these is.
        first: The first node of the robot.
        passage: Where the other one is to pass; infinite where that can't be.
    """
    courses, passages, laws = scene.courses, scene.passages, scene.laws
    if passages.entry[passage] == first:
        return np.inf  # it begins there
    other, k = passages.other[passage], passages.low[passage]
    begin, end = courses.first[other], courses.first[other + 1] - 1
    late = -np.inf
    for j in range(passages.box_first[passage], passages.box_first[passage + 1]):
        until = passages.interval[j, 1]
        k = node_near(courses.distance, begin, end, k, until)
        gone = goes_in_cell(courses, laws, other, k, until)
        late = max(late, gone - arrive[passages.cell[j] - shift])
    return late


@uncounted
def meets(
    scene: RideScene, window: Floats, arrive: Floats, leave: Floats, shift: int, first: int,
    last: int, passage: int,
) -> bool:  # fmt: skip
    """Whether a robot is in a box of a passage while the other one is there.

    Args:
        scene: What it rides among.
        window: See ``OrderState``.
        arrive: When it comes to nodes [s].
        leave: When it goes on [s].
        shift: Which node of the courses the first of these is.
        first: The first node of the robot.
        last: Its last node.
        passage: Where they may meet.
    """
    courses, passages, laws = scene.courses, scene.passages, scene.laws
    entry, after = passages.entry[passage], passages.exit[passage] + 1
    comes = arrive[entry - shift] if entry > first else -np.inf
    if comes >= window[passage, 1]:
        return False
    goes = arrive[after - shift] if after < last else leave[last - shift]
    if goes <= window[passage, 0]:
        return False
    other, low = passages.other[passage], passages.low[passage]
    begin, end, high = courses.first[other], courses.first[other + 1] - 1, low
    for j in range(passages.box_first[passage], passages.box_first[passage + 1]):
        cell, since, until = passages.cell[j], passages.interval[j, 0], passages.interval[j, 1]
        comes = arrive[cell - shift] if cell > first else -np.inf
        high = node_near(courses.distance, begin, end, high, until)
        if comes >= goes_in_cell(courses, laws, other, high, until):
            continue
        goes = arrive[cell + 1 - shift] if cell + 1 < last else leave[last - shift]
        low = node_near(courses.distance, begin, end, low, since)
        if goes > comes_in_cell(courses, laws, other, low, since):
            return True
    return False


@uncounted
def _meetings(
    scene: RideScene, state: OrderState, ride: Ride, begin: int, passage: int, most: int
) -> int:
    """How many others a ride meets after a node and before a passage; ``most`` is enough."""
    entry, reach = scene.passages.entry, state.reach
    until, since = entry[passage], ride.first + begin
    count, p = 0, passage - 1
    while p >= scene.passages.first[ride.robot] and reach[p] >= since and count < most:
        if (
            entry[p] < until
            and scene.passages.exit[p] >= since
            and meets(
                scene, state.window, ride.arrive, ride.leave, ride.first, ride.first, ride.last, p
            )
        ):
            count += 1
        p -= 1
    return count


@inner
def _give_way(
    scene: RideScene, state: OrderState, ride: Ride, tried: Ride, passage: int, late: float
) -> tuple[int, float, float]:
    """Slow a ride down so that it comes later to a passage, and meets few before that.

    Args:
        scene: What it rides among.
        state: What the others do.
        ride: It is written to.
        tried: The same ride; it is written to alike.
        passage: Where the other one passes first.
        late: How much too early the ride comes there [s].

    Returns:
        The notch that does it: see ``cut_notch``; its centre is -1 where there is none.
    """
    courses, rides = scene.courses, scene.rides
    entry = scene.passages.entry[passage] - ride.first
    places = waits_at(ride, courses, rides, entry)
    if places.size == 0:
        return -1, 0.0, 0.0
    centre, floor, wait, fewest = places[0], 0.0, 0.0, ALL
    for place in places:
        low, stands = notch_for(ride, courses, rides, place, entry, late + TIME_SLACK_S)
        begin = cut_notch(tried, courses, rides, place, low, stands)
        met = _meetings(scene, state, tried, begin, passage, fewest)
        copy_ride(ride, tried, begin)
        if met < fewest:
            centre, floor, wait, fewest = place, low, stands, met
        if met == 0:
            break
    cut_notch(ride, courses, rides, centre, floor, wait)
    cut_notch(tried, courses, rides, centre, floor, wait)
    return centre, floor, wait


@inner
def _wait_before(scene: RideScene, ride: Ride, entry: int, late: float) -> bool:
    """Slow a ride down right before a node, wherever it meets others by that, if it can be."""
    courses, rides = scene.courses, scene.rides
    places = waits_at(ride, courses, rides, entry)
    if places.size == 0:
        return False
    back, centre = places[0], entry
    while centre > back and not can_slow_at(ride, courses, rides, centre):
        centre -= 1
    floor, wait = notch_for(ride, courses, rides, centre, entry, late + TIME_SLACK_S)
    cut_notch(ride, courses, rides, centre, floor, wait)
    return True


@inner
def ride_in_turn(
    scene: RideScene, state: OrderState, robot: int, is_near: bool
) -> tuple[Ride, bool]:
    """The ride of a robot after all that pass before it.

    Args:
        scene: What it rides among.
        state: Who passes before it; ``binds`` of the robot is written to, and where it gave way.
        robot: Which one.
        is_near: Whether it waits as near to crossings as it can.

    Returns:
        (ride, whether it comes after all of them).
    """
    courses, passages, window = scene.courses, scene.passages, state.window
    ride = new_ride(courses, scene.rides, robot)
    tried = ride
    first, log, is_as_before = ride.first, passages.first[robot], not is_near
    count, known = 0, state.given[robot]
    state.given[robot] = 0
    for p in range(passages.first[robot], passages.first[robot + 1]):
        state.binds[p] = False
        if state.rank[p] != SECOND or window[p, 1] == -np.inf:
            continue
        entry = passages.entry[p] - first
        if entry > 0 and window[p, 1] <= ride.arrive[entry]:
            continue
        late = too_early(scene, ride.arrive, first, first, p)
        if math.isinf(late):
            return ride, False
        state.binds[p] = late > -NEARLY_S
        if late <= 0.0:
            continue
        if is_near:
            if not _wait_before(scene, ride, entry, late):
                return ride, False
            continue
        k = log + count
        is_known = is_as_before and count < known and state.gave[k] == p
        if is_known and state.gave_by[k, 0] == late:
            cut_notch(
                ride, courses, scene.rides, state.gave_at[k], state.gave_by[k, 1],
                state.gave_by[k, 2],
            )  # fmt: skip
        else:
            if is_as_before:
                is_as_before = False
                tried = new_ride(courses, scene.rides, robot)
                copy_ride(ride, tried, 0)
            centre, floor, wait = _give_way(scene, state, ride, tried, p, late)
            if centre < 0:
                return ride, False
            state.gave[k], state.gave_at[k], state.gave_by[k, 0] = p, centre, late
            state.gave_by[k, 1], state.gave_by[k, 2] = floor, wait
        count += 1
    state.given[robot] = count
    return ride, True
