"""Robots slowed down on a straight line: as late as asked, and within what they can do."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from straight_fleets import REACH, courses_on, rides_on

from viaspline.kernels.fleet.notches import LATER_S, can_slow_at, slow_down
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.ride_law import Ride, new_ride
from viaspline.kernels.jit import kernel


@kernel
def slowed(
    courses: PackedCourses, rides: PackedRides, centre: int, until: int, late: float
) -> tuple[Ride, Ride, int, bool]:
    """The ride of a robot that is alone, and the same slowed down, if it can be there."""
    alone, ride = new_ride(courses, rides, 0), new_ride(courses, rides, 0)
    can = can_slow_at(ride, courses, rides, centre)
    begin = slow_down(ride, courses, rides, centre, until, late) if can else -1
    return alone, ride, begin, can


@given(centre=st.integers(0, 60), more=st.integers(0, 15), late=st.floats(1e-6, 40.0))
@settings(max_examples=60, deadline=None)
def test_a_notch_delays_by_as_much_as_is_asked(centre: int, more: int, late: float) -> None:
    courses = courses_on([((0.0, 0.0), (30.0, 0.0))], REACH)
    until = min(centre + more, courses.distance.size - 1)
    alone, ride, begin, can = slowed(courses, rides_on(courses), centre, until, late)
    if not can:
        return
    after = ride.arrive if centre < until else ride.leave
    before = alone.arrive if centre < until else alone.leave
    if until < courses.distance.size - 1:
        assert -1e-12 <= after[until] - before[until] - late <= LATER_S + 1e-12
    assert (ride.arrive[: begin + 1] == alone.arrive[: begin + 1]).all()
    speed, lasts = np.sqrt(ride.square), ride.arrive[1:] - ride.leave[:-1]
    assert (ride.square <= alone.square).all()
    assert (ride.leave >= ride.arrive).all()
    rise = np.diff(ride.square) / (2.0 * np.diff(courses.distance))
    assert (np.abs(rise) <= 1.0 + 1e-9).all()
    drives = speed[1:] + speed[:-1] > 0.0
    takes = 2.0 * np.diff(courses.distance)[drives] / (speed[1:] + speed[:-1])[drives]
    assert lasts[drives] == pytest.approx(takes, abs=1e-9)
