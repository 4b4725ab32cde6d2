"""Runs of the boxes of two robots, and the sets that these are joined to.

Tested through ``fleet/test_crossings``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.grouped_boxes import BEGIN, END, NOWHERE, GroupedBoxes
from viaspline.kernels.fleet.near_boxes import HIGH, LOW
from viaspline.kernels.growable import new_floats, new_ints
from viaspline.kernels.jit import inlined, inner

FROM: Final = 2
UNTIL: Final = 3
SO_FAR: Final = 4  # the farthest that a run up to this one has its cells [m]
BOUND_COLUMNS: Final = 5


class Runs(NamedTuple):
    """Boxes of two groups that face each other, in runs: one box a cell, each overlapping the next.

    Attributes:
        part: From where to where in the grouped boxes, (r, 2).
        bound: The lowest and the highest distance along the other's path [m], and where its cells
            begin and end along its own; these begin in order, and end by ``SO_FAR``,
            (r, BOUND_COLUMNS).
        parent: Of the sets that runs are joined to; the lowest run of a set is its own, (r, 1).
        named: Room for a number each, (r, 1).
    """

    part: Ints
    bound: Floats
    parent: Ints
    named: Ints


@inner
def room_for_runs(count: int) -> Runs:
    """Runs that are yet to be written."""
    return Runs(
        new_ints(count, 2), new_floats(count, BOUND_COLUMNS), new_ints(count, 1), new_ints(count, 1)
    )


@inlined
def root_of(parent: Ints, i: int) -> int:
    """Whose set a member belongs to."""
    while parent[i, 0] != i:
        parent[i, 0] = parent[parent[i, 0], 0]
        i = parent[i, 0]
    return i


@inlined
def unite(parent: Ints, i: int, j: int) -> None:
    """Make one set of two; the lower root stays."""
    i, j = root_of(parent, i), root_of(parent, j)
    parent[max(i, j), 0] = min(i, j)


@inlined
def cut_runs(
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
        before = runs.bound[run - 1, SO_FAR] if run > offset else -np.inf
        runs.bound[run, SO_FAR] = max(before, runs.bound[run, UNTIL])
    return count, is_shared


@inlined
def join_one_side(boxes: GroupedBoxes, first: int, last: int, runs: Runs) -> None:
    """Join the runs of one side that have boxes in consecutive cells whose intervals overlap.

    Boxes lie in the order of their cells, so each is held against those of the cell before.
    """
    cell, interval, part = boxes.cell, boxes.interval, runs.part
    start = part[first, 0] if first < last else 0
    begin, end, of_begin = start, start, first  # the boxes of the cell before, whose the first is
    here, of_here = start, first
    for run in range(first, last):
        for at in range(part[run, 0], part[run, 1]):
            if at > start and cell[at, 0] != cell[at - 1, 0]:
                is_next = cell[at, 0] == cell[at - 1, 0] + 1
                begin, end, of_begin = (here, at, of_here) if is_next else (at, at, run)
                here, of_here = at, run
            other = of_begin
            for at2 in range(begin, end):
                while at2 >= part[other, 1]:
                    other += 1
                if (
                    interval[at2, LOW] <= interval[at, HIGH]
                    and interval[at, LOW] <= interval[at2, HIGH]
                ):
                    unite(runs.parent, run, other)


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
def _first_beside(bound: Floats, run: int, begin: int, end: int) -> int:
    """The first run of the other side some of whose cells may not end before a run's boxes."""
    while begin < end:
        middle = (begin + end) // 2
        if bound[middle, SO_FAR] < bound[run, LOW]:
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
def join_sides(boxes: GroupedBoxes, distance: Floats, ours: int, all_runs: int, runs: Runs) -> None:
    """Join runs of both sides that touch.

    What is too near in a run lies in runs of the other side. So where each has but one that may
    touch it, it is that one.
    """
    named, is_plain = runs.named, True
    for run in range(all_runs):
        named[run, 0] = NOWHERE
    for run in range(ours):
        for other in range(_first_beside(runs.bound, run, ours, all_runs), all_runs):
            if runs.bound[other, FROM] > runs.bound[run, HIGH]:
                break
            if _may_touch(runs.bound, run, other):
                is_plain = is_plain and named[run, 0] == NOWHERE and named[other, 0] == NOWHERE
                named[run, 0], named[other, 0] = other, run
    for run in range(ours):
        for other in range(_first_beside(runs.bound, run, ours, all_runs), all_runs):
            if runs.bound[other, FROM] > runs.bound[run, HIGH]:
                break
            if _may_touch(runs.bound, run, other) and (
                is_plain or _touch(boxes, distance, runs, run, other)
            ):
                unite(runs.parent, run, other)
