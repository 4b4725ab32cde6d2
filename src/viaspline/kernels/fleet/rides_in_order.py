"""The laws of a fleet by orders that are given: who passes first, wherever two robots meet.

Every robot rides as if it were alone, except that it comes to a box after those have left it that
pass before it. Rides are reckoned anew, one after the other, until none changes. Where the orders
have no circle there are such laws: in the end each robot waits right before it has to.

Tested through ``fleet/lattice_order/test_time_in_order``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints, Steps
from viaspline.kernels.fleet.blocked_times import goes_in_cell, node_before
from viaspline.kernels.fleet.notches import can_slow_at, slow_down
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.ride_law import Ride, first_change, new_ride, take_law
from viaspline.kernels.fleet.yielding_ride import waits_at
from viaspline.kernels.jit import inner, kernel

SLACK_S = 1e-9
"""So much later than it may a robot comes to a node, for rounding."""
PATIENT_RIDES = 10
"""So often a ride changes before its robot waits right before it has to, if there are rounds."""


@inner
def _releases(
    courses: PackedCourses, crossings: PackedCrossings, laws: PackedLaws, second: Flags,
    awaited: Steps, robot: int,
) -> Floats:  # fmt: skip
    """When a robot may be at each of its nodes at the earliest [s], (nodes of the robot,)."""
    first = courses.first[robot]
    times = np.full(courses.first[robot + 1] - first, -np.inf)
    for b in range(crossings.box_first[robot], crossings.box_first[robot + 1]):
        if second[b]:
            gone = goes_in_cell(courses, laws, crossings.other[b], awaited[b], crossings.high[b])
            k = crossings.cell[b] - first
            times[k] = max(times[k], gone)
    return times


@inner
def _awaited(courses: PackedCourses, crossings: PackedCrossings, second: Flags) -> Steps:
    """The last node before each box's end on the path of who passes first; 0 elsewhere, (boxes,).

    Rides are reckoned many times, and paths stay as they are.
    """
    awaited = np.zeros(second.size, np.int32)
    for b in np.flatnonzero(second):
        first, last = courses.first[crossings.other[b]], courses.first[crossings.other[b] + 1] - 1
        awaited[b] = node_before(courses.distance, first, last, crossings.high[b])
    return awaited


@inner
def _ride_after(
    courses: PackedCourses, rides: PackedRides, robot: int, releases: Floats, near: bool
) -> tuple[Ride, bool]:
    """The ride of a robot that comes to none of its nodes too early, and whether there is one.

    With ``near`` it waits right there, else farther back, so that it comes there under way.
    """
    ride = new_ride(courses, rides, robot)
    if releases[0] > -np.inf:
        return ride, False
    for k in range(1, ride.square.size):
        late = releases[k] + SLACK_S - ride.arrive[k]
        if late == np.inf:
            return ride, False
        if late > 0.0:
            places = waits_at(ride, courses, rides, k)
            if places.size == 0:
                return ride, False
            centre, back = places[0], k
            while near and back > centre and not can_slow_at(ride, courses, rides, back):
                back -= 1
            slow_down(ride, courses, rides, back if near else centre, k, late)
    return ride, True


@kernel
def rides_in_order(
    courses: PackedCourses, crossings: PackedCrossings, rides: PackedRides, laws: PackedLaws,
    second: Flags, order: Ints, rounds: int,
) -> Flags:  # fmt: skip
    """Give all robots their laws, by the order in which they pass every box.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        rides: PackedRides.
        laws: They are written to.
        second: Whether the robot of a box passes after the other one, (boxes,).
        order: Robots in the order in which their rides are reckoned, (m,); the others get none,
            and nobody may pass after them.
        rounds: How often, at most; in the second half all wait right before they have to.

    Returns:
        Whether the law of each robot keeps the order, (n,).
    """
    robots = courses.first.size - 1
    keeps = np.ones(robots, np.bool_)
    for robot in order:
        take_law(new_ride(courses, rides, robot), laws)
    awaited = _awaited(courses, crossings, second)
    is_due, changes = np.ones(robots, np.bool_), np.zeros(robots, np.int64)
    for k in range(rounds):
        is_settled = True
        for robot in order:
            if not is_due[robot]:
                continue
            is_due[robot] = False
            is_near = changes[robot] > PATIENT_RIDES or 2 * k >= rounds
            releases = _releases(courses, crossings, laws, second, awaited, robot)
            ride, keeps[robot] = _ride_after(courses, rides, robot, releases, is_near)
            change = first_change(ride, laws)
            if change >= 0:
                take_law(ride, laws)
                is_settled = False
                changes[robot] += 1
                keeps[robot] = keeps[robot] and k + 1 < rounds
                for b in range(crossings.box_first[robot], crossings.box_first[robot + 1]):
                    if not second[b] and crossings.cell[b] >= ride.first + change - 1:
                        is_due[crossings.other[b]] = True
        if is_settled:
            break
    return keeps
