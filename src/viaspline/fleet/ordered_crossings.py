"""Crossings in each of which one robot passes first.

Two robots may pass each other twice in one connected set of places, once the one first and once the
other: by laws that a lattice gives, say. Then it is two crossings.
"""

from __future__ import annotations

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.arrays import Floats, Ints
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
    gaps = passing_gaps(courses.packed, packed, laws.packed)
    owner = np.repeat(np.arange(len(courses.names)), np.diff(packed.box_first))
    is_lower = owner == packed.robots[packed.crossing, 0]
    lower_leads = (is_lower != (gaps >= 0.0)).astype(np.int64)
    count = len(packed.robots)
    leads = np.bincount(packed.crossing, lower_leads, count)
    boxes = np.bincount(packed.crossing, minlength=count)
    if not ((leads > 0) & (leads < boxes)).any():
        return crossings
    kinds, crossing = np.unique(2 * packed.crossing + lower_leads, return_inverse=True)
    robots = packed.robots[kinds // 2]
    return FleetCrossings(
        packed._replace(
            robots=robots,
            crossing=crossing.astype(np.int64),
            span=_spans(courses, packed, owner, crossing, robots),
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
