"""One leg of a course on its way round what it meets: ways, curves along them, and their prices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.alternatives.fit import Fitted, fit
from viaspline.planning.checking.cost import CandidateCost, measure
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.routing.router import NO_BARRIERS, Router, TautPath
from viaspline.planning.routing.side_barrier import barriers_of
from viaspline.world.world import World


@dataclass(frozen=True)
class Curve:
    """A curve along a way, and what it costs.

    Attributes:
        taut_path: What it follows.
        vias: Its detour via points [m], shape (k, d).
        spans: Bézier control polygons of the whole leg [m], shape (m, 4, d).
        measured: Its price.
    """

    taut_path: TautPath
    vias: Floats
    spans: Floats
    measured: CandidateCost


@dataclass(frozen=True)
class Spline(Curve):
    """The spline that was fitted to a way.

    Attributes:
        fitted: The course with it.
    """

    fitted: Fitted


@dataclass(frozen=True)
class LegSearch:
    """A leg in its course and world.

    Attributes:
        sequence: What there is so far.
        index: The leg.
        world: The known world.
        requirements: What to keep.
        router: Of this world and brief.
    """

    sequence: ViaSequence
    index: int
    world: World
    requirements: Requirements
    router: Router

    @property
    def ends(self) -> tuple[Floats, Floats]:
        """The places of the via points before and after [m], shape (d,)."""
        start, goal = self.sequence.ends(self.index)
        return start.at, goal.at

    def shortest_allowed(
        self, active: Flags, closed: Floats = NO_BARRIERS
    ) -> tuple[TautPath | None, Floats]:
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
            taut_path = self.router.find(*self.ends, np.vstack((closed, barriers)), active)
            needed = self.forced_barriers(active)
            if len(needed) == len(barriers):
                return taut_path, barriers
            barriers = needed

    def forced_barriers(self, active: Flags) -> Floats:
        """Barriers on the forbidden sides of those obstacles that allow one side only."""
        rows = [
            barriers_of(self.world, int(i), *self.ends).closing(opposite(forced))
            for i in np.flatnonzero(active)
            if (forced := self.world.obstacles[i].forced_side) is not None
        ]
        return np.vstack(rows) if rows else NO_BARRIERS

    def curve(self, taut_path: TautPath | None) -> Spline | None:
        """The spline along a way, or None where no slack makes it clear."""
        if taut_path is None:
            return None
        fitted = fit(self.sequence, self.index, taut_path, self.world, self.requirements.required)
        if fitted is None:
            return None
        vias = fitted.sequence.legs[self.index].points
        price = measure(fitted.spans, self.world, self.requirements)
        return Spline(taut_path, vias, fitted.spans, price, fitted)


def opposite(side: Side) -> Side:
    """The other side."""
    return "right" if side == "left" else "left"
