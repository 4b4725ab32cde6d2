"""Who passes a crossing first, by the laws of a fleet.

A crossing is a connected set of pairs of places, and the laws of two robots are a curve among such
pairs that never goes back: it passes the set on the one side or on the other. So there is one
order for each crossing. Its boxes from the one robot's side and from the other's both cover it;
laws that keep clear of it need not keep clear of both covers, but of one. They may keep clear of
what both have in common alone: then who is first wherever one of them clearly is, passes first, and
the boxes of the second robot keep it away a little longer than its law does.

Tested through ``fleet/execution/test_fleet_orders``.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Ints
from viaspline.kernels.fleet.blocked_times import (
    comes_in_cell,
    goes_in_cell,
    node_before,
    node_near,
)
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.jit import inlined, kernel

UNSETTLED: Final = -1
"""The laws keep no order in a crossing."""
UNTIMED: Final = -2
"""One of its robots has no law."""
ROUNDING_S = 1e-6
"""So much of an overlap in time is rounding: the bars are what keeps robots apart."""


@inlined
def _node(courses: PackedCourses, robot: int, known: int, place: float) -> int:
    """The last node of a course before a place, sought from one nearby on if one is known."""
    first, last = courses.first[robot], courses.first[robot + 1] - 1
    if known < 0:
        return node_before(courses.distance, first, last, place)
    return node_near(courses.distance, first, last, known, place)


@kernel
def crossing_leaders(
    courses: PackedCourses, crossings: PackedCrossings, laws: PackedLaws
) -> tuple[Ints, Flags]:
    """The leader of every crossing.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        laws: PackedLaws.

    Returns:
        For each crossing its leader, or ``UNSETTLED`` or ``UNTIMED``, (c,); and whether its laws
        keep that order by the boxes of the second robot, else by those of the leader, (c,).
    """
    count = crossings.robots.shape[0]
    after = np.ones((count, 2), np.bool_)  # by the boxes of the one: the other passes before it
    before = np.ones((count, 2), np.bool_)
    earlier = np.zeros((count, 2), np.bool_)  # there is a box at which the one is first
    has_boxes = np.zeros((count, 2), np.bool_)
    nodes = np.full((count, 4), -1)  # of the box before, from either side
    for robot in range(crossings.box_first.size - 1):
        if not laws.is_timed[robot]:
            continue
        start, end = courses.first[robot], courses.first[robot + 1] - 1
        for b in range(crossings.box_first[robot], crossings.box_first[robot + 1]):
            c, other, cell = crossings.crossing[b], crossings.other[b], crossings.cell[b]
            if not laws.is_timed[other]:
                continue
            side = 0 if crossings.robots[c, 0] == robot else 1
            has_boxes[c, side] = True
            comes = -np.inf if cell == start else laws.arrive[cell]
            low, high = crossings.low[b], crossings.high[b]
            nodes[c, side] = _node(courses, other, nodes[c, side], low)
            nodes[c, 2 + side] = _node(courses, other, nodes[c, 2 + side], high)
            gone = goes_in_cell(courses, laws, other, nodes[c, 2 + side], high)
            goes = laws.leave[end] if cell + 1 == end else laws.arrive[cell + 1]
            there = comes_in_cell(courses, laws, other, nodes[c, side], low)
            is_after, is_before = gone <= comes + ROUNDING_S, goes <= there + ROUNDING_S
            after[c, side] &= is_after
            before[c, side] &= is_before
            earlier[c, 1 - side] |= is_after and not is_before
            earlier[c, side] |= is_before and not is_after
    leaders = np.full(count, UNSETTLED)
    by_second = np.zeros(count, np.bool_)
    after &= has_boxes  # where only one has boxes, they alone keep the robots apart
    before &= has_boxes
    for c in range(count):
        one, two = crossings.robots[c, 0], crossings.robots[c, 1]
        if not (laws.is_timed[one] and laws.is_timed[two]):
            leaders[c] = UNTIMED
        elif not has_boxes[c].any():
            leaders[c] = one
        elif after[c, 1] or before[c, 0]:
            leaders[c], by_second[c] = one, after[c, 1]
        elif after[c, 0] or before[c, 1]:
            leaders[c], by_second[c] = two, after[c, 0]
        elif earlier[c, 0] != earlier[c, 1] and has_boxes[c, 1 if earlier[c, 0] else 0]:
            leaders[c], by_second[c] = (one if earlier[c, 0] else two), True
    return leaders, by_second
