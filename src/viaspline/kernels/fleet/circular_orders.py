"""Places of robots whose orders have a circle: each waits for one that waits, in the end, for it.

A robot is at a node after it was at the one before, and after those have been at theirs that pass
before it.

Tested through ``fleet/lattice_order/test_time_in_order``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Ints, Steps
from viaspline.kernels.fleet.blocked_times import node_before
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.jit import inner, kernel, uncounted

FORWARD: Final = 1
BACKWARD: Final = -1


class BoxWaits(NamedTuple):
    """What the boxes of a fleet's crossings wait for, if their robots pass second.

    Attributes:
        awaited: The node at which the other one has to have been before a box is free, (boxes,).
        boxes: The boxes, those that wait for one node together, (boxes,).
        of_node: Where among these those of each node begin, (nodes + 1,).
        in_cell: Where the boxes of the cell of each node begin, (nodes + 1,).
    """

    awaited: Ints
    boxes: Ints
    of_node: Ints
    in_cell: Ints


@inner
def _first_of_each(nodes: Ints | Steps, count: int) -> Ints:
    """Where those of each node begin, once they are sorted by their nodes, (count + 1,)."""
    begin = np.zeros(count + 1, np.int64)
    for node in nodes:
        begin[node + 1] += 1
    return np.cumsum(begin)


@kernel
def box_waits(courses: PackedCourses, crossings: PackedCrossings) -> BoxWaits:
    """What the boxes of a fleet's crossings wait for.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
    """
    total, count = crossings.cell.size, courses.distance.size
    awaited, boxes = np.empty(total, np.int64), np.empty(total, np.int64)
    for b in range(total):
        first, last = courses.first[crossings.other[b]], courses.first[crossings.other[b] + 1]
        awaited[b] = node_before(courses.distance, first, last - 1, crossings.high[b])
    of_node = _first_of_each(awaited, count)
    free = of_node.copy()
    for b in range(total):
        boxes[free[awaited[b]]] = b
        free[awaited[b]] += 1
    return BoxWaits(awaited, boxes, of_node, _first_of_each(crossings.cell, count))


@uncounted
def _without_one(left: Ints, node: int, todo: Ints, known: int) -> int:
    """Take one of those away that a node hangs on; how many nodes are to do then."""
    left[node] -= 1
    if left[node] == 0:
        todo[known] = node
        known += 1
    return known


@uncounted
def _take_away(
    cell: Steps, waits: BoxWaits, second: Flags, ends: Flags, left: Ints, todo: Ints, known: int,
    way: int,
) -> None:  # fmt: skip
    """Take nodes away that nothing is before, or after, again and again (Kahn, 1962).

    Args:
        cell: See ``PackedCrossings``.
        waits: Of the same.
        second: Whether the robot of a box passes after the other one, (boxes,).
        ends: Whether a node is the last one of its robot, if ``way`` is forward, else the first
            one, (nodes,).
        left: How many each node hangs on, (nodes,); written to.
        todo: Those that hang on none, in front, (nodes,); written to.
        known: How many these are.
        way: Forward or backward.
    """
    done = 0
    while done < known:
        node = todo[done]
        done += 1
        if way == FORWARD:
            for k in range(waits.of_node[node], waits.of_node[node + 1]):
                if second[waits.boxes[k]]:
                    known = _without_one(left, cell[waits.boxes[k]], todo, known)
        else:
            for b in range(waits.in_cell[node], waits.in_cell[node + 1]):
                if second[b]:
                    known = _without_one(left, waits.awaited[b], todo, known)
        if not ends[node]:
            known = _without_one(left, node + way, todo, known)


@kernel
def in_circles(
    courses: PackedCourses, crossings: PackedCrossings, waits: BoxWaits, second: Flags
) -> Flags:
    """The nodes that are in a circle of orders, or between two such circles.

    Where there is none, all robots can arrive; a robot that has no such node waits for itself
    nowhere.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        waits: Of these.
        second: Whether the robot of a box passes after the other one, (boxes,).

    Returns:
        (nodes,).
    """
    count = courses.distance.size
    is_first, is_last = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
    is_first[courses.first[:-1]] = True
    is_last[courses.first[1:] - 1] = True
    before, after = np.ones(count, np.int64), np.ones(count, np.int64)
    before[is_first] = 0
    after[is_last] = 0
    for b in range(second.size):
        if second[b]:
            before[crossings.cell[b]] += 1
            after[waits.awaited[b]] += 1
    todo = np.empty(count, np.int64)
    for left, ends, way in ((before, is_last, FORWARD), (after, is_first, BACKWARD)):
        free = np.flatnonzero(left == 0)
        todo[: free.size] = free
        _take_away(crossings.cell, waits, second, ends, left, todo, free.size, way)
    return (before > 0) & (after > 0)
