"""The law of one robot at its nodes while it is sought.

Tested through ``kernels/fleet/test_yielding_ride``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.jit import inner, uncounted

SAME_S = 1e-9
"""By less than this a law doesn't change."""


class Ride(NamedTuple):
    """The law of one robot while it is sought; all of its arrays are written to.

    Attributes:
        robot: Its number.
        first: Its first node.
        last: Its last node.
        square: Of its speed at its nodes [m²/s²], (m,).
        arrive: When it comes there [s], (m,).
        leave: When it goes on [s], (m,).
    """

    robot: int
    first: int
    last: int
    square: Floats
    arrive: Floats
    leave: Floats


@inner
def new_ride(courses: PackedCourses, rides: PackedRides, robot: int) -> Ride:
    """The ride of a robot as if it were alone."""
    first, last = courses.first[robot], courses.first[robot + 1] - 1
    count = last - first + 1
    ride = Ride(robot, first, last, np.empty(count), np.empty(count), np.empty(count))
    ride_alone(ride, rides)
    return ride


@uncounted
def ride_alone(ride: Ride, rides: PackedRides) -> None:
    """Let a robot ride as if it were alone."""
    end = ride.last - ride.first
    comes = rides.depart[ride.robot]
    for k in range(end):
        node = ride.first + k
        ride.square[k], ride.arrive[k] = rides.square[node], comes
        ride.leave[k] = comes + rides.stays[node]
        comes = ride.leave[k] + rides.lasts[node]
    ride.square[end], ride.arrive[end] = rides.square[ride.last], comes
    ride.leave[end] = comes + rides.stays[ride.last] if rides.vanishes[ride.robot] else np.inf


@uncounted
def copy_ride(ride: Ride, out: Ride, begin: int) -> None:
    """Copy a ride from a node on to another one of the same robot, which is as it is before."""
    for k in range(begin, ride.last - ride.first + 1):
        out.square[k] = ride.square[k]
        out.arrive[k], out.leave[k] = ride.arrive[k], ride.leave[k]


@uncounted
def first_change(ride: Ride, laws: PackedLaws) -> int:
    """The first node at which a ride has other times than the law of its robot; -1: none."""
    if abs(ride.leave[0] - laws.leave[ride.first]) > SAME_S:
        return 0
    for k in range(ride.last - ride.first + 1):
        if abs(ride.arrive[k] - laws.arrive[ride.first + k]) > SAME_S:
            return k
    return -1


@uncounted
def take_law(ride: Ride, laws: PackedLaws) -> None:
    """Write a ride into the laws of its fleet."""
    for k in range(ride.last - ride.first + 1):
        node = ride.first + k
        laws.arrive[node] = ride.arrive[k]
        laws.leave[node] = ride.leave[k]
        laws.speed[node] = math.sqrt(ride.square[k])
    laws.is_timed[ride.robot] = True
