"""The crossings of a fleet of which some robots have another path than before."""

from __future__ import annotations

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings, crossings_of
from viaspline.kernels.arrays import Ints
from viaspline.kernels.fleet.packed_crossings import PackedCrossings


def renewed_crossings(
    before: FleetCrossings, old: FleetCourses, courses: FleetCourses, changed: Ints
) -> FleetCrossings:
    """Crossings of which those of some robots are found anew; the same as if all of them were.

    Args:
        before: The crossings as they were.
        old: The courses that they belong to.
        courses: The courses as they are, of the same robots, or of some more behind these.
        changed: The robots whose courses are others, (k,).

    Raises:
        GaveUpError: As ``crossings_of``.
    """
    fresh = crossings_of(courses, changed).packed
    return FleetCrossings(patched_crossings(before, old, courses, changed, fresh).packed)


def patched_crossings(
    before: FleetCrossings, old: FleetCourses, courses: FleetCourses, changed: Ints,
    fresh: PackedCrossings,
) -> FleetCrossings:  # fmt: skip
    """Crossings of which those of some robots are others, not put among each other yet.

    Args:
        before: As for ``renewed_crossings``, as are the next three.
        old: As there.
        courses: As there.
        changed: As there.
        fresh: The crossings of these robots.
    """
    is_changed = np.zeros(len(courses.names), np.bool_)
    is_changed[changed] = True
    more = len(courses.names) - len(old.names)
    moved = courses.packed.first[:-1] - np.pad(old.packed.first[:-1], (0, more))
    return before.patched(fresh, is_changed, moved)
