"""The earliest ride of one robot among others that have their laws: whom does it let pass?

At first it drives as if it were alone. Where it would be in a crossing while another is there, it
lets that one pass: it is slowed down so that it comes to the crossing when the other has left it,
if it can with a running start, so that no more is lost than has to be. Where it would be in another
one's way while it waits, it waits elsewhere, or lets that one pass as well. Each crossing is given
way to at most once, so this comes to an end; and where neither a start nor a resting place of a
robot lies in a crossing, waiting at home until all have passed is always left.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.blocked_times import blocked_times
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.ride_law import (
    Ride,
    can_slow_at,
    forget_notches,
    new_ride,
    set_times,
    slow_down,
)
from viaspline.kernels.jit import inner, kernel

CLEAR: Final = -1
"""No box is in the way."""
TIME_SLACK_S = 1e-9
"""So much later than needed a robot comes to a crossing: for rounding."""
STEPS_BACK = 8
"""Places farther back at which it is tried to wait: so many, up to the start."""
STEPS_AHEAD = 4
"""Places nearer to the crossing than a running start takes."""


@inner
def _blocking(ride: Ride, crossings: PackedCrossings, blocked: Floats, before: int) -> int:
    """The first box in which a ride is while another robot is there, in cells before a node."""
    begin = crossings.box_first[ride.robot]
    end = ride.square.size - 1
    for b in range(blocked.shape[0]):
        k = crossings.cell[begin + b] - ride.first
        if k >= before:
            break
        comes = ride.arrive[k] if k > 0 else -np.inf
        goes = ride.arrive[k + 1] if k + 1 < end else ride.leave[end]
        if comes < blocked[b, 1] and goes > blocked[b, 0]:
            return b
    return CLEAR


@inner
def _lateness(
    ride: Ride, crossings: PackedCrossings, blocked: Floats, crossing: int
) -> tuple[int, float]:
    """The first node of a crossing, and how much too early the ride is for letting others pass."""
    begin = crossings.box_first[ride.robot]
    entry, late = -1, 0.0
    for b in range(blocked.shape[0]):
        if crossings.crossing[begin + b] == crossing:
            k = crossings.cell[begin + b] - ride.first
            if entry < 0:
                entry = k
            late = max(late, blocked[b, 1] - ride.arrive[k])
    return entry, late


@inner
def _running_start(ride: Ride, courses: PackedCourses, rides: PackedRides, entry: int) -> int:
    """Where a robot can stand so that it comes to a node as fast as it does now."""
    room = ride.square[entry] / (2.0 * rides.accel[ride.robot])
    place = courses.distance[ride.first + entry] - room
    k = entry
    while k > 0 and courses.distance[ride.first + k] > place:
        k -= 1
    return k


@inner
def waits_at(ride: Ride, courses: PackedCourses, rides: PackedRides, entry: int) -> Ints:
    """Nodes at which it can be slowed down for a crossing, the best first."""
    best = _running_start(ride, courses, rides, entry)
    places = np.empty(STEPS_BACK + STEPS_AHEAD + 2, np.int64)
    places[0] = best
    count = 1
    for i in range(1, STEPS_BACK + 1):  # ever farther back: so near the start as i² has it
        places[count] = best - (best * i * i) // (STEPS_BACK * STEPS_BACK)
        count += 1
    for i in range(1, STEPS_AHEAD + 1):
        places[count] = best + ((entry - best) * i) // STEPS_AHEAD
        count += 1
    kept = 0
    for i in range(count):
        k = places[i]
        for near in (k, k - 1, k + 1):  # beside a rest it stands at the rest
            if 0 <= near <= entry and can_slow_at(ride, courses, rides, near):
                if kept == 0 or places[kept - 1] != near:
                    places[kept] = near
                    kept += 1
                break
    if kept == 0:  # it waits at its last rest
        k = entry
        while ride.square[k] > 0.0:
            k -= 1
        places[0], kept = k, 1
    return places[:kept]


@inner
def _give_way(
    ride: Ride, courses: PackedCourses, rides: PackedRides, crossings: PackedCrossings,
    blocked: Floats, entry: int, late: float,
) -> None:  # fmt: skip
    """Slow a ride down so that it comes later to a crossing, clear of all before it if it can."""
    places = waits_at(ride, courses, rides, entry)
    square, waits = ride.square.copy(), ride.waits.copy()
    for i in range(places.size + 1):  # after the last one, the first again
        slow_down(ride, courses, rides, places[i % places.size], entry, late + TIME_SLACK_S)
        if i == places.size or _blocking(ride, crossings, blocked, entry) == CLEAR:
            return
        for k in range(square.size):
            ride.square[k], ride.waits[k] = square[k], waits[k]
        set_times(ride, courses, rides, 0)


@inner
def yielding_ride(
    courses: PackedCourses, crossings: PackedCrossings, rides: PackedRides, laws: PackedLaws,
    robot: int,
) -> tuple[Ride, int]:  # fmt: skip
    """The ride of a robot among those that have their law.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        rides: PackedRides.
        laws: Of the others.
        robot: Which has none.

    Returns:
        The ride, and -1; or a ride that isn't clear, and the number of a box in which it can't let
        the other one pass.
    """
    ride = new_ride(courses, rides, robot)
    begin = crossings.box_first[robot]
    blocked = blocked_times(courses, crossings, laws, robot)
    yields = np.empty(blocked.shape[0], np.int64)  # crossings, in the order of their first cells
    count = 0
    while True:
        box = _blocking(ride, crossings, blocked, ride.square.size)
        if box == CLEAR:
            return ride, CLEAR
        crossing = crossings.crossing[begin + box]
        entry, late = _lateness(ride, crossings, blocked, crossing)
        if entry == 0 or math.isinf(late) or (yields[:count] == crossing).any():
            return ride, begin + box
        yields[count] = crossing
        count += 1
        k = count - 1
        while k > 0 and _lateness(ride, crossings, blocked, yields[k - 1])[0] > entry:
            yields[k - 1], yields[k] = yields[k], yields[k - 1]
            k -= 1
        forget_notches(ride, courses, rides)
        for i in range(count):
            entry, late = _lateness(ride, crossings, blocked, yields[i])
            if late > 0.0:
                _give_way(ride, courses, rides, crossings, blocked, entry, late)


@inner
def take_law(ride: Ride, laws: PackedLaws) -> None:
    """Write a ride into the laws of its fleet."""
    for k in range(ride.square.size):
        node = ride.first + k
        laws.arrive[node] = ride.arrive[k]
        laws.leave[node] = ride.leave[k]
        laws.speed[node] = math.sqrt(ride.square[k])
    laws.is_timed[ride.robot] = True


@kernel
def timed_in_order(
    courses: PackedCourses, crossings: PackedCrossings, rides: PackedRides, laws: PackedLaws,
    order: Ints,
) -> Ints:  # fmt: skip
    """Give robots their laws, one after the other, each among those that have theirs by then.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        rides: PackedRides.
        laws: They are written to.
        order: The robots, none of which has a law, (m,).

    Returns:
        For each of these -1, or the box in which it can't let another robot pass: then it has no
        law, (m,).
    """
    found = np.empty(order.size, np.int64)
    for i in range(order.size):
        ride, found[i] = yielding_ride(courses, crossings, rides, laws, order[i])
        if found[i] == CLEAR:
            take_law(ride, laws)
    return found
