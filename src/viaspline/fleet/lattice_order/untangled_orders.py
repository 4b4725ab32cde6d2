"""Orders of a lattice without circles, as far as that can be.

Boxes are a little larger than the places at which robots are too near each other, and roundings of
corners lead a little off the lattice. So robots that barely pass each other on it may be told to
wait for each other. Mostly another order at one crossing of the circle mends that.

Tested through ``fleet/lattice_order/test_time_in_order``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.lattice_order.passing_orders import PassingOrders
from viaspline.kernels.arrays import Flags, Ints
from viaspline.kernels.fleet.circular_orders import BoxWaits, box_waits, in_circles
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings

EVERY_BOX = slice(None)
MOST_TRIED = 200
"""Crossings that are given other orders."""


def untangled_orders(
    courses: FleetCourses, crossings: FleetCrossings, orders: PassingOrders
) -> tuple[Flags, Flags]:
    """Turn orders round until there is no circle, or until no other order makes it smaller.

    The orders that are least clear come first.

    Args:
        courses: The paths.
        crossings: Where they come near each other.
        orders: Who passes first there.

    Returns:
        Whether the robot of each box passes after the other one, (boxes,); and the robots that
        still wait for each other in a circle, (n,).
    """
    graph = _Graph(courses.packed, crossings.packed, box_waits(courses.packed, crossings.packed))
    second = orders.second.copy()
    circles = graph.circles(second)
    left, size = MOST_TRIED, -1
    while circles.any() and left > 0 and size != (size := int(circles.sum())):
        found = np.unique(graph.crossings.crossing[graph.in_circles(second, circles)])
        for crossing in found[np.argsort(orders.clarity[found], kind="stable")].tolist():
            boxes = graph.boxes_of(crossing)
            if graph.in_circles(second, circles, boxes).any():
                circles = _with_another_order(graph, orders, second, circles, boxes)
                left -= 1
    owner = np.repeat(np.arange(len(courses.names)), np.diff(courses.packed.first))
    circular = np.zeros(len(courses.names), np.bool_)
    circular[owner[circles]] = True
    return second, circular


def _with_another_order(
    graph: _Graph, orders: PassingOrders, second: Flags, circles: Flags, boxes: Ints
) -> Flags:
    """Give one crossing another order if that makes circles smaller.

    Args:
        graph: Who waits for whom.
        orders: Who passes first by the steps of the lattice.
        second: Whether the robot of each box passes after the other one; written to.
        circles: The nodes in circles.
        boxes: Of the crossing.

    Returns:
        The nodes that are in circles then.
    """
    before = second[boxes]
    for other in orders.others(boxes):
        if (other == before).all():
            continue
        second[boxes] = other
        then = graph.circles(second)
        if then.sum() < circles.sum():
            return then
    second[boxes] = before
    return circles


class _Graph(NamedTuple):
    """Who waits for whom, once it is known who passes second."""

    courses: PackedCourses
    crossings: PackedCrossings
    waits: BoxWaits

    def circles(self, second: Flags) -> Flags:
        """The nodes that are in circles, or between two, (nodes,)."""
        return in_circles(self.courses, self.crossings, self.waits, second)

    def boxes_of(self, crossing: int) -> Ints:
        """The boxes of a crossing, (k,): its two robots have them."""
        first = self.crossings.box_first
        of_both = np.concatenate(
            [np.arange(first[k], first[k + 1]) for k in self.crossings.robots[crossing]]
        )
        found: Ints = of_both[self.crossings.crossing[of_both] == crossing]
        return found

    def in_circles(self, second: Flags, circles: Flags, boxes: Ints | slice = EVERY_BOX) -> Flags:
        """Which of some boxes are part of one, (k,)."""
        cells, awaited = self.crossings.cell[boxes], self.waits.awaited[boxes]
        found: Flags = second[boxes] & circles[cells] & circles[awaited]
        return found
