"""The boxes of a fleet's crossings, passage by passage."""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.kernels.arrays import Ints, Steps
from viaspline.kernels.fleet.blocked_times import node_before
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.growable import new_floats, new_ints
from viaspline.kernels.jit import inner, kernel

NONE: Final = -1


@inner
def _number_boxes(crossings: PackedCrossings, of_box: Steps, first: Ints, counts: Ints) -> int:
    """Number the passages of all robots, and count their boxes. How many passages there are.

    Args:
        crossings: PackedCrossings.
        of_box: The passage of each box, (boxes,), filled in.
        first: Where the passages of each robot begin, (n + 1, 1), filled in.
        counts: Of their boxes, (2 c, 1), filled in.
    """
    found = 0
    latest = np.full(crossings.robots.shape[0], np.int32(NONE))  # passage of each crossing
    for robot in range(crossings.box_first.shape[0] - 1):
        begin = found
        first[robot, 0] = found
        for b in range(crossings.box_first[robot], crossings.box_first[robot + 1]):
            c = crossings.crossing[b]
            if latest[c] < begin:
                latest[c] = np.int32(found)
                counts[found, 0] = 0
                found += 1
            of_box[b] = latest[c]
            counts[latest[c], 0] += 1
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
    total = crossings.cell.shape[0]
    of_box, first = np.empty(total, np.int32), new_ints(robots + 1, 1)
    counts = new_ints(2 * crossed, 1)
    found = _number_boxes(crossings, of_box, first, counts)
    table, box_first = new_ints(found, 6), new_ints(found + 1, 1)
    along = new_floats(found, 2)  # from where to where along the other's path [m]
    at = 0
    for p in range(found):
        box_first[p, 0] = at
        at += counts[p, 0]
        counts[p, 0] = box_first[p, 0]
        along[p, 0], along[p, 1] = np.inf, -np.inf
    box_first[found, 0] = at
    box, cell = np.empty(total, np.int32), np.empty(total, np.int32)
    interval = np.empty((total, 2))
    for b in range(total):
        p = of_box[b]
        at = counts[p, 0]
        low, high = crossings.low[b], crossings.high[b]
        if at == box_first[p, 0]:
            table[p, 0], table[p, 1] = crossings.crossing[b], crossings.other[b]
            table[p, 2] = crossings.cell[b]
        table[p, 3] = crossings.cell[b]
        box[at], cell[at] = np.int32(b), np.int32(crossings.cell[b])
        interval[at, 0], interval[at, 1] = low, high
        counts[p, 0] = at + 1
        along[p, 0], along[p, 1] = min(along[p, 0], low), max(along[p, 1], high)
    for p in range(found):
        begin, end = courses.first[table[p, 1]], courses.first[table[p, 1] + 1] - 1
        for side in range(2):
            table[p, 4 + side] = node_before(courses.distance, begin, end, along[p, side])
    return PackedPassages(
        first[:, 0], table[:, 0].copy(), table[:, 1].copy(), table[:, 2].copy(),
        table[:, 3].copy(), table[:, 4].copy(), table[:, 5].copy(), box_first[:, 0], box, cell,
        interval,
    )  # fmt: skip
