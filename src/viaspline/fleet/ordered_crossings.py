"""Crossings in each of which one robot passes first.

In a connected set of places one robot passes first. But the boxes of a crossing hold a little more
than it, and may touch those of another one: then laws that pass between the two are on either side
of what is taken for one crossing, and it is two.
"""

from __future__ import annotations

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings, box_owners
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.crossing_leaders import UNSETTLED, crossing_leaders
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.passing_order import passing_gaps


def ordered_crossings(
    courses: FleetCourses, crossings: FleetCrossings, laws: FleetLaws
) -> FleetCrossings:
    """Crossings with those divided in which now the one robot passes first and now the other.

    Args:
        courses: The paths of a fleet.
        crossings: Where they come near each other.
        laws: When each robot is where.

    Returns:
        The crossings themselves where none has to be divided.
    """
    packed = crossings.packed
    leaders, _ = crossing_leaders(courses.packed, packed, laws.packed)
    if not (leaders == UNSETTLED).any():
        return crossings
    gaps = passing_gaps(courses.packed, packed, laws.packed)
    owner = box_owners(packed)
    is_lower = owner == packed.robots[packed.crossing, 0]
    is_divided = leaders[packed.crossing] == UNSETTLED
    lower_leads = (is_divided & (is_lower != (gaps >= 0.0))).astype(np.int64)
    kinds, crossing = np.unique(2 * packed.crossing + lower_leads, return_inverse=True)
    robots = packed.robots[kinds // 2]
    whole = (leaders != UNSETTLED)[kinds // 2, None]
    spans = _spans(courses, packed, owner, crossing, robots)
    return FleetCrossings(
        packed._replace(
            robots=robots,
            crossing=crossing.astype(np.int64),
            span=np.where(whole, packed.span[kinds // 2], spans),
        )
    )


def _spans(
    courses: FleetCourses, packed: PackedCrossings, owner: Ints, crossing: Ints, robots: Ints
) -> Floats:
    """From where to where along both paths the boxes of each crossing are [m], (c, 4)."""
    distance = courses.packed.distance
    spans = np.tile([np.inf, -np.inf], (len(robots), 2))
    mine = np.column_stack([distance[packed.cell], distance[packed.cell + 1]])
    others = np.column_stack([packed.low, packed.high])
    is_lower = (owner == robots[crossing, 0])[:, None]
    for column, ends in (
        (0, np.where(is_lower, mine, others)),
        (2, np.where(is_lower, others, mine)),
    ):
        np.minimum.at(spans[:, column], crossing, ends[:, 0])
        np.maximum.at(spans[:, column + 1], crossing, ends[:, 1])
    return spans
