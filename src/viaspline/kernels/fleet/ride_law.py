"""The law of one robot at its nodes: its times from its speeds, slowed down by notches.

A *notch* slows a robot down round one node: it brakes to a low speed there, stands if that isn't
enough, and speeds up again. Of two laws the lower one, node by node, keeps what both keep: how much
faster or slower it gets on the way, and the largest speeds. So notches add up.

Tested through ``kernels/fleet/test_yielding_ride``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.jit import inner

HALVINGS = 40
"""Of the square of a speed, until a notch delays by as much as it should."""


class Ride(NamedTuple):
    """The law of one robot while it is sought; all of its arrays are written to.

    Attributes:
        robot: Its number.
        first: Its first node.
        last: Its last node.
        square: Of its speed at its nodes [m²/s²], (m,).
        waits: How long it stands there beyond what it has to [s], (m,).
        arrive: When it comes there [s], (m,).
        leave: When it goes on [s], (m,).
    """

    robot: int
    first: int
    last: int
    square: Floats
    waits: Floats
    arrive: Floats
    leave: Floats


@inner
def new_ride(courses: PackedCourses, rides: PackedRides, robot: int) -> Ride:
    """The ride of a robot as if it were alone."""
    first, last = courses.first[robot], courses.first[robot + 1] - 1
    count = last - first + 1
    ride = Ride(
        robot, first, last, np.empty(count), np.empty(count), np.empty(count), np.empty(count)
    )
    forget_notches(ride, courses, rides)
    return ride


@inner
def forget_notches(ride: Ride, courses: PackedCourses, rides: PackedRides) -> None:
    """The ride as if the robot were alone, again."""
    for k in range(ride.square.size):
        ride.square[k] = rides.square[ride.first + k]
        ride.waits[k] = 0.0
    ride.arrive[0] = rides.depart[ride.robot]
    set_times(ride, courses, rides, 0)


@inner
def cell_lasts(ride: Ride, courses: PackedCourses, rides: PackedRides, k: int) -> float:
    """How long the cell from node k of a ride takes [s]."""
    node = ride.first + k
    here, there = ride.square[k], ride.square[k + 1]
    if here == rides.square[node] and there == rides.square[node + 1]:
        return rides.lasts[node]
    width = courses.distance[node + 1] - courses.distance[node]
    return 2.0 * width / (math.sqrt(here) + math.sqrt(there))


@inner
def set_times(ride: Ride, courses: PackedCourses, rides: PackedRides, start: int) -> None:
    """Reckon the times anew from node ``start`` on."""
    end = ride.square.size - 1
    for k in range(start, end):
        ride.leave[k] = ride.arrive[k] + rides.stays[ride.first + k] + ride.waits[k]
        ride.arrive[k + 1] = ride.leave[k] + cell_lasts(ride, courses, rides, k)
    stays = rides.stays[ride.first + end] if rides.vanishes[ride.robot] else np.inf
    ride.leave[end] = ride.arrive[end] + stays


@inner
def _notched(
    ride: Ride, courses: PackedCourses, rides: PackedRides, centre: int, floor: float, k: int
) -> float:
    """The square of the speed at node k with a notch that goes down to ``floor``."""
    along = courses.distance[ride.first + k] - courses.distance[ride.first + centre]
    rise = rides.accel[ride.robot] if along > 0.0 else rides.brake[ride.robot]
    return min(ride.square[k], floor + 2.0 * rise * abs(along))


@inner
def _delay(
    ride: Ride, courses: PackedCourses, rides: PackedRides, centre: int, floor: float, until: int
) -> float:
    """How much later a notch brings the robot to node ``until`` [s], however long it stands."""
    late = 0.0
    for way in (-1, 1):
        k = centre
        while (k > 0) if way < 0 else (k < until):
            near = _notched(ride, courses, rides, centre, floor, k)
            far = _notched(ride, courses, rides, centre, floor, k + way)
            if near == ride.square[k] and far == ride.square[k + way]:
                break
            begin = min(k, k + way)
            node = ride.first + begin
            width = courses.distance[node + 1] - courses.distance[node]
            both = math.sqrt(near) + math.sqrt(far)
            late += 2.0 * width / both - cell_lasts(ride, courses, rides, begin)
            k += way
    return late


@inner
def can_slow_at(ride: Ride, courses: PackedCourses, rides: PackedRides, centre: int) -> bool:
    """Whether a robot can be slowed down to rest at a node."""
    if ride.square[centre] == 0.0:
        return True
    if rides.keeps_pace[ride.robot] or centre == 0 or centre == ride.square.size - 1:
        return False
    if ride.square[centre - 1] == 0.0 or ride.square[centre + 1] == 0.0:
        return False  # it would have to stand at both
    return _notched(ride, courses, rides, centre, 0.0, 0) >= ride.square[0]


@inner
def slow_down(
    ride: Ride, courses: PackedCourses, rides: PackedRides, centre: int, until: int, late: float
) -> None:
    """Delay a ride by a notch so that it comes to node ``until`` so much later.

    Args:
        ride: It is written to.
        courses: PackedCourses.
        rides: PackedRides.
        centre: Where the robot is slowest, at ``until`` or before it.
        until: The node.
        late: By how much [s].
    """
    if ride.square[centre] == 0.0:
        ride.waits[centre] += late
        set_times(ride, courses, rides, centre)
        return
    floor, most = 0.0, _delay(ride, courses, rides, centre, 0.0, until)
    if most > late:
        high = ride.square[centre]
        for _ in range(HALVINGS):
            middle = 0.5 * (floor + high)
            if _delay(ride, courses, rides, centre, middle, until) >= late:
                floor = middle
            else:
                high = middle
    begin = centre
    for way in (-1, 1):
        k = centre + way
        while 0 <= k < ride.square.size:
            low = _notched(ride, courses, rides, centre, floor, k)
            if low == ride.square[k]:
                break
            ride.square[k] = low
            begin = min(begin, k)
            k += way
    ride.square[centre] = floor
    if most < late:
        ride.waits[centre] += late - most
    set_times(ride, courses, rides, max(begin - 1, 0))
