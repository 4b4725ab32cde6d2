"""Laws of robots one after the other, as long as that may be better than what there is."""

from __future__ import annotations

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.ride_law import take_law
from viaspline.kernels.fleet.yielding_ride import CLEAR, RideScene, patient_ride
from viaspline.kernels.jit import kernel


@kernel
def sooner_in_order(
    courses: PackedCourses, crossings: PackedCrossings, passages: PackedPassages,
    rides: PackedRides, laws: PackedLaws, order: Ints, spare: Floats, room: float,
) -> bool:  # fmt: skip
    """Give robots their laws as ``timed_in_order``, if all get one and are little late by them.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        passages: Of these.
        rides: PackedRides.
        laws: They are written to.
        order: The robots, none of which has a law, (m,).
        spare: What a second counts by which a robot is later than if it were alone, (n,).
        room: What all of that may count [s].

    Returns:
        Whether that is so; else the laws are those of some of the robots.
    """
    scene = RideScene(courses, crossings, passages, rides, laws)
    for robot in order:
        ride, box = patient_ride(scene, robot)
        if box != CLEAR:
            return False
        late = ride.arrive[ride.last - ride.first] - rides.depart[robot]
        for node in range(ride.first, ride.last):
            late -= rides.stays[node] + rides.lasts[node]
        room -= spare[robot] * late
        if room < 0.0:
            return False
        take_law(ride, laws)
    return True
