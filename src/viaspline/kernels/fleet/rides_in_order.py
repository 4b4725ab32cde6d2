"""The laws of a fleet by orders that are given: who passes first, wherever two robots meet.

Every robot rides as if it were alone, except that it comes to a box after those have left it that
pass before it. Rides are reckoned anew, one after the other, until none changes. Where the orders
have no circle, each change leads on to later ones only, so this comes to an end.

Tested through ``fleet/lattice_order/test_time_in_order``.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.blocked_times import goes_from
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.ride_law import Ride, new_ride
from viaspline.kernels.fleet.yielding_ride import CLEAR, ride_past, take_law
from viaspline.kernels.jit import inner, kernel

SAME_S = 1e-9
"""By less than this a law doesn't change."""
UNSETTLED: Final = -2
"""A law that still changed in the last round."""


@inner
def _until_passed(
    courses: PackedCourses, crossings: PackedCrossings, laws: PackedLaws, second: Flags, robot: int
) -> Floats:
    """From when to when each box of a robot is blocked: until the other one has passed it [s]."""
    begin, end = crossings.box_first[robot], crossings.box_first[robot + 1]
    times = np.empty((end - begin, 2))
    for b in range(begin, end):
        if second[b]:
            times[b - begin, 0] = -np.inf
            times[b - begin, 1] = goes_from(courses, laws, crossings.other[b], crossings.high[b])
        else:
            times[b - begin, 0] = np.inf
            times[b - begin, 1] = -np.inf
    return times


@inner
def _differs(ride: Ride, laws: PackedLaws) -> bool:
    """Whether a ride has other times than the law that its robot has."""
    for k in range(ride.square.size):
        if abs(ride.arrive[k] - laws.arrive[ride.first + k]) > SAME_S:
            return True
    return abs(ride.leave[0] - laws.leave[ride.first]) > SAME_S


@kernel
def rides_in_order(
    courses: PackedCourses, crossings: PackedCrossings, rides: PackedRides, laws: PackedLaws,
    second: Flags, order: Ints, rounds: int,
) -> Ints:  # fmt: skip
    """Give all robots their laws, by the order in which they pass every box.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings; the boxes of a crossing in which a robot is first have another
            number than those in which it is second.
        rides: PackedRides.
        laws: They are written to.
        second: Whether the robot of a box passes after the other one, (boxes,).
        order: The robots in the order in which their rides are reckoned, (n,).
        rounds: How often, at most.

    Returns:
        For each robot -1, or the box in which it can't let the other robot pass, or -2 if its law
        still changed in the last round, (n,).
    """
    found = np.full(order.size, CLEAR, np.int64)
    for robot in order:
        take_law(new_ride(courses, rides, robot), laws)
    for _ in range(rounds):
        is_settled = True
        for robot in order:
            blocked = _until_passed(courses, crossings, laws, second, robot)
            ride, box = ride_past(courses, crossings, rides, robot, blocked)
            found[robot] = box
            if _differs(ride, laws):
                take_law(ride, laws)
                is_settled = False
                if box == CLEAR:
                    found[robot] = UNSETTLED
        if is_settled:
            break
    return found
