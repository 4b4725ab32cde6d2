"""The rest of a path that is being driven, as a re-plan finds it.

Tested through ``planning/replanning/test_replan``.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.path import Path, PathVia
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import CLEAR, body_conflicts
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.replanning.departure import Leave, rolling, turning_away, turns_at
from viaspline.planning.replanning.joined_stretch import joined
from viaspline.planning.replanning.rejoining import Rejoin, merging, turning
from viaspline.planning.replanning.sides_ahead import spans_on_wrong_side
from viaspline.planning.replanning.stretch import (
    PASSED_M,
    Stretch,
    leaving_place,
    vias_remaining,
    vias_to_serve,
)
from viaspline.world.world import World


@dataclass(frozen=True)
class WayAhead:
    """A path under way, from where it may be left, among what is known now.

    Attributes:
        path: All of it.
        at: Distance along it from which it may differ [m].
        u: The parameter there.
        world: What is known.
        requirements: What to keep.
        until: Distance along it from which it is not looked at yet [m], if it is a round that goes
            on at its end.
    """

    path: Path
    at: float
    u: float
    world: World
    requirements: Requirements
    until: float

    @classmethod
    def rolling(
        cls, path: Path, at: float, world: World, requirements: Requirements, until: float
    ) -> WayAhead:
        """What is ahead of a robot that leaves its path without a stop, from a distance on [m]."""
        return cls(path, *leaving_place(path, at), world, requirements, until)

    @classmethod
    def standing(
        cls, path: Path, at: float, world: World, requirements: Requirements, until: float
    ) -> WayAhead:
        """What is ahead of a robot that stands on its path, at a distance along it [m].

        One that never turns on the spot leaves it as one that rolls does.
        """
        if not requirements.turns_at_rest:
            return cls.rolling(path, at, world, requirements, until)
        return cls(path, at, float(path.parameter(at)), world, requirements, until)

    @property
    def curve(self) -> PiecewiseCubic:
        """It, to the end of the span that is at ``until`` or to its own end."""
        end = self.path.domain[1]
        if self.until < self.path.length:
            last = math.ceil(float(self.path.parameter(self.until)))
            end = max(float(last), math.floor(self.u) + 1.0)
        return self.path.section(min(self.u, end - PASSED_M), end)

    @property
    def users(self) -> list[PathVia]:
        """The via points of the path that have to be served."""
        return vias_to_serve(self.path, self.world, self.requirements)

    def remaining(self, skip: Collection[int]) -> tuple[PathVia, ...]:
        """Those that still are, but the route's points in ``skip``; see ``vias_remaining``."""
        return vias_remaining(self.path, self.at, self.world, self.requirements, skip)

    def blocked_spans(self) -> NDArray[np.intp]:
        """Indices of the spans that come too close to something, or pass it on a wrong side."""
        first = min(int(self.u), len(self.path.spans) - 1)
        close = body_conflicts(self.world, self.curve.spans, self.requirements)
        wrong = spans_on_wrong_side(self.path, self.u, self.world, self.requirements)
        return np.union1d(first + np.flatnonzero(close != CLEAR), np.array(sorted(wrong), np.intp))

    def blocked_until(self, skip: Collection[int]) -> float:
        """Where the last of these ends along the path, and the last of its points in ``skip`` [m].

        Args:
            skip: Indices in the route of via points that are left out.
        """
        blocked = 1.0 + self.blocked_spans()
        left_out = [via.u for via in self.path.vias if via.index in skip and via.u > self.u]
        return float(self.path.distance(max([self.u, *blocked.tolist(), *left_out])))

    def joined(self, stretch: Stretch, leave: Leave, rejoin_by: Rejoin = merging) -> Solution:
        """The path with a stretch of it laid anew; see ``joined_stretch``.

        Where the old one has a corner at a station it is left and taken up in any direction.

        Args:
            stretch: What of it.
            leave: How it is left.
            rejoin_by: How it is taken up again.

        Raises:
            NoPathError: When there is no way.
            SpentBudgetError: When there is no time left to look for one.
        """
        tail, needs = stretch.tail, self.requirements
        if leave is rolling and turns_at(self.path, stretch.u, needs):
            leave = turning_away
        if rejoin_by is merging and tail is not None and turns_at(self.path, tail.u, needs):
            rejoin_by = turning
        return joined(
            self.path, stretch, self.world, self.requirements, self.until, leave, rejoin_by
        )
