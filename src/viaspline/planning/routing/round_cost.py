"""What a round costs that serves via points in an order: its length, or the time it takes.

Time is that of straight lines as long as the ways between the points, from halt to halt, more
slowly in zones, and of the turns at those that the robot runs through: what an order is about. What
the ways themselves bend is left out.

Tested through ``planning/routing/test_visit_order``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.planning.checking.driving_time import straight_time
from viaspline.planning.problem.path_pace import Pace


@dataclass(frozen=True, eq=False)
class WaysBetween:
    """The shortest ways between all points of a route.

    Attributes:
        lengths: From each to each [m], infinite where there is none, (n, n).
        leaving: In which direction each begins [rad], (n, n).
        arriving: In which it ends [rad], (n, n).
        slowed: How much longer each takes for the zones on it [s], (n, n).
    """

    lengths: Floats
    leaving: Floats
    arriving: Floats
    slowed: Floats


@dataclass(frozen=True, eq=False)
class RoundLength:
    """How long a round is.

    Attributes:
        lengths: See ``WaysBetween``.
    """

    lengths: Floats

    def of(self, stops: tuple[int, ...]) -> float:
        """The round past some points, in their order [m]."""
        at = np.array(stops)
        return float(self.lengths[at[:-1], at[1:]].sum())


@dataclass(frozen=True, eq=False)
class RoundTime:
    """How long a round takes.

    Attributes:
        ways: Between its points.
        turning: What a turn at a place costs by whole degrees [s], (181,).
        stands: Whether the robot stands still at each point, (n,).
        pace: How fast it may go.
    """

    ways: WaysBetween
    turning: Floats
    stands: Flags
    pace: Pace

    @classmethod
    def of_pace(cls, ways: WaysBetween, stands: Flags, pace: Pace) -> RoundTime:
        """The rounds of a robot."""
        turning = pace.corner_times(np.radians(np.arange(181.0)))
        return cls(ways, turning, stands, pace)

    def of(self, stops: tuple[int, ...]) -> float:
        """The round past some points, in their order, from halt to halt [s]."""
        ways, total, run = self.ways, 0.0, 0.0
        legs = list(pairwise(stops))
        for k, (i, j) in enumerate(legs):
            run += float(ways.lengths[i, j])
            total += float(ways.slowed[i, j])
            if self.stands[j] or k == len(legs) - 1:
                total += straight_time(run, self.pace) if run < math.inf else math.inf
                run = 0.0
            else:
                turn = ways.leaving[j, legs[k + 1][1]] - ways.arriving[i, j]
                whole = abs(math.degrees(math.remainder(turn, math.tau)))
                total += float(self.turning[round(whole)])
        return total
