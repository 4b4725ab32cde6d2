"""Slowing a robot down round one node, so that it comes to a later one as late as it has to.

A *notch* slows a robot down round one node, its centre: it brakes to a low speed there, stands if
that isn't enough, and speeds up again. Of two laws the lower one, node by node, keeps what both
keep: how much faster or slower it gets on the way, and the largest speeds. So notches add up.
"""

from __future__ import annotations

import math

from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.ride_law import Ride
from viaspline.kernels.jit import inlined, uncounted

LATER_S = 1e-9
"""By so much more than it should a notch may delay."""
MOST_TRIES = 60
"""Of speeds, until a notch delays by as much as it should."""


@inlined
def _notched(
    ride: Ride, courses: PackedCourses, rides: PackedRides, centre: int, floor: float, k: int
) -> float:
    """The square of the speed at node k with a notch that goes down to ``floor``."""
    along = courses.distance[ride.first + k] - courses.distance[ride.first + centre]
    rise = rides.accel[ride.robot] if along > 0.0 else rides.brake[ride.robot]
    return min(ride.square[k], floor + 2.0 * rise * abs(along))


@uncounted
def _delay(
    ride: Ride, courses: PackedCourses, rides: PackedRides, centre: int, floor: float, until: int
) -> float:
    """How much later a notch brings the robot to node ``until`` [s], however long it stands."""
    late = 0.0
    for way in (-1, 1):
        k = centre
        near = _notched(ride, courses, rides, centre, floor, k)
        slow = math.sqrt(near)
        while (k > 0) if way < 0 else (k < until):
            far = _notched(ride, courses, rides, centre, floor, k + way)
            if near == ride.square[k] and far == ride.square[k + way]:
                break
            begin = min(k, k + way)
            node = ride.first + begin
            width = courses.distance[node + 1] - courses.distance[node]
            fast = math.sqrt(far)
            late += 2.0 * width / (slow + fast) - (ride.arrive[begin + 1] - ride.leave[begin])
            near, slow = far, fast
            k += way
    return late


@uncounted
def can_slow_at(ride: Ride, courses: PackedCourses, rides: PackedRides, centre: int) -> bool:
    """Whether a robot can be slowed down to rest at a node."""
    if ride.square[centre] == 0.0:
        return True
    if rides.keeps_pace[ride.robot] or centre == 0 or centre == ride.last - ride.first:
        return False
    if ride.square[centre - 1] == 0.0 or ride.square[centre + 1] == 0.0:
        return False  # it would have to stand at both
    return _notched(ride, courses, rides, centre, 0.0, 0) >= ride.square[0]


@uncounted
def notch_for(
    ride: Ride, courses: PackedCourses, rides: PackedRides, centre: int, until: int, late: float
) -> tuple[float, float]:
    """How low a notch has to be for the robot to come to a node so much later.

    The delay goes nearly with the square of what is taken from the speed: so its root is looked
    for by false position (Dowell and Jarratt, BIT 1971), from both sides.

    Args:
        ride: The ride, without the notch.
        courses: PackedCourses.
        rides: PackedRides.
        centre: Where the robot is slowest, at ``until`` or before it.
        until: The node.
        late: By how much [s].

    Returns:
        The square of the speed at its centre [m²/s²], and how long it stands there [s].
    """
    if ride.square[centre] == 0.0:
        return 0.0, late
    most = _delay(ride, courses, rides, centre, 0.0, until)
    if most <= late:
        return 0.0, late - most
    aim = math.sqrt(late + 0.5 * LATER_S)
    low, high = 0.0, math.sqrt(ride.square[centre])
    above, below = math.sqrt(most) - aim, -aim
    side = 0
    for _ in range(MOST_TRIES):
        speed = (high * above - low * below) / (above - below)
        delay = _delay(ride, courses, rides, centre, speed * speed, until)
        if delay >= late:
            low, above = speed, math.sqrt(delay) - aim
            if delay <= late + LATER_S:
                break
            below = 0.5 * below if side > 0 else below
            side = 1
        else:
            high, below = speed, math.sqrt(max(delay, 0.0)) - aim
            above = 0.5 * above if side < 0 else above
            side = -1
    return low * low, 0.0


@uncounted
def cut_notch(
    ride: Ride, courses: PackedCourses, rides: PackedRides, centre: int, floor: float, wait: float
) -> int:
    """Slow a ride down by a notch.

    Args:
        ride: It is written to.
        courses: PackedCourses.
        rides: PackedRides.
        centre: Where the robot is slowest.
        floor: The square of its speed there, unless it is slower anyway [m²/s²].
        wait: How long it stands there [s].

    Returns:
        The last node at which its times of arrival are as before, and those before it.
    """
    last = ride.last - ride.first
    begin = end = centre
    if floor < ride.square[centre]:
        for way in (-1, 1):
            k = centre + way
            while 0 <= k <= last:
                low = _notched(ride, courses, rides, centre, floor, k)
                if low == ride.square[k]:
                    break
                ride.square[k] = low
                k += way
            if way < 0:
                begin = max(k, 0)
            else:
                end = min(k, last)
        ride.square[centre] = floor
        before = ride.arrive[end]
        slow, going = math.sqrt(ride.square[begin]), ride.leave[begin]
        for k in range(begin + 1, end + 1):
            node = ride.first + k
            width = courses.distance[node] - courses.distance[node - 1]
            fast, stays = math.sqrt(ride.square[k]), ride.leave[k] - ride.arrive[k]
            ride.arrive[k] = going + 2.0 * width / (slow + fast)
            going = ride.arrive[k] + stays + (wait if k == centre else 0.0)
            ride.leave[k], slow = going, fast
        shift = ride.arrive[end] - before
    else:
        shift = wait
        ride.leave[end] += wait
    for k in range(end + 1, last + 1):
        ride.arrive[k] += shift
        ride.leave[k] += shift
    return begin


@uncounted
def slow_down(
    ride: Ride, courses: PackedCourses, rides: PackedRides, centre: int, until: int, late: float
) -> int:
    """Delay a ride by a notch so that it comes to node ``until`` so much later.

    Args:
        ride: It is written to.
        courses: PackedCourses.
        rides: PackedRides.
        centre: Where the robot is slowest, at ``until`` or before it.
        until: The node.
        late: By how much [s].

    Returns:
        As ``cut_notch``.
    """
    floor, wait = notch_for(ride, courses, rides, centre, until, late)
    return cut_notch(ride, courses, rides, centre, floor, wait)
