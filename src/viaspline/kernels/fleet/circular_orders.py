"""Robots whose orders have a circle: each waits for one that waits, in the end, for itself.

Tested through ``fleet/lattice_order/test_time_in_order``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Ints
from viaspline.kernels.fleet.blocked_times import node_before
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.jit import inner, kernel


@inner
def _awaited(courses: PackedCourses, crossings: PackedCrossings, second: Flags) -> Ints:
    """The node at which the other one has to have been before a box is free; -1: none, (boxes,)."""
    nodes = np.full(second.size, -1, np.int64)
    for b in range(second.size):
        if second[b]:
            first, last = courses.first[crossings.other[b]], courses.first[crossings.other[b] + 1]
            nodes[b] = node_before(courses.distance, first, last - 1, crossings.high[b])
    return nodes


@inner
def _boxes_by(nodes: Ints, count: int) -> tuple[Ints, Ints]:
    """Boxes sorted by a node of theirs, and where those of each node begin, (count + 1,)."""
    begin = np.zeros(count + 1, np.int64)
    for node in nodes:
        if node >= 0:
            begin[node + 1] += 1
    begin = np.cumsum(begin)
    boxes, free = np.empty(begin[-1], np.int64), begin.copy()
    for b in range(nodes.size):
        if nodes[b] >= 0:
            boxes[free[nodes[b]]] = b
            free[nodes[b]] += 1
    return boxes, begin


@inner
def _without_one(before: Ints, node: int, todo: Ints, known: int) -> int:
    """Take one of those away that are before a node; how many nodes are to do then."""
    before[node] -= 1
    if before[node] == 0:
        todo[known] = node
        known += 1
    return known


@kernel
def never_arrive(courses: PackedCourses, crossings: PackedCrossings, second: Flags) -> Flags:
    """Which robots can't arrive, whatever their speeds: their order has a circle, or is behind one.

    A robot is at a node after it was at the one before, and after those have been at theirs that
    pass before it. What is left when nodes are taken away that nothing is before is in a circle, or
    waits for one (Kahn, 1962).

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        second: Whether the robot of a box passes after the other one, (boxes,).

    Returns:
        (n,).
    """
    awaited = _awaited(courses, crossings, second)
    count = courses.distance.size
    boxes, begin = _boxes_by(awaited, count)
    before = np.ones(count, np.int64)
    before[courses.first[:-1]] = 0
    for b in boxes:
        before[crossings.cell[b]] += 1
    first = np.flatnonzero(before == 0)
    todo, known, done = np.empty(count, np.int64), first.size, 0
    todo[:known] = first
    is_last = np.zeros(count, np.bool_)
    is_last[courses.first[1:] - 1] = True
    while done < known:
        node = todo[done]
        done += 1
        for k in range(begin[node], begin[node + 1]):
            known = _without_one(before, crossings.cell[boxes[k]], todo, known)
        if not is_last[node]:
            known = _without_one(before, node + 1, todo, known)
    return before[courses.first[1:] - 1] > 0
