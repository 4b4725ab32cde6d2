"""Who passes first at every box of a fleet's crossings, by the steps of a lattice's order.

Tested through ``fleet/lattice_order/test_time_in_order``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings, box_owners
from viaspline.fleet.lattice_order.lattice_paths import PassingSteps
from viaspline.kernels.arrays import Flags, Floats, Ints

SURE = 1e6
"""What an order counts that is forced, in steps and in boxes."""
CLEAR_MAJORITY = 0.7
"""Of the boxes of a crossing, those for one order less those for the other."""


def passes_second(
    courses: FleetCourses,
    crossings: FleetCrossings,
    steps: Sequence[PassingSteps],
    vanishes: Flags,
) -> Flags:
    """Whether the robot of each box passes after the other one.

    The boxes of a crossing have one order, that of most of them, unless it holds several places at
    which robots pass in different orders. Who starts in a box passes first,
    and who rests there at its goal passes last, unless it leaves.

    Args:
        courses: The paths.
        crossings: Where they come near each other.
        steps: At which step each robot is where, in the order of the courses.
        vanishes: Which robots leave the world when they arrive, (n,).
    """
    packed, boxes = courses.packed, crossings.packed
    robot = box_owners(boxes)
    first, last = packed.first[robot], packed.first[robot + 1] - 1
    own = (packed.distance[boxes.cell] + packed.distance[boxes.cell + 1]) / 2.0
    other = (boxes.low + boxes.high) / 2.0
    later = _at(steps, robot, own) - _at(steps, boxes.other, other)
    other_last = packed.distance[packed.first[boxes.other + 1] - 1]
    rests, other_rests = ~vanishes[robot], ~vanishes[boxes.other]
    later[((boxes.cell == last - 1) & rests) | (boxes.low <= 0.0)] = SURE
    later[(boxes.cell == first) | ((boxes.high >= other_last) & other_rests)] = -SURE
    is_lower = robot == boxes.robots[boxes.crossing, 0]
    votes = np.sign(later) * np.where(is_lower, 1.0, -1.0)
    votes *= np.where(np.abs(later) == SURE, SURE, 1.0)
    total = np.bincount(boxes.crossing, votes, minlength=len(boxes.robots))[boxes.crossing]
    count = np.bincount(boxes.crossing, minlength=len(boxes.robots))[boxes.crossing]
    one_order = np.abs(total) >= CLEAR_MAJORITY * count
    lower_is_later = np.where(one_order, total, votes) > 0.0
    second: Flags = lower_is_later == is_lower
    return second


def _at(steps: Sequence[PassingSteps], robots: Ints, distances: Floats) -> Floats:
    """The step at which each of these robots is at a distance along its path."""
    found = np.empty(robots.size)
    for robot, one in enumerate(steps):
        of_it = robots == robot
        found[of_it] = one.at(distances[of_it])
    return found
