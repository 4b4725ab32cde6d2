"""Crossings in each of which one robot passes first.

In a connected set of places one robot passes first. But the boxes of a crossing hold a little more
than it, and may touch those of another one: then laws that pass between the two are on either side
of what is taken for one crossing, and it is two. What the boxes of both robots have in common holds
the places more narrowly, and tells the two apart.
"""

from __future__ import annotations

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings, box_owners
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.common_parts import common_parts, connected_parts, passed_second
from viaspline.kernels.fleet.crossing_leaders import UNSETTLED, crossing_leaders
from viaspline.kernels.fleet.packed_crossings import PackedCrossings


def ordered_crossings(
    courses: FleetCourses, crossings: FleetCrossings, laws: FleetLaws
) -> FleetCrossings:
    """Crossings with those divided in which now the one robot passes first and now the other.

    They are divided into what is connected; and where that still has no order, into what one robot
    passes first and what the other does. Both covers of every new crossing hold all of its places.

    Args:
        courses: The paths of a fleet.
        crossings: Where they come near each other.
        laws: When each robot is where.

    Returns:
        The crossings themselves where none has to be divided.
    """
    packed = crossings.packed
    is_divided = _has_no_order(courses, packed, laws)
    if not is_divided.any():
        return crossings
    boxes, part = common_parts(courses.packed, packed, is_divided)
    group = 2 * connected_parts(packed, boxes, part)
    cut, groups = _cut(courses, packed, is_divided, (boxes, part, group))
    has_none = np.isin(group, groups[_has_no_order(courses, cut, laws)])
    if has_none.any():
        group += has_none & passed_second(courses.packed, packed, laws.packed, boxes, part)
        cut, _ = _cut(courses, packed, is_divided, (boxes, part, group))
    return FleetCrossings(cut)


def _has_no_order(courses: FleetCourses, packed: PackedCrossings, laws: FleetLaws) -> Flags:
    """In which crossings neither robot passes first, (c,)."""
    leaders, _ = crossing_leaders(courses.packed, packed, laws.packed)
    has_none: Flags = leaders == UNSETTLED
    return has_none


def _cut(
    courses: FleetCourses,
    packed: PackedCrossings,
    is_divided: Flags,
    parts: tuple[Ints, Floats, Ints],
) -> tuple[PackedCrossings, Ints]:
    """Crossings with some cut into groups of their common parts.

    Args:
        courses: Of the fleet.
        packed: Its crossings.
        is_divided: Which are cut, (c,).
        parts: As of ``common_parts``: boxes (p, 2) and places (p, 4), and the group of each, (p,).

    Returns:
        All crossings, and the group of each; -1 for one that is whole.
    """
    boxes, part, group = parts
    whole = np.flatnonzero(~is_divided[packed.crossing])
    box = np.concatenate([whole, boxes[:, 0], boxes[:, 1]])
    named = np.concatenate([np.full(len(whole), -1), group, group])
    between = np.concatenate(
        [np.column_stack([packed.low, packed.high])[whole], part[:, 2:], part[:, :2]]
    )
    was, groups, kind = _each_once(box, named)
    low, high = np.full(len(was), np.inf), np.full(len(was), -np.inf)
    np.minimum.at(low, kind, between[:, 0])
    np.maximum.at(high, kind, between[:, 1])
    told, of_told, crossing = _each_once(packed.crossing[was].astype(np.int64), groups)
    cut = packed._replace(
        robots=packed.robots[told],
        box_first=np.searchsorted(was, packed.box_first).astype(np.int64),
        cell=packed.cell[was],
        crossing=crossing.astype(np.int32),
        other=packed.other[was],
        low=low,
        high=high,
    )
    spans = np.where(of_told[:, None] < 0, packed.span[told], _spans(courses, cut))
    return cut._replace(span=spans), of_told


def _each_once(numbers: Ints, groups: Ints) -> tuple[Ints, Ints, Ints]:
    """Pairs of a number and a group from -1 on, each once and sorted; which of them each is.

    A pair is sorted as one number, which is several times as fast as by two columns.
    """
    width = int(groups.max(initial=-1)) + 2
    pairs, which = np.unique(numbers * width + groups + 1, return_inverse=True)
    return pairs // width, pairs % width - 1, which


def _spans(courses: FleetCourses, packed: PackedCrossings) -> Floats:
    """From where to where along both paths the boxes of each crossing are [m], (c, 4)."""
    distance = courses.packed.distance
    spans = np.tile([np.inf, -np.inf], (len(packed.robots), 2))
    mine = np.column_stack([distance[packed.cell], distance[packed.cell + 1]])
    others = np.column_stack([packed.low, packed.high])
    is_first = (box_owners(packed) == packed.robots[packed.crossing, 0])[:, None]
    for column, ends in (
        (0, np.where(is_first, mine, others)),
        (2, np.where(is_first, others, mine)),
    ):
        np.minimum.at(spans[:, column], packed.crossing, ends[:, 0])
        np.maximum.at(spans[:, column + 1], packed.crossing, ends[:, 1])
    return spans
