"""Crossings: connected sets of boxes of two robots, seen from either of them.

Boxes of one robot in consecutive cells are connected where their intervals overlap, and a box of
the one with a box of the other where they do as rectangles in the plane of both distances. Either
side covers all that is too near, so a set that only one side has is none: it is left out.

Tested through ``fleet/test_crossings``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.near_boxes import CELL, HIGH, LOW, OTHER
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.growable import new_floats, new_ints, sized_floats, sized_ints
from viaspline.kernels.jit import inlined, inner, kernel

ROBOT: Final = 0
AGAINST: Final = 1
BEGIN: Final = 2
END: Final = 3
NOWHERE: Final = -1


class GroupedBoxes(NamedTuple):
    """The boxes of every robot, grouped by the other robot.

    Attributes:
        first: (n + 1,), of ``whole``.
        whole: CELL and OTHER, (b, 2).
        real: LOW and HIGH [m], (b, 2).
        order: The boxes, those of a group behind each other and ordered by cell, (b, 1).
        groups: ROBOT, AGAINST, and from where to where in ``order``, (g, 4).
        of_robot: Where the groups of each robot begin, (n + 1, 1).
    """

    first: Ints
    whole: Ints
    real: Floats
    order: Ints
    groups: Ints
    of_robot: Ints


@inner
def _grouped(first: Ints, whole: Ints, real: Floats) -> GroupedBoxes:
    """Group the boxes of every robot by the other one."""
    robots = first.shape[0] - 1
    order, groups = new_ints(whole.shape[0], 1), new_ints(4 * robots + 16, 4)
    of_robot, group_of = new_ints(robots + 1, 1), new_ints(robots, 1)
    for robot in range(robots):
        group_of[robot, 0] = NOWHERE
    count = 0
    for robot in range(robots):
        of_robot[robot, 0] = count
        begin = count
        for box in range(first[robot], first[robot + 1]):
            other = whole[box, OTHER]
            if group_of[other, 0] < begin:
                group_of[other, 0] = count
                if count == groups.shape[0]:
                    groups = sized_ints(groups, count, 2 * count)
                groups[count, ROBOT], groups[count, AGAINST] = robot, other
                groups[count, END] = 0
                count += 1
            groups[group_of[other, 0], END] += 1
        at = first[robot]
        for group in range(begin, count):
            size = groups[group, END]
            groups[group, BEGIN], groups[group, END] = at, at
            at += size
        for box in range(first[robot], first[robot + 1]):
            group = group_of[whole[box, OTHER], 0]
            order[groups[group, END], 0] = box
            groups[group, END] += 1
    of_robot[robots, 0] = count
    return GroupedBoxes(first, whole, real, order, sized_ints(groups, count, count), of_robot)


@inner
def _facing(boxes: GroupedBoxes) -> Ints:
    """Pairs of groups that face each other, by the lower robot and the higher one, (k, 2)."""
    groups, robots = boxes.groups, boxes.of_robot.shape[0] - 1
    count = groups.shape[0]
    against_first, against = new_ints(robots + 1, 1), new_ints(count, 1)
    mine = new_ints(robots, 1)
    for robot in range(robots + 1):
        against_first[robot, 0] = 0
        if robot < robots:
            mine[robot, 0] = NOWHERE
    for group in range(count):
        against_first[groups[group, AGAINST], 0] += 1
    total = 0
    for robot in range(robots + 1):
        total += against_first[robot, 0]
        against_first[robot, 0] = total
    for group in range(count - 1, -1, -1):
        other = groups[group, AGAINST]
        against_first[other, 0] -= 1
        against[against_first[other, 0], 0] = group
    pairs, found = new_ints(count // 2 + 1, 2), 0
    for robot in range(robots):
        for group in range(boxes.of_robot[robot, 0], boxes.of_robot[robot + 1, 0]):
            mine[groups[group, AGAINST], 0] = group
        for at in range(against_first[robot, 0], against_first[robot + 1, 0]):
            other = groups[against[at, 0], ROBOT]
            if other > robot and mine[other, 0] >= boxes.of_robot[robot, 0]:
                pairs[found, 0], pairs[found, 1] = mine[other, 0], against[at, 0]
                found += 1
    return sized_ints(pairs, found, found)


@inlined
def _root(parent: Ints, i: int) -> int:
    """Whose set a member belongs to."""
    while parent[i, 0] != i:
        parent[i, 0] = parent[parent[i, 0], 0]
        i = parent[i, 0]
    return i


@inlined
def _unite(parent: Ints, i: int, j: int) -> int:
    """Make one set of two; the lower root stays. How many sets fewer there are."""
    i, j = _root(parent, i), _root(parent, j)
    parent[max(i, j), 0] = min(i, j)
    return 0 if i == j else 1


@inner
def _join_one_side(boxes: GroupedBoxes, group: int, offset: int, parent: Ints) -> int:
    """Join the boxes of a group that are in consecutive cells. How many sets there are."""
    begin, end = boxes.groups[group, BEGIN], boxes.groups[group, END]
    whole, real, order = boxes.whole, boxes.real, boxes.order
    for i in range(end - begin):
        parent[offset + i, 0] = offset + i
    sets, following = end - begin, begin
    for at in range(begin, end):
        box = order[at, 0]
        cell = whole[box, CELL]
        while following < end and whole[order[following, 0], CELL] <= cell:
            following += 1
        after = following
        while after < end and whole[order[after, 0], CELL] == cell + 1:
            other = order[after, 0]
            if real[other, LOW] <= real[box, HIGH] and real[box, LOW] <= real[other, HIGH]:
                sets -= _unite(parent, offset + at - begin, offset + after - begin)
            after += 1
    return sets


@inlined
def _from(boxes: GroupedBoxes, distance: Floats, begin: int, end: int, place: float) -> int:
    """The first box in a part of ``order`` whose cell doesn't end before a distance [m]."""
    while begin < end:
        middle = (begin + end) // 2
        if distance[boxes.whole[boxes.order[middle, 0], CELL] + 1] < place:
            begin = middle + 1
        else:
            end = middle
    return begin


@inner
def _join_sides(
    boxes: GroupedBoxes, distance: Floats, one: int, two: int, parent: Ints, is_single: bool
) -> None:
    """Join boxes of two groups that face each other; the first that are found if both are one."""
    whole, real, order, groups = boxes.whole, boxes.real, boxes.order, boxes.groups
    begin, end = groups[one, BEGIN], groups[one, END]
    begin2, end2 = groups[two, BEGIN], groups[two, END]
    for at in range(begin, end):
        box = order[at, 0]
        low, high = distance[whole[box, CELL]], distance[whole[box, CELL] + 1]
        for at2 in range(_from(boxes, distance, begin2, end2, real[box, LOW]), end2):
            other = order[at2, 0]
            if distance[whole[other, CELL]] > real[box, HIGH]:
                break
            if real[other, LOW] <= high and low <= real[other, HIGH]:
                _unite(parent, at - begin, end - begin + at2 - begin2)
                if is_single:
                    return


@inner
def _name(
    boxes: GroupedBoxes, one: int, two: int, parent: Ints, named: Ints, span: Floats, found: int,
    crossing: Ints,
) -> int:  # fmt: skip
    """Give sets that both sides have a number, in the order of the first side, and a span.

    Args:
        boxes: GroupedBoxes.
        one: The group of the one side.
        two: That of the other.
        parent: Of their boxes.
        named: Room for as many numbers.
        span: Of all crossings, with room for as many more as the first side has boxes.
        found: How many crossings there are so far.
        crossing: The crossing of every box, filled in for those of the two groups, (b, 1).

    Returns:
        How many crossings there are now.
    """
    real, order, groups = boxes.real, boxes.order, boxes.groups
    begin, size = groups[one, BEGIN], groups[one, END] - groups[one, BEGIN]
    begin2, size2 = groups[two, BEGIN], groups[two, END] - groups[two, BEGIN]
    for i in range(size + size2):
        named[i, 0] = NOWHERE
    for i in range(size2):  # roots are the lowest: one of the first side, if there is any
        root = _root(parent, size + i)
        if root < size:
            named[root, 0] = 0
    for i in range(size):
        root, box = _root(parent, i), order[begin + i, 0]
        if named[root, 0] != NOWHERE and root == i:
            named[root, 0] = found
            span[found, 0], span[found, 2] = np.inf, np.inf
            span[found, 1], span[found, 3] = -np.inf, -np.inf
            found += 1
        crossing[box, 0] = named[root, 0]
        if named[root, 0] != NOWHERE:
            row = named[root, 0]
            span[row, 2] = min(span[row, 2], real[box, LOW])
            span[row, 3] = max(span[row, 3], real[box, HIGH])
    for i in range(size2):
        root, box = _root(parent, size + i), order[begin2 + i, 0]
        row = named[root, 0]
        crossing[box, 0] = row
        if row != NOWHERE:
            span[row, 0] = min(span[row, 0], real[box, LOW])
            span[row, 1] = max(span[row, 1], real[box, HIGH])
    return found


@kernel
def joined_boxes(courses: PackedCourses, first: Ints, whole: Ints, real: Floats) -> PackedCrossings:
    """Crossings from the boxes of every robot.

    Args:
        courses: PackedCourses.
        first: Where the boxes of each robot begin, (n + 1,).
        whole: CELL and OTHER, (b, 2).
        real: LOW and HIGH [m], (b, 2).
    """
    boxes = _grouped(first, whole, real)
    pairs = _facing(boxes)
    groups, total = boxes.groups, whole.shape[0]
    crossing = new_ints(total, 1)
    for box in range(total):
        crossing[box, 0] = NOWHERE
    parent, named = new_ints(1024, 1), new_ints(1024, 1)
    robots, span, found = (
        new_ints(pairs.shape[0] + 1024, 2),
        new_floats(pairs.shape[0] + 1024, 4),
        0,
    )
    for pair in range(pairs.shape[0]):
        one, two = pairs[pair, 0], pairs[pair, 1]
        size = groups[one, END] - groups[one, BEGIN]
        both = size + groups[two, END] - groups[two, BEGIN]
        if both > parent.shape[0]:
            parent, named = new_ints(2 * both, 1), new_ints(2 * both, 1)
        if found + size > span.shape[0]:
            robots = sized_ints(robots, found, 2 * (found + size))
            span = sized_floats(span, found, 2 * (found + size))
        sets = _join_one_side(boxes, one, 0, parent)
        sets2 = _join_one_side(boxes, two, size, parent)
        _join_sides(boxes, courses.distance, one, two, parent, sets == 1 and sets2 == 1)
        before = found
        found = _name(boxes, one, two, parent, named, span, found, crossing)
        for row in range(before, found):
            robots[row, 0], robots[row, 1] = groups[one, ROBOT], groups[two, ROBOT]
    return _kept(
        boxes, crossing, sized_ints(robots, found, found), sized_floats(span, found, found)
    )


@inner
def _kept(boxes: GroupedBoxes, crossing: Ints, robots: Ints, span: Floats) -> PackedCrossings:
    """The boxes that belong to a crossing."""
    count = 0
    for box in range(crossing.shape[0]):
        count += 1 if crossing[box, 0] != NOWHERE else 0
    first = new_ints(boxes.first.shape[0], 1)
    cell, of, other = new_ints(count, 1), new_ints(count, 1), new_ints(count, 1)
    low, high = new_floats(count, 1), new_floats(count, 1)
    first[0, 0] = 0
    at = 0
    for robot in range(first.shape[0] - 1):
        for box in range(boxes.first[robot], boxes.first[robot + 1]):
            if crossing[box, 0] != NOWHERE:
                cell[at, 0], other[at, 0] = boxes.whole[box, CELL], boxes.whole[box, OTHER]
                low[at, 0], high[at, 0] = boxes.real[box, LOW], boxes.real[box, HIGH]
                of[at, 0] = crossing[box, 0]
                at += 1
        first[robot + 1, 0] = at
    return PackedCrossings(
        robots, span, first[:, 0], cell[:, 0], of[:, 0], other[:, 0], low[:, 0], high[:, 0]
    )
