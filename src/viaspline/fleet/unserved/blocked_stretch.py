"""Where a robot that couldn't be timed is in the way of another one, or that one in its way.

Tested through ``fleet/test_unserved_fleets``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.fleet.courses import END_CELL_M
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.kernels.arrays import Floats


@dataclass(frozen=True)
class BlockedStretch:
    """A stretch on which two robots can't be at once, of which one can't let the other pass.

    Attributes:
        robot: The one that isn't served.
        other: The other one.
        span: From where to where along the path of the robot, and of the other [m].
        ends: The places where it begins and ends on the path of the robot [m].
        at_start: Whether the robot's start lies in it.
        at_goal: Whether its goal does, at which it stays.
        other_start: Whether the other one's start does.
        other_goal: Whether the other one's goal does, at which it stays.
    """

    robot: int
    other: int
    span: tuple[float, float, float, float]
    ends: tuple[tuple[float, float], tuple[float, float]]
    at_start: bool
    at_goal: bool
    other_start: bool
    other_goal: bool

    @property
    def is_rest(self) -> bool:
        """Whether one of the two rests in it."""
        return self.at_start or self.at_goal or self.other_start or self.other_goal

    @property
    def length(self) -> float:
        """Of the stretch along the path of the robot [m]."""
        return self.span[1] - self.span[0]


def blocked_stretches(timed: TimedFleet, robot: int, other: int) -> list[BlockedStretch]:
    """The stretches on which two robots are in each other's way; those with a rest come first.

    Args:
        timed: The fleet.
        robot: The one that isn't served.
        other: The one that is in its way.
    """
    ways = timed.ways
    packed, courses = ways.crossings.packed, ways.courses.packed
    lengths = courses.distance[courses.first[1:] - 1]
    path = ways.plans[robot].path
    found = []
    for k in np.flatnonzero((packed.robots == sorted((robot, other))).all(axis=1)).tolist():
        span = packed.span[k] if packed.robots[k, 0] == robot else packed.span[k][[2, 3, 0, 1]]
        places: Floats = np.asarray(path.at_distance(np.clip(span[:2], 0.0, path.length)))[:, :2]
        (x0, y0), (x1, y1) = places.tolist()
        own, its = (
            (bool(low <= END_CELL_M), bool(high >= lengths[k] - END_CELL_M and stays))
            for k, low, high, stays in (
                (robot, *span[:2], not ways.rides.packed.vanishes[robot]),
                (other, *span[2:], not ways.rides.packed.vanishes[other]),
            )
        )
        a, b, c, d = span.tolist()
        found.append(BlockedStretch(robot, other, (a, b, c, d), ((x0, y0), (x1, y1)), *own, *its))
    return sorted(found, key=lambda one: (not one.is_rest, -one.length))
