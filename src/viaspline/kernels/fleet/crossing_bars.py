"""The bars of a fleet, from the boxes of its crossings.

While the second robot of a crossing is in a cell of its own, the leader must not be in a box: so
the second one stays before the cell until the leader has left the box. Or by the leader's boxes:
the second one stays before the box until the leader has left its cell. Either set of bars is enough
by itself.

Tested through ``fleet/execution/test_fleet_orders``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.blocked_times import comes_in_cell, node_before, node_near
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.jit import kernel


@kernel
def crossing_bars(
    courses: PackedCourses, crossings: PackedCrossings, leaders: Ints, by_second: Flags
) -> tuple[Ints, Floats]:
    """The bars of both robots of every crossing that has a leader.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        leaders: Of the crossings, (c,).
        by_second: Whether the bars of the second robot are made from its own boxes; those of the
            leader, in case it becomes the second, always are, (c,).

    Returns:
        Robot, other robot and crossing of each bar, (bars, 3); its place, and where the other has
        passed it [m], (bars, 2).
    """
    room = 2 * crossings.cell.size
    who = np.empty((room, 3), np.int64)
    where = np.empty((room, 2))
    count = 0
    most = np.full((crossings.robots.shape[0], 2), -np.inf)  # asked for by the bars before
    least = np.full(crossings.robots.shape[0], np.inf)
    for robot in range(crossings.box_first.size - 1):
        begin, end = crossings.box_first[robot], crossings.box_first[robot + 1]
        for b in range(begin, end):
            c = crossings.crossing[b]
            leads = leaders[c] == robot
            side = 0 if crossings.robots[c, 0] == robot else 1
            if leaders[c] >= 0 and (leads or by_second[c]) and crossings.high[b] > most[c, side]:
                most[c, side] = crossings.high[b]
                who[count, 0], who[count, 1], who[count, 2] = robot, crossings.other[b], c
                where[count, 0] = courses.distance[crossings.cell[b]]
                where[count, 1] = crossings.high[b]
                count += 1
        for b in range(end - 1, begin - 1, -1):
            c = crossings.crossing[b]
            if leaders[c] == robot and not by_second[c] and crossings.low[b] < least[c]:
                least[c] = crossings.low[b]
                who[count, 0], who[count, 1], who[count, 2] = crossings.other[b], robot, c
                where[count, 0] = crossings.low[b]
                where[count, 1] = courses.distance[crossings.cell[b] + 1]
                count += 1
    return who[:count], where[:count]


@kernel
def set_bar_times(courses: PackedCourses, alone: PackedLaws, orders: PackedOrders) -> None:
    """Reckon when robots that never wait come to bars, and past them, and bounds of crossings.

    Args:
        courses: PackedCourses.
        alone: The laws of robots that set out at 0 and never wait for another.
        orders: ``comes``, ``other_comes``, ``final`` and ``most`` are written to.
    """
    count = orders.robots.shape[0]
    for c in range(count):
        for side in range(2):
            orders.final[c, side] = orders.most[c, side] = -np.inf
    nodes = np.full((count, 2), -1)  # of the other, by the bar before of the crossing and side
    for robot in range(orders.length.size):
        k, last = courses.first[robot], courses.first[robot + 1] - 1
        for b in range(orders.first[robot], orders.first[robot + 1]):
            c, other, place = orders.crossing[b], orders.other[b], orders.place[b]
            side = 0 if orders.robots[c, 0] == robot else 1
            passed = min(orders.passed[b], orders.length[other])
            k = node_near(courses.distance, courses.first[robot], last, k, place)
            orders.comes[b] = max(comes_in_cell(courses, alone, robot, k, place), 0.0)
            first, end = courses.first[other], courses.first[other + 1] - 1
            if nodes[c, side] < 0:
                nodes[c, side] = node_before(courses.distance, first, end, passed)
            else:
                nodes[c, side] = node_near(courses.distance, first, end, nodes[c, side], passed)
            orders.other_comes[b] = max(
                comes_in_cell(courses, alone, other, nodes[c, side], passed), 0.0
            )
            orders.final[c, side] = max(orders.final[c, side], orders.passed[b])
            later = orders.other_comes[b] - orders.comes[b]
            orders.most[c, side] = max(orders.most[c, side], later)
