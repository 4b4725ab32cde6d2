"""Crossings: connected sets of boxes of two robots, seen from either of them.

Boxes of one robot in consecutive cells are connected where their intervals overlap, and boxes of
the one with boxes of the other where they do as rectangles in the plane of both distances. Either
side covers all that is too near, so a set that only one side has is none: it is left out.

Tested through ``fleet/test_crossings``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.near_boxes import HIGH, LOW, RawBoxes
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.growable import new_floats, new_ints, sized_floats, sized_ints
from viaspline.kernels.jit import inlined, inner, kernel

ROBOT: Final = 0
AGAINST: Final = 1
BEGIN: Final = 2
END: Final = 3
FROM: Final = 2
UNTIL: Final = 3
NOWHERE: Final = -1


class GroupedBoxes(NamedTuple):
    """The boxes of every robot, grouped by the other robot, and by cell within a group.

    Attributes:
        cell: (b, 1).
        interval: LOW and HIGH [m], (b, 2).
        crossing: Of each box, or NOWHERE, (b, 1).
        groups: ROBOT, AGAINST, and from where to where in the above, (g, 4).
        of_robot: Where the groups of each robot begin, (n + 1, 1).
    """

    cell: Ints
    interval: Floats
    crossing: Ints
    groups: Ints
    of_robot: Ints


class Runs(NamedTuple):
    """Boxes of two groups that face each other, in runs: one box a cell, each overlapping the next.

    Attributes:
        part: From where to where in the grouped boxes, (r, 2).
        bound: The lowest and the highest distance along the other's path [m], and where its cells
            begin and end along its own, (r, 4).
        parent: Of the sets that runs are joined to; the lowest run of a set is its own, (r, 1).
        named: Room for a number each, (r, 1).
    """

    part: Ints
    bound: Floats
    parent: Ints
    named: Ints


@inner
def _room_for_runs(count: int) -> Runs:
    """Runs that are yet to be written."""
    return Runs(new_ints(count, 2), new_floats(count, 4), new_ints(count, 1), new_ints(count, 1))


@inner
def _groups(boxes: RawBoxes) -> tuple[Ints, Ints]:
    """``groups`` and ``of_robot`` of ``GroupedBoxes``; the former end where they begin, as yet."""
    robots = boxes.first.shape[0] - 1
    groups, count = new_ints(4 * robots + 16, 4), 0
    of_robot, group_of = new_ints(robots + 1, 1), new_ints(robots, 1)
    for robot in range(robots):
        group_of[robot, 0] = NOWHERE
    for robot in range(robots):
        begin = count
        of_robot[robot, 0] = begin
        for box in range(boxes.first[robot], boxes.first[robot + 1]):
            other = boxes.other[box]
            if group_of[other, 0] < begin:
                group_of[other, 0] = count
                if count == groups.shape[0]:
                    groups = sized_ints(groups, count, 2 * count)
                groups[count, ROBOT], groups[count, AGAINST] = robot, other
                groups[count, END] = 0
                count += 1
            groups[group_of[other, 0], END] += 1
        at = boxes.first[robot]
        for group in range(begin, count):
            size = groups[group, END]
            groups[group, BEGIN], groups[group, END] = at, at
            at += size
    of_robot[robots, 0] = count
    return sized_ints(groups, count, count), of_robot


@inner
def _grouped(boxes: RawBoxes) -> GroupedBoxes:
    """Group the boxes of every robot by the other one."""
    robots, total = boxes.first.shape[0] - 1, boxes.cell.shape[0]
    groups, of_robot = _groups(boxes)
    cell, interval, crossing = new_ints(total, 1), new_floats(total, 2), new_ints(total, 1)
    group_of = new_ints(robots, 1)
    for robot in range(robots):
        for group in range(of_robot[robot, 0], of_robot[robot + 1, 0]):
            group_of[groups[group, AGAINST], 0] = group
        for box in range(boxes.first[robot], boxes.first[robot + 1]):
            group = group_of[boxes.other[box], 0]
            at = groups[group, END]
            cell[at, 0] = boxes.cell[box]
            interval[at, LOW], interval[at, HIGH] = boxes.low[box], boxes.high[box]
            groups[group, END] = at + 1
    for at in range(total):
        crossing[at, 0] = NOWHERE
    return GroupedBoxes(cell, interval, crossing, groups, of_robot)


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
def _unite(parent: Ints, i: int, j: int) -> None:
    """Make one set of two; the lower root stays."""
    i, j = _root(parent, i), _root(parent, j)
    parent[max(i, j), 0] = min(i, j)


@inlined
def _cut_runs(
    boxes: GroupedBoxes, distance: Floats, group: int, offset: int, runs: Runs
) -> tuple[int, bool]:
    """Cut a group into runs, from a number of runs on.

    Returns:
        (how many runs there are then, whether any two boxes of the group have one cell).
    """
    begin, end = boxes.groups[group, BEGIN], boxes.groups[group, END]
    cell, interval, count, is_shared = boxes.cell, boxes.interval, offset, False
    for at in range(begin, end):
        low, high = interval[at, LOW], interval[at, HIGH]
        follows = at > begin and cell[at, 0] == cell[at - 1, 0] + 1
        if follows and low <= interval[at - 1, HIGH] and interval[at - 1, LOW] <= high:
            runs.bound[count - 1, LOW] = min(runs.bound[count - 1, LOW], low)
            runs.bound[count - 1, HIGH] = max(runs.bound[count - 1, HIGH], high)
        else:
            is_shared = is_shared or (at > begin and cell[at, 0] == cell[at - 1, 0])
            runs.part[count, 0] = at
            runs.bound[count, LOW], runs.bound[count, HIGH] = low, high
            runs.parent[count, 0] = count
            count += 1
        runs.part[count - 1, 1] = at + 1
    for run in range(offset, count):
        runs.bound[run, FROM] = distance[cell[runs.part[run, 0], 0]]
        runs.bound[run, UNTIL] = distance[cell[runs.part[run, 1] - 1, 0] + 1]
    return count, is_shared


@inlined
def _join_one_side(boxes: GroupedBoxes, first: int, last: int, runs: Runs) -> None:
    """Join the runs of one side that have boxes in consecutive cells whose intervals overlap."""
    cell, interval, part = boxes.cell, boxes.interval, runs.part
    for run in range(first, last):
        for other in range(run + 1, last):
            for at in range(part[run, 0], part[run, 1]):
                for at2 in range(part[other, 0], part[other, 1]):
                    is_beside = abs(cell[at2, 0] - cell[at, 0]) == 1
                    is_beside = is_beside and interval[at2, LOW] <= interval[at, HIGH]
                    if is_beside and interval[at, LOW] <= interval[at2, HIGH]:
                        _unite(runs.parent, run, other)


@inlined
def _from(boxes: GroupedBoxes, distance: Floats, begin: int, end: int, place: float) -> int:
    """The first box from one to another whose cell doesn't end before a distance [m]."""
    while begin < end:
        middle = (begin + end) // 2
        if distance[boxes.cell[middle, 0] + 1] < place:
            begin = middle + 1
        else:
            end = middle
    return begin


@inlined
def _may_touch(bound: Floats, run: int, other: int) -> bool:
    """Whether what holds a run of the one side overlaps what holds one of the other side."""
    is_beside = bound[run, FROM] <= bound[other, HIGH] and bound[other, LOW] <= bound[run, UNTIL]
    if not is_beside:
        return False
    return bound[other, FROM] <= bound[run, HIGH] and bound[run, LOW] <= bound[other, UNTIL]


@inlined
def _touch(boxes: GroupedBoxes, distance: Floats, runs: Runs, run: int, other: int) -> bool:
    """Whether a box of a run of the one side overlaps one of a run of the other side."""
    cell, interval, part = boxes.cell, boxes.interval, runs.part
    for at in range(part[run, 0], part[run, 1]):
        low, high = distance[cell[at, 0]], distance[cell[at, 0] + 1]
        for at2 in range(
            _from(boxes, distance, part[other, 0], part[other, 1], interval[at, LOW]),
            part[other, 1],
        ):
            if distance[cell[at2, 0]] > interval[at, HIGH]:
                break
            if interval[at2, LOW] <= high and low <= interval[at2, HIGH]:
                return True
    return False


@inlined
def _join_sides(
    boxes: GroupedBoxes, distance: Floats, ours: int, all_runs: int, runs: Runs
) -> None:
    """Join runs of both sides that touch.

    What is too near in a run lies in runs of the other side. So where each has but one that may
    touch it, it is that one.
    """
    named, is_plain = runs.named, True
    for run in range(all_runs):
        named[run, 0] = NOWHERE
    for run in range(ours):
        for other in range(ours, all_runs):
            if _may_touch(runs.bound, run, other):
                is_plain = is_plain and named[run, 0] == NOWHERE and named[other, 0] == NOWHERE
                named[run, 0], named[other, 0] = other, run
    for run in range(ours):
        for other in range(ours, all_runs):
            if _may_touch(runs.bound, run, other) and (
                is_plain or _touch(boxes, distance, runs, run, other)
            ):
                _unite(runs.parent, run, other)


@inlined
def _name(
    boxes: GroupedBoxes, ours: int, all_runs: int, runs: Runs, span: Floats, found: int
) -> int:
    """Give sets that both sides have a number, in the order of the first side, and a span.

    Args:
        boxes: GroupedBoxes.
        ours: How many runs the first side has.
        all_runs: How many both have.
        runs: Runs.
        span: Of all crossings, with room for as many more as the first side has runs.
        found: How many crossings there are so far.

    Returns:
        How many crossings there are now.
    """
    named = runs.named
    for run in range(all_runs):
        named[run, 0] = NOWHERE
    for run in range(ours, all_runs):  # roots are the lowest: of the first side, if it has any
        root = _root(runs.parent, run)
        if root < ours and named[root, 0] == NOWHERE:
            named[root, 0] = 0
    for root in range(ours):
        if named[root, 0] != NOWHERE:
            named[root, 0] = found
            span[found, 0], span[found, 2] = np.inf, np.inf
            span[found, 1], span[found, 3] = -np.inf, -np.inf
            found += 1
    for run in range(all_runs):
        row = named[_root(runs.parent, run), 0]
        if row == NOWHERE:
            continue
        column = 2 if run < ours else 0  # a box is tight along the other's path
        span[row, column] = min(span[row, column], runs.bound[run, LOW])
        span[row, column + 1] = max(span[row, column + 1], runs.bound[run, HIGH])
        for at in range(runs.part[run, 0], runs.part[run, 1]):
            boxes.crossing[at, 0] = row
    return found


@inner
def _keep(boxes: RawBoxes, grouped: GroupedBoxes, first: Ints, crossing: Ints) -> int:
    """Leave out what is in no crossing, in place. How many boxes there are then.

    Args:
        boxes: RawBoxes, changed.
        grouped: With their crossings; the ends of its groups are changed.
        first: Where the boxes of each robot begin then, (n + 1, 1), filled in.
        crossing: Of each box then, (b, 1), filled in.
    """
    groups, robots = grouped.groups, boxes.first.shape[0] - 1
    group_of = new_ints(robots, 1)
    kept = 0
    for robot in range(robots):
        first[robot, 0] = kept
        for group in range(grouped.of_robot[robot, 0], grouped.of_robot[robot + 1, 0]):
            group_of[groups[group, AGAINST], 0] = group
            groups[group, END] = groups[group, BEGIN]
        for box in range(boxes.first[robot], boxes.first[robot + 1]):
            group = group_of[boxes.other[box], 0]
            row = grouped.crossing[groups[group, END], 0]
            groups[group, END] += 1
            if row != NOWHERE:
                boxes.cell[kept], boxes.other[kept] = boxes.cell[box], boxes.other[box]
                boxes.low[kept], boxes.high[kept] = boxes.low[box], boxes.high[box]
                crossing[kept, 0] = row
                kept += 1
    first[robots, 0] = kept
    return kept


@kernel
def joined_boxes(courses: PackedCourses, boxes: RawBoxes) -> tuple[Ints, Floats, Ints, Ints, int]:
    """Crossings from the boxes of every robot.

    Args:
        courses: PackedCourses.
        boxes: RawBoxes; those that are in no crossing are left out, in place.

    Returns:
        (robots (c, 2), span (c, 4), first (n + 1,), crossing, how many boxes are left): see
        ``PackedCrossings``.
    """
    grouped = _grouped(boxes)
    pairs = _facing(grouped)
    groups = grouped.groups
    runs = _room_for_runs(1024)
    robots, span = new_ints(pairs.shape[0] + 1024, 2), new_floats(pairs.shape[0] + 1024, 4)
    found = 0
    for pair in range(pairs.shape[0]):
        one, two = pairs[pair, 0], pairs[pair, 1]
        both = groups[one, END] - groups[one, BEGIN] + groups[two, END] - groups[two, BEGIN]
        if both > runs.parent.shape[0]:
            runs = _room_for_runs(2 * both)
        ours, is_shared = _cut_runs(grouped, courses.distance, one, 0, runs)
        all_runs, is_shared2 = _cut_runs(grouped, courses.distance, two, ours, runs)
        if is_shared:
            _join_one_side(grouped, 0, ours, runs)
        if is_shared2:
            _join_one_side(grouped, ours, all_runs, runs)
        _join_sides(grouped, courses.distance, ours, all_runs, runs)
        if found + ours > span.shape[0]:
            robots = sized_ints(robots, found, 2 * (found + ours))
            span = sized_floats(span, found, 2 * (found + ours))
        before = found
        found = _name(grouped, ours, all_runs, runs, span, before)
        for row in range(before, found):
            robots[row, 0], robots[row, 1] = groups[one, ROBOT], groups[two, ROBOT]
    first, crossing = new_ints(boxes.first.shape[0], 1), new_ints(boxes.cell.shape[0], 1)
    kept = _keep(boxes, grouped, first, crossing)
    return (
        sized_ints(robots, found, found), sized_floats(span, found, found), first[:, 0],
        crossing[:, 0], kept,
    )  # fmt: skip
