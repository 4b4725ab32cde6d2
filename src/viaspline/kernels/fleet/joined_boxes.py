"""Crossings: connected sets of boxes of two robots, seen from either of them.

Boxes of one robot in consecutive cells are connected where their intervals overlap, and boxes of
the one with boxes of the other where they do as rectangles in the plane of both distances. Either
side covers all that is too near, so a set that only one side has is none: it is left out.

Tested through ``fleet/test_crossings``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints, Steps
from viaspline.kernels.fleet.box_runs import (
    Runs,
    cut_runs,
    join_one_side,
    join_sides,
    room_for_runs,
    root_of,
)
from viaspline.kernels.fleet.grouped_boxes import (
    BEGIN,
    END,
    NOWHERE,
    ROBOT,
    GroupedBoxes,
    facing,
    grouped,
    keep_crossing,
)
from viaspline.kernels.fleet.near_boxes import HIGH, LOW, RawBoxes
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.growable import new_floats, new_ints, sized_floats, sized_ints
from viaspline.kernels.jit import inlined, kernel


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
        root = root_of(runs.parent, run)
        if root < ours and named[root, 0] == NOWHERE:
            named[root, 0] = 0
    for root in range(ours):
        if named[root, 0] != NOWHERE:
            named[root, 0] = found
            span[found, 0], span[found, 2] = np.inf, np.inf
            span[found, 1], span[found, 3] = -np.inf, -np.inf
            found += 1
    for run in range(all_runs):
        row = named[root_of(runs.parent, run), 0]
        if row == NOWHERE:
            continue
        column = 2 if run < ours else 0  # a box is tight along the other's path
        span[row, column] = min(span[row, column], runs.bound[run, LOW])
        span[row, column + 1] = max(span[row, column + 1], runs.bound[run, HIGH])
        for at in range(runs.part[run, 0], runs.part[run, 1]):
            boxes.crossing[at, 0] = row
    return found


@kernel
def joined_boxes(courses: PackedCourses, boxes: RawBoxes) -> tuple[Ints, Floats, Ints, Steps, int]:
    """Crossings from the boxes of every robot.

    Args:
        courses: PackedCourses.
        boxes: RawBoxes; those that are in no crossing are left out, in place.

    Returns:
        (robots (c, 2), span (c, 4), first (n + 1,), crossing, how many boxes are left): see
        ``PackedCrossings``.
    """
    by_other = grouped(boxes)
    pairs = facing(by_other)
    groups = by_other.groups
    runs = room_for_runs(1024)
    robots, span = new_ints(pairs.shape[0] + 1024, 2), new_floats(pairs.shape[0] + 1024, 4)
    found = 0
    for pair in range(pairs.shape[0]):
        one, two = pairs[pair, 0], pairs[pair, 1]
        both = groups[one, END] - groups[one, BEGIN] + groups[two, END] - groups[two, BEGIN]
        if both > runs.parent.shape[0]:
            runs = room_for_runs(2 * both)
        ours, is_shared = cut_runs(by_other, courses.distance, one, 0, runs)
        all_runs, is_shared2 = cut_runs(by_other, courses.distance, two, ours, runs)
        if is_shared:
            join_one_side(by_other, 0, ours, runs)
        if is_shared2:
            join_one_side(by_other, ours, all_runs, runs)
        join_sides(by_other, courses.distance, ours, all_runs, runs)
        if found + ours > span.shape[0]:
            robots = sized_ints(robots, found, 2 * (found + ours))
            span = sized_floats(span, found, 2 * (found + ours))
        before = found
        found = _name(by_other, ours, all_runs, runs, span, before)
        for row in range(before, found):
            robots[row, 0], robots[row, 1] = groups[one, ROBOT], groups[two, ROBOT]
    first = new_ints(boxes.first.shape[0], 1)
    crossing = by_other.cell  # its memory: nobody asks for cells any more
    kept = keep_crossing(boxes, by_other, first, crossing)
    return (
        sized_ints(robots, found, found), sized_floats(span, found, found), first[:, 0],
        crossing[:, 0], kept,
    )  # fmt: skip
