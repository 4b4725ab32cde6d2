"""The laws of a fleet by the order in which its robots pass each other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.lattice_order.lattice_paths import PassingSteps
from viaspline.fleet.lattice_order.passing_orders import passes_second
from viaspline.fleet.timing.rides import FleetRides
from viaspline.fleet.timing.time_paths import Timing, standing_laws
from viaspline.kernels.fleet.circular_orders import never_arrive
from viaspline.kernels.fleet.rides_in_order import rides_in_order

ROUNDS = 400
"""In which rides are reckoned, at most."""


def time_in_order(
    courses: FleetCourses,
    crossings: FleetCrossings,
    rides: FleetRides,
    steps: Sequence[PassingSteps],
) -> Timing:
    """Time robots along their paths so that they pass in the order of a lattice.

    Args:
        courses: Their paths.
        crossings: Where these come near each other.
        rides: How they drive alone.
        steps: At which step each robot is where, in the order of the courses.

    Returns:
        The laws of all. ``blocked`` names robots whose order could not be kept, then the laws are
        not clear of each other. Orders with a circle can't, and are not tried.
    """
    second = passes_second(courses, crossings, steps, rides.packed.vanishes)
    ends = np.array([one.steps[-1] for one in steps])
    order = np.argsort(ends, kind="stable").astype(np.int64)
    laws = standing_laws(courses)
    stuck = never_arrive(courses.packed, crossings.packed, second)
    if not stuck.any():
        stuck = ~rides_in_order(
            courses.packed, crossings.packed, rides.packed, laws.packed, second, order, ROUNDS
        )
    blocked = {robot: robot for robot in np.flatnonzero(stuck).tolist()}
    return Timing(laws, blocked)
