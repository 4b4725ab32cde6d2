"""The trajectory of one robot from its law at the nodes of its course.

Tested through ``fleet/timing/test_time_paths``.
"""

from __future__ import annotations

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.timing.rides import FleetRides
from viaspline.trajectory.law_at_nodes import law_through_nodes
from viaspline.trajectory.trajectory import Trajectory

SAME_S = 1e-12
"""Waits that are no longer are rounding [s]."""


def timed_trajectory(
    static: Trajectory, courses: FleetCourses, rides: FleetRides, laws: FleetLaws, robot: int
) -> Trajectory:
    """The time law of a robot, by the clock of the fleet.

    A robot that only waits where it stands anyway drives as it would alone, to the bit.

    Args:
        static: Its law where it is alone.
        courses: The paths of the fleet.
        rides: How its robots drive alone.
        laws: Of the fleet.
        robot: Which one has a law.
    """
    nodes = slice(int(courses.packed.first[robot]), int(courses.packed.first[robot + 1]))
    arrive, leave = laws.packed.arrive[nodes], laws.packed.leave[nodes]
    begin = float(rides.packed.depart[robot])
    stays = rides.packed.stays[nodes]
    waits = leave[:-1] - arrive[:-1] - stays[:-1]
    along = courses.packed.distance[nodes]
    if (laws.packed.speed[nodes] == np.sqrt(rides.packed.square[nodes])).all():
        law = static.delayed(begin - static.start_time)
        for k in np.flatnonzero(waits > SAME_S):
            law = law.waiting(float(along[k]), float(waits[k]))
        return law
    law = law_through_nodes(along, laws.packed.speed[nodes], arrive, leave, static)
    return law.waiting(float(along[-1]), float(stays[-1])) if stays[-1] > SAME_S else law
