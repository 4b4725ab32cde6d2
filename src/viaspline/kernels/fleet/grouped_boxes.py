"""The boxes of every robot, grouped by the other robot, and which groups face each other.

Tested through ``fleet/test_crossings``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from viaspline.kernels.arrays import Floats, Ints, Steps
from viaspline.kernels.fleet.near_boxes import HIGH, LOW, RawBoxes
from viaspline.kernels.growable import new_floats, new_ints, new_steps, sized_ints
from viaspline.kernels.jit import inner

ROBOT: Final = 0
AGAINST: Final = 1
BEGIN: Final = 2
END: Final = 3
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

    cell: Steps
    interval: Floats
    crossing: Steps
    groups: Ints
    of_robot: Ints


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
def grouped(boxes: RawBoxes) -> GroupedBoxes:
    """Group the boxes of every robot by the other one."""
    robots, total = boxes.first.shape[0] - 1, boxes.cell.shape[0]
    groups, of_robot = _groups(boxes)
    cell, interval, crossing = new_steps(total, 1), new_floats(total, 2), new_steps(total, 1)
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
def facing(boxes: GroupedBoxes) -> Ints:
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


@inner
def keep_crossing(boxes: RawBoxes, grouped: GroupedBoxes, first: Ints, crossing: Steps) -> int:
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
