"""How late robots are among each other.

Tested through ``fleet/test_led_fleet``.
"""

from __future__ import annotations

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.timing.rides import FleetRides
from viaspline.kernels.arrays import Floats

LEAST_DRIVE_S = 1e-3
"""All drives together, at least, where lateness is a share of them [s]."""
WELL_SERVED_SHARE = 0.1
"""All robots together are served well if they are no later than that."""


def arrivals_of(courses: FleetCourses, laws: FleetLaws) -> Floats:
    """When each robot comes to its goal; infinite for those that have no law [s], (n,).

    Args:
        courses: Their paths.
        laws: When each is where.
    """
    packed = laws.packed
    arrive: Floats = packed.arrive[courses.packed.first[1:] - 1]
    return np.where(packed.is_timed, arrive, np.inf)


def late_share(rides: FleetRides, arrivals: Floats) -> float:
    """How much longer robots take than if they were alone, as a share, all together.

    Args:
        rides: How each drives alone.
        arrivals: When each has arrived, and stood at its goal as long as asked; those that never
            have are left out [s], (n,).
    """
    late = arrivals - rides.packed.depart - rides.alone
    there = np.isfinite(late)
    return float(late[there].sum() / max(rides.alone[there].sum(), LEAST_DRIVE_S))
