"""Whether laws that nobody timed against each other's boxes can be kept as they are.

Tested through ``fleet/test_plan_fleet``.
"""

from __future__ import annotations

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.kernels.fleet.crossing_leaders import UNSETTLED, crossing_leaders


def laws_hold(
    courses: FleetCourses, crossings: FleetCrossings, laws: FleetLaws, separation: float
) -> bool:
    """Whether robots are apart by their laws, and one of them passes every crossing first.

    Args:
        courses: Their paths.
        crossings: Where these come near each other.
        laws: When each robot is where.
        separation: Free space between bodies [m].
    """
    ordered = ordered_crossings(courses, crossings, laws)
    leaders, _ = crossing_leaders(courses.packed, ordered.packed, laws.packed)
    if (leaders == UNSETTLED).any():
        return False
    return certify_fleet(courses, laws, separation).holds
