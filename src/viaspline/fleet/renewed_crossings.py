"""The crossings of a fleet of which some robots have another path than before."""

from __future__ import annotations

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings, box_owners, crossings_of
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.packed_crossings import PackedCrossings


def renewed_crossings(
    before: FleetCrossings, old: FleetCourses, courses: FleetCourses, changed: Ints
) -> FleetCrossings:
    """Crossings of which those of some robots are found anew; the same as if all of them were.

    Args:
        before: The crossings as they were.
        old: The courses that they belong to.
        courses: The courses as they are, of the same robots.
        changed: The robots whose courses are others, (k,).

    Raises:
        GaveUpError: As ``crossings_of``.
    """
    fresh = crossings_of(courses, changed).packed
    is_changed = np.zeros(len(courses.names), np.bool_)
    is_changed[changed] = True
    kept = _without(before.packed, is_changed)
    owner, fresh_owner = box_owners(kept), box_owners(fresh)
    moved = courses.packed.first[owner] - old.packed.first[owner]
    robots = np.concatenate([kept.robots, fresh.robots])
    order = np.lexsort((robots[:, 1], robots[:, 0]))  # stable: those of a pair stay in their order
    number = np.empty(len(order), np.int64)
    number[order] = np.arange(len(order))
    owners = np.concatenate([owner, fresh_owner])
    cell = np.concatenate([kept.cell + moved, fresh.cell])
    other = np.concatenate([kept.other, fresh.other])
    # Cells are numbered robot by robot. All boxes of one robot in one cell against another one come
    # from the one or the other: they stay in their order.
    boxes = np.argsort(cell * len(courses.names) + other, kind="stable")

    def joined(one: Floats, two: Floats) -> Floats:
        return np.concatenate([one, two])[boxes]

    crossing = np.concatenate([kept.crossing, fresh.crossing + len(kept.robots)])
    counts = np.bincount(owners, minlength=len(courses.names))
    return FleetCrossings(
        PackedCrossings(
            robots=robots[order],
            span=np.concatenate([kept.span, fresh.span])[order],
            box_first=np.cumsum([0, *counts], dtype=np.int64),
            cell=cell[boxes],
            crossing=number[crossing[boxes]],
            other=other[boxes],
            low=joined(kept.low, fresh.low),
            high=joined(kept.high, fresh.high),
        )
    )


def _without(crossings: PackedCrossings, is_changed: Flags) -> PackedCrossings:
    """The crossings of pairs of which neither robot is among these."""
    stays: Flags = ~np.any(is_changed[crossings.robots], axis=1)
    boxes = stays[crossings.crossing]
    owner = box_owners(crossings)[boxes]
    number = np.cumsum(stays) - 1
    counts = np.bincount(owner, minlength=is_changed.size)
    return PackedCrossings(
        robots=crossings.robots[stays],
        span=crossings.span[stays],
        box_first=np.cumsum([0, *counts], dtype=np.int64),
        cell=crossings.cell[boxes],
        crossing=number[crossings.crossing[boxes]],
        other=crossings.other[boxes],
        low=crossings.low[boxes],
        high=crossings.high[boxes],
    )
