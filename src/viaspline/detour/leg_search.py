"""One leg of a course on its way round what it meets: ways, curves along them, and their prices."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.detour.barrier import Barriers, barriers_of
from viaspline.detour.brief import Brief
from viaspline.detour.course import Course
from viaspline.detour.fit import Fitted, fit
from viaspline.detour.ledger import Candidate, LedgerEntry
from viaspline.detour.measure import Measured, measure
from viaspline.detour.route import NO_BARRIERS, Flags, Floats, Router, Way
from viaspline.mission.parts import Side
from viaspline.world.world import World

SIDES: tuple[Side, Side] = ("left", "right")


@dataclass(frozen=True)
class Met:
    """A group that stands in the way of a leg.

    Attributes:
        members: The names of its obstacles.
        barriers: What closes either side of it.
    """

    members: tuple[str, ...]
    barriers: Barriers

    def side_of(self, way: Way) -> Side:
        """The side on which a way passes it."""
        return "right" if way.crosses(self.barriers.right) else "left"


@dataclass(frozen=True)
class Curve:
    """A spline that was fitted to a way, and what it costs."""

    way: Way
    fitted: Fitted
    measured: Measured


@dataclass(frozen=True)
class LegSearch:
    """A leg in its course and world.

    Attributes:
        course: What there is so far.
        index: The leg.
        world: The known world.
        brief: What to keep.
        router: Of this world and brief.
    """

    course: Course
    index: int
    world: World
    brief: Brief
    router: Router

    @property
    def ends(self) -> tuple[Floats, Floats]:
        """The places of the via points before and after [m], shape (d,)."""
        start, goal = self.course.ends(self.index)
        return start.at, goal.at

    def shortest_allowed(
        self, active: Flags, closed: Floats = NO_BARRIERS
    ) -> tuple[Way | None, Floats]:
        """The shortest way that passes what it meets on the sides that the mission allows.

        A way can meet obstacles with a side of their own that were not met before; each such
        round adds at least one barrier, so there are no more rounds than obstacles.

        Args:
            active: (n,): obstacles to begin with; those met are added in place.
            closed: Further segments not to cross, (b, 4).

        Returns:
            The way, or None where there is none, and the barriers that forbid sides, (f, 4).
        """
        barriers = self.forced_barriers(active)
        while True:
            way = self.router.find(*self.ends, np.vstack((closed, barriers)), active)
            needed = self.forced_barriers(active)
            if len(needed) == len(barriers):
                return way, barriers
            barriers = needed

    def forced_barriers(self, active: Flags) -> Floats:
        """Barriers on the forbidden sides of those obstacles that allow one side only."""
        rows = [
            barriers_of(self.world, int(i), *self.ends).closing(opposite(forced))
            for i in np.flatnonzero(active)
            if (forced := self.world.obstacles[i].forced_side) is not None
        ]
        return np.vstack(rows) if rows else NO_BARRIERS

    def curve(self, way: Way | None) -> Curve | None:
        """The spline along a way, or None where no slack makes it clear."""
        if way is None:
            return None
        fitted = fit(self.course, self.index, way, self.world, self.brief.required)
        if fitted is None:
            return None
        return Curve(way, fitted, measure(fitted.spans, self.world, self.brief))

    def entry(self, group: Met, curves: Sequence[Curve], winner: Curve, reason: str) -> LedgerEntry:
        """The shortest of some curves on either side of a group."""
        candidates = []
        for side in SIDES:
            passing = [curve for curve in curves if group.side_of(curve.way) == side]
            best = min(passing, key=lambda curve: curve.measured.length, default=None)
            candidates.append(self._candidate(side, best, reason, chosen=best is winner))
        start, goal = self.course.ends(self.index)
        return LedgerEntry(group.members, (start.name, goal.name), tuple(candidates))

    def _candidate(
        self, side: Side, curve: Curve | None, reason: str, *, chosen: bool
    ) -> Candidate:
        if curve is None:
            dimension = len(self.ends[0])
            none = np.empty((0, dimension))
            return Candidate(side, none, none.reshape(0, 4, dimension), impossible=reason)
        return Candidate(
            side=side,
            vias=curve.fitted.course.legs[self.index].points,
            spans=curve.fitted.spans,
            length=curve.measured.length,
            clearance=curve.measured.clearance,
            max_curvature=curve.measured.max_curvature,
            chosen=chosen,
        )


def opposite(side: Side) -> Side:
    """The other side."""
    return "right" if side == "left" else "left"
