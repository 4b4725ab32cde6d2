"""The boxes of a fleet's crossings, passage by passage."""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.kernels.arrays import Ints
from viaspline.kernels.fleet.blocked_times import node_before
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.growable import new_floats, new_ints
from viaspline.kernels.jit import inner, kernel

NONE: Final = -1


@inner
def _count_boxes(crossings: PackedCrossings, passage_of: Ints, first: Ints, counts: Ints) -> int:
    """Number the passages of all robots, and count their boxes. How many passages there are.

    Args:
        crossings: PackedCrossings.
        passage_of: The passage of either robot of each crossing, (c, 2), filled in.
        first: Where the passages of each robot begin, (n + 1, 1), filled in.
        counts: Of their boxes, (2 c, 1), filled in.
    """
    found = 0
    for c in range(passage_of.shape[0]):
        passage_of[c, 0], passage_of[c, 1] = NONE, NONE
    for robot in range(crossings.box_first.shape[0] - 1):
        first[robot, 0] = found
        for b in range(crossings.box_first[robot], crossings.box_first[robot + 1]):
            c = crossings.crossing[b]
            side = 0 if crossings.robots[c, 0] == robot else 1
            if passage_of[c, side] == NONE:
                passage_of[c, side] = found
                counts[found, 0] = 0
                found += 1
            counts[passage_of[c, side], 0] += 1
    first[crossings.box_first.shape[0] - 1, 0] = found
    return found


@kernel
def passages_of(courses: PackedCourses, crossings: PackedCrossings) -> PackedPassages:
    """The passages of every robot.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
    """
    robots, crossed = courses.reach.shape[0], crossings.robots.shape[0]
    passage_of, first = new_ints(crossed, 2), new_ints(robots + 1, 1)
    counts = new_ints(2 * crossed, 1)
    found = _count_boxes(crossings, passage_of, first, counts)
    table, box_first = new_ints(found, 6), new_ints(found + 1, 1)
    along = new_floats(found, 2)  # from where to where along the other's path [m]
    total = 0
    for p in range(found):
        box_first[p, 0] = total
        total += counts[p, 0]
        counts[p, 0] = box_first[p, 0]
        along[p, 0], along[p, 1] = np.inf, -np.inf
    box_first[found, 0] = total
    box = np.empty(total, np.int32)
    for robot in range(robots):
        for b in range(crossings.box_first[robot], crossings.box_first[robot + 1]):
            c = crossings.crossing[b]
            p = passage_of[c, 0 if crossings.robots[c, 0] == robot else 1]
            if counts[p, 0] == box_first[p, 0]:
                table[p, 0], table[p, 1], table[p, 2] = c, crossings.other[b], crossings.cell[b]
            table[p, 3] = crossings.cell[b]
            box[counts[p, 0]] = np.int32(b)
            counts[p, 0] += 1
            along[p, 0] = min(along[p, 0], crossings.low[b])
            along[p, 1] = max(along[p, 1], crossings.high[b])
    for p in range(found):
        begin, end = courses.first[table[p, 1]], courses.first[table[p, 1] + 1] - 1
        for side in range(2):
            table[p, 4 + side] = node_before(courses.distance, begin, end, along[p, side])
    return PackedPassages(
        first[:, 0], table[:, 0].copy(), table[:, 1].copy(), table[:, 2].copy(),
        table[:, 3].copy(), table[:, 4].copy(), table[:, 5].copy(), box_first[:, 0], box,
    )  # fmt: skip
