"""Who passes first at every box of a fleet's crossings, as its laws have it.

Tested through ``fleet/test_precedences``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.blocked_times import goes_from
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.jit import kernel


@kernel
def passing_gaps(courses: PackedCourses, crossings: PackedCrossings, laws: PackedLaws) -> Floats:
    """How long after the other one has left it a robot comes to each of its boxes.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        laws: Of all robots, clear of each other.

    Returns:
        Less than 0 where it passes first [s], (boxes,).
    """
    gaps = np.empty(crossings.cell.size)
    for robot in range(courses.reach.size):
        for b in range(crossings.box_first[robot], crossings.box_first[robot + 1]):
            node = crossings.cell[b]
            comes = laws.arrive[node] if node > courses.first[robot] else -np.inf
            gone = goes_from(courses, laws, crossings.other[b], crossings.high[b])
            gaps[b] = comes - gone if comes > -np.inf else -np.inf
    return gaps
