"""What the boxes of the two robots of a crossing have in common.

A pair of places at which two robots are too near each other is in a box of either of them. Both
covers together hold it therefore more narrowly than each of them: in the common parts of a box of
the one and one of the other.

Tested through ``fleet/test_ordered_crossings``.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.blocked_times import comes_to, goes_from
from viaspline.kernels.fleet.box_runs import root_of, unite
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.growable import new_floats, new_ints, sized_floats, sized_ints
from viaspline.kernels.jit import kernel, uncounted

NEAR_M: Final = 1e-9
"""Parts that are no farther from each other touch [m]."""


@uncounted
def first_box_behind(
    courses: PackedCourses, crossings: PackedCrossings, robot: int, place: float
) -> int:
    """The first box of a robot whose cell doesn't end before a place of its path [m].

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings; its boxes are in the order of their cells.
        robot: Whose boxes.
        place: Distance along its path [m].
    """
    low, high = crossings.box_first[robot], crossings.box_first[robot + 1]
    while low < high:
        middle = (low + high) // 2
        if courses.distance[crossings.cell[middle] + 1] < place:
            low = middle + 1
        else:
            high = middle
    return low


@kernel
def common_parts(
    courses: PackedCourses, crossings: PackedCrossings, is_asked: Flags
) -> tuple[Ints, Floats]:
    """The common parts of some crossings, in the order of the first robots' boxes.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        is_asked: Which crossings, (c,).

    Returns:
        A box of the first robot and one of the second, (p, 2); and from where to where along the
        path of the first and along that of the second they have something in common [m], (p, 4).
    """
    boxes, part = new_ints(1024, 2), new_floats(1024, 4)
    count = 0
    for robot in range(crossings.box_first.size - 1):
        for b in range(crossings.box_first[robot], crossings.box_first[robot + 1]):
            c, other = crossings.crossing[b], crossings.other[b]
            if not is_asked[c] or crossings.robots[c, 0] != robot:
                continue
            begin = courses.distance[crossings.cell[b]]
            end = courses.distance[crossings.cell[b] + 1]
            for d in range(
                first_box_behind(courses, crossings, other, crossings.low[b]),
                crossings.box_first[other + 1],
            ):
                if courses.distance[crossings.cell[d]] > crossings.high[b]:
                    break
                if crossings.crossing[d] != c:
                    continue
                since = max(courses.distance[crossings.cell[d]], crossings.low[b])
                until = min(courses.distance[crossings.cell[d] + 1], crossings.high[b])
                left, right = max(begin, crossings.low[d]), min(end, crossings.high[d])
                if left > right:
                    continue
                if count == len(boxes):
                    boxes = sized_ints(boxes, count, 2 * count)
                    part = sized_floats(part, count, 2 * count)
                boxes[count, 0], boxes[count, 1] = b, d
                part[count, 0], part[count, 1] = left, right
                part[count, 2], part[count, 3] = since, until
                count += 1
    return boxes[:count], part[:count]


@kernel
def connected_parts(crossings: PackedCrossings, boxes: Ints, part: Floats) -> Ints:
    """Which common parts of a crossing are connected with each other.

    Args:
        crossings: PackedCrossings.
        boxes: See ``common_parts``, (p, 2).
        part: (p, 4).

    Returns:
        Of each part the first of those that it is connected with, (p,).
    """
    parent = np.arange(len(boxes)).reshape(-1, 1)
    for i in range(len(boxes)):
        c, cell = crossings.crossing[boxes[i, 0]], crossings.cell[boxes[i, 0]]
        k = i + 1
        while k < len(boxes) and cell <= crossings.cell[boxes[k, 0]] <= cell + 1:
            touches = crossings.crossing[boxes[k, 0]] == c
            for axis in range(0, 4, 2):
                touches &= part[k, axis] <= part[i, axis + 1] + NEAR_M
                touches &= part[i, axis] <= part[k, axis + 1] + NEAR_M
            if touches:
                unite(parent, i, k)
            k += 1
    first = np.empty(len(boxes), np.int64)
    for i in range(len(boxes)):
        first[i] = root_of(parent, i)
    return first


@kernel
def passed_second(
    courses: PackedCourses, crossings: PackedCrossings, laws: PackedLaws, boxes: Ints, part: Floats
) -> Flags:
    """Which common parts the first robot of a crossing passes second, as far as laws tell.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        laws: Of all their robots.
        boxes: See ``common_parts``, (p, 2).
        part: (p, 4).

    Returns:
        A flag for each part, (p,). Where the laws pass through it, it is on the side where most of
        it is.
    """
    is_second = np.zeros(len(boxes), np.bool_)
    for i in range(len(boxes)):
        one, two = crossings.other[boxes[i, 1]], crossings.other[boxes[i, 0]]
        left, right, since, until = part[i]
        ahead = comes_to(courses, laws, two, since) - goes_from(courses, laws, one, right)
        behind = comes_to(courses, laws, one, left) - goes_from(courses, laws, two, until)
        is_second[i] = behind > ahead
    return is_second
