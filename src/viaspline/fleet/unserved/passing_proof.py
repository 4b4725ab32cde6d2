"""Is it proven that two robots can't both get to where they have to, whatever they do?

The plane is cut into squares. Two robots may be in two squares together if somewhere in these they
are far enough from each other and from what stands: that takes too much for possible, never too
little. When a robot goes from one square to another it is in both for an instant, so a pair of
drives is a row of pairs of squares, of which one changes at a time. Where no such row leads from
both starts past all points of both routes there is no pair of drives: proven, for robots of every
kind of drive and at any speed. Other robots can't help.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Steps
from viaspline.world.world import World

FINENESS = (900, 2_500)
"""About how many squares there are, one number after the other."""
EDGE_SHARE = 1e-9
"""Of a square: rounding of what is kept."""
TOUCHING_M = 1e-5
"""By so much less than asked robots may be apart: rounding [m]."""


@dataclass(frozen=True)
class PassingRobot:
    """One of two robots.

    Attributes:
        points: The places of its route in order [m], (k, 2).
        kept: What its centre keeps of the world at least [m].
        reach: Its body, with half of what two bodies keep of each other [m].
        leaves: Whether it leaves the world at its goal.
    """

    points: tuple[tuple[float, float], ...]
    kept: float
    reach: float
    leaves: bool = False


@dataclass(frozen=True, eq=False)
class _Squares:
    """Squares over the bounds of a world.

    Attributes:
        low: The corner with the least coordinates [m], (2,).
        side: Of a square [m].
        middles: [m], (rows, columns, 2).
    """

    low: Floats
    side: float
    middles: Floats

    @classmethod
    def over(cls, bounds: Sequence[float], count: int) -> _Squares:
        """About so many squares over bounds."""
        x_min, y_min, x_max, y_max = bounds
        side = math.sqrt((x_max - x_min) * (y_max - y_min) / count)
        shape = math.ceil((y_max - y_min) / side), math.ceil((x_max - x_min) / side)
        rows, columns = (side * (np.arange(n) + 0.5) for n in shape)
        middles = np.stack(np.meshgrid(x_min + columns, y_min + rows), axis=-1)
        return cls(np.array([x_min, y_min]), side, middles)

    @property
    def half(self) -> float:
        """Half of a square's diagonal [m]."""
        return self.side * math.sqrt(0.5) * (1.0 + EDGE_SHARE)

    def of(self, place: tuple[float, float]) -> tuple[int, int]:
        """Row and column of a place."""
        column, row = np.floor((np.array(place) - self.low) / self.side).astype(int).tolist()
        rows, columns = self.middles.shape[:2]
        return min(max(row, 0), rows - 1), min(max(column, 0), columns - 1)


def cannot_both_arrive(world: World, first: PassingRobot, second: PassingRobot) -> bool:
    """Whether it is proven that two robots can't both drive their routes in one world.

    Args:
        world: With bounds; nothing is proven where there are none.
        first: One of them.
        second: The other one.

    Example:
        >>> from viaspline.mission.model import Mission
        >>> ends = (1.0, 0.6), (9.0, 0.6)
        >>> there, back = (PassingRobot(one, 0.5, 0.5) for one in (ends, ends[::-1]))
        >>> aisle, hall = (World(bounds=(0, 0, 10, height)) for height in (1.2, 6.0))
        >>> cannot_both_arrive(aisle, there, back), cannot_both_arrive(hall, there, back)
        (True, False)
    """
    if world.bounds is None:
        return False
    return any(
        _is_impossible(world, _Squares.over(world.bounds, count), first, second)
        for count in FINENESS
    )


def _is_impossible(
    world: World, squares: _Squares, first: PassingRobot, second: PassingRobot
) -> bool:
    """Whether squares of one size prove it."""
    regions = _regions(world, squares, first, second)
    one, two = ([squares.of(place) for place in robot.points] for robot in (first, second))
    begin, end = int(regions[(*one[0], *two[0])]), int(regions[(*one[-1], *two[-1])])
    somebody_leaves = first.leaves or second.leaves
    reached, states = {(0, 0, begin)}, [(0, 0, begin)]
    while states:
        i, j, region = states.pop()
        are_there = i == len(one) - 1 and j == len(two) - 1
        if are_there and (region == end or somebody_leaves):
            return False
        for state in _next(regions, one, two, i, j, region, first, second):
            if state not in reached:
                reached.add(state)
                states.append(state)
    return True


def _next(
    regions: Steps, one: list[tuple[int, int]], two: list[tuple[int, int]], i: int, j: int,
    region: int, first: PassingRobot, second: PassingRobot,
) -> Iterator[tuple[int, int, int]]:  # fmt: skip
    """Which points both can have got to next, and where they are then: -1 if one has left."""
    if i + 1 < len(one) and (region < 0 or (regions[one[i + 1]] == region).any()):
        yield i + 1, j, region
    if j + 1 < len(two) and (region < 0 or (regions[:, :, *two[j + 1]] == region).any()):
        yield i, j + 1, region
    if (first.leaves and i == len(one) - 1) or (second.leaves and j == len(two) - 1):
        yield i, j, -1


def _regions(world: World, squares: _Squares, first: PassingRobot, second: PassingRobot) -> Steps:
    """The connected regions of pairs of squares, numbered from 1; 0: not together.

    Shape (rows, columns, rows, columns).
    """
    from scipy.ndimage import label

    middles = squares.middles
    free = world.distance(middles.reshape(-1, 2)).reshape(middles.shape[:2]) + squares.half
    mine, its = (free >= robot.kept - TOUCHING_M for robot in (first, second))
    rows, columns = (middles[:, 0, 1], middles[0, :, 0])
    dy, dx = ((part[:, None] - part) ** 2 for part in (rows, columns))
    needed = first.reach + second.reach - 2.0 * squares.half - TOUCHING_M
    far: Flags = dy[:, None, :, None] + dx[None, :, None, :] >= max(needed, 0.0) ** 2
    found = label(mine[:, :, None, None] & its & far)[0]
    return np.asarray(found, np.int32)
