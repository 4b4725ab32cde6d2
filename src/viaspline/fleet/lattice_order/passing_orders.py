"""Who passes first at every box of a fleet's crossings, by the steps of a lattice's order.

Tested through ``fleet/lattice_order/test_time_in_order``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings, box_owners
from viaspline.fleet.lattice_order.lattice_paths import PassingSteps
from viaspline.kernels.arrays import Flags, Floats, Ints, Steps

CLEAR_MAJORITY = 0.5
"""Of the boxes of a crossing, those for one order less those for the other."""


@dataclass(frozen=True, eq=False)
class PassingOrders:
    """Who passes first at every box.

    Wherever two robots would be too near each other, at least one of the two waits for the other:
    a box of the one with the higher number is passed after all of the other's boxes that say so.

    Attributes:
        second: Whether the robot of a box passes after the other one, (boxes,).
        by_steps: The same by the steps of the box alone, (boxes,).
        forced: Where a robot starts or rests in a box: that says who passes first, (boxes,).
        is_lower: Whether the robot of a box has the lower number of the two, (boxes,).
        along: From where to where along its own path a box is [m], (boxes, 2).
        beside: From where to where along the other's path it is [m], (boxes, 2).
        clarity: How many of the boxes of a crossing are of one opinion, less the others, as a share
            of all, (c,).
    """

    second: Flags
    by_steps: Flags
    forced: Flags
    is_lower: Flags
    along: Floats
    beside: Floats
    clarity: Floats

    def others(self, boxes: Ints) -> tuple[Flags, ...]:
        """Orders in which the boxes of a crossing can be passed as well; what is forced stays.

        Args:
            boxes: Of one crossing, (k,).
        """
        forced, by_steps = self.forced[boxes], self.by_steps[boxes]
        opinions = (forced & by_steps, ~forced | by_steps, by_steps)
        return tuple(self.of_both(boxes, one) for one in opinions)

    def of_both(self, boxes: Ints, second: Flags) -> Flags:
        """The order of a crossing's boxes by what those of its lower robot say.

        Args:
            boxes: Of one crossing, (k,).
            second: Whether the robot of each passes after the other one; read of the lower robot's
                boxes alone, (k,).
        """
        is_lower = self.is_lower[boxes]
        first = boxes[is_lower & ~second]
        upper = boxes[~is_lower]
        meets = (
            (self.along[upper, None, 0] <= self.beside[None, first, 1])
            & (self.along[upper, None, 1] >= self.beside[None, first, 0])
            & (self.beside[upper, None, 0] <= self.along[None, first, 1])
            & (self.beside[upper, None, 1] >= self.along[None, first, 0])
        )
        found = second.copy()
        found[~is_lower] = meets.any(axis=1)
        return found


def passing_orders(
    courses: FleetCourses,
    crossings: FleetCrossings,
    steps: Sequence[PassingSteps],
    vanishes: Flags,
) -> PassingOrders:
    """Whether the robot of each box passes after the other one.

    Who starts in a box passes first, and who rests there at its goal passes last, unless it leaves.
    The other boxes of a crossing have one order, that of most of them, unless it holds several
    places at which robots pass in different orders.

    Args:
        courses: The paths.
        crossings: Where they come near each other.
        steps: At which step each robot is where, in the order of the courses.
        vanishes: Which robots leave the world when they arrive, (n,).
    """
    packed, boxes = courses.packed, crossings.packed
    robot, count = box_owners(boxes), len(boxes.robots)
    along = np.stack([packed.distance[boxes.cell], packed.distance[boxes.cell + 1]], axis=1)
    beside = np.stack([boxes.low, boxes.high], axis=1)
    forced, by_steps = _forced(courses, crossings, robot, vanishes)
    later = _at(steps, robot, along.mean(axis=1)) > _at(steps, boxes.other, beside.mean(axis=1))
    by_steps = np.where(forced, by_steps, later)
    is_lower = robot == boxes.robots[boxes.crossing, 0]
    has_vote = is_lower & ~forced
    votes = np.where(has_vote, np.where(by_steps, 1.0, -1.0), 0.0)
    total = np.bincount(boxes.crossing, votes, minlength=count)
    clarity = np.abs(total) / np.maximum(
        np.bincount(boxes.crossing, has_vote, minlength=count), 1.0
    )
    second = np.where(
        (clarity >= CLEAR_MAJORITY)[boxes.crossing] & ~forced, total[boxes.crossing] > 0.0, by_steps
    )
    orders = PassingOrders(second, by_steps, forced, is_lower, along, beside, clarity)
    return replace(orders, second=_of_all(orders, boxes.crossing, count))


def _forced(
    courses: FleetCourses, crossings: FleetCrossings, robot: Ints, vanishes: Flags
) -> tuple[Flags, Flags]:
    """Where starts and goals say who passes first, (boxes,), and whether the robot is second."""
    packed, boxes = courses.packed, crossings.packed
    first, last = packed.first[robot], packed.first[robot + 1] - 1
    other_last = packed.distance[packed.first[boxes.other + 1] - 1]
    rests, other_rests = ~vanishes[robot], ~vanishes[boxes.other]
    is_last = ((boxes.cell == last - 1) & rests) | (boxes.low <= 0.0)
    is_first = (boxes.cell == first) | ((boxes.high >= other_last) & other_rests)
    return is_last | is_first, is_last & ~is_first


def _of_all(orders: PassingOrders, crossing: Steps, count: int) -> Flags:
    """The order of all boxes by what those of each crossing's lower robot say, (boxes,)."""
    lower = orders.is_lower
    seconds = np.bincount(crossing[lower], orders.second[lower], minlength=count)
    every = np.bincount(crossing[lower], minlength=count)
    second = np.where(lower, orders.second, seconds[crossing] == 0.0)
    mixed = np.flatnonzero((seconds > 0.0) & (seconds < every))
    by_crossing = np.argsort(crossing, kind="stable")
    begin = np.searchsorted(crossing[by_crossing], np.arange(count + 1))
    for k in mixed.tolist():
        boxes = by_crossing[begin[k] : begin[k + 1]]
        second[boxes] = orders.of_both(boxes, orders.second[boxes])
    return second


def _at(steps: Sequence[PassingSteps], robots: Ints | Steps, distances: Floats) -> Floats:
    """The step at which each of these robots is at a distance along its path."""
    found = np.empty(robots.size)
    by_robot = np.argsort(robots, kind="stable")
    begin = np.searchsorted(robots[by_robot], np.arange(len(steps) + 1))
    for robot, one in enumerate(steps):
        of_it = by_robot[begin[robot] : begin[robot + 1]]
        found[of_it] = one.at(distances[of_it])
    return found
