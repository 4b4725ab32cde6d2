"""One leg on its way round what it meets: taut paths, curves along them, and what they cost.

Tested through ``planning/problem/test_ledger``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.alternatives.fit import Fitted, fit
from viaspline.planning.checking.cost import CandidateCost, measure
from viaspline.planning.problem.method import Outcome, Refusal
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.problem.work_budget import ROUTE_S
from viaspline.planning.routing.route_problem import NO_BARRIERS
from viaspline.planning.routing.router import Router
from viaspline.planning.routing.side_barrier import barriers_of
from viaspline.planning.routing.taut_path import TautPath
from viaspline.world.world import World


@dataclass(frozen=True)
class Curve:
    """A curve along a taut path, and what it costs.

    Attributes:
        taut_path: What it follows.
        vias: Its detour via points [m], shape (k, d).
        spans: Bézier control polygons of the whole leg [m], shape (m, 4, d).
        measured: What it costs.
    """

    taut_path: TautPath
    vias: Floats
    spans: Floats
    measured: CandidateCost


@dataclass(frozen=True)
class Spline(Curve):
    """The spline that was fitted to a taut path.

    Attributes:
        fitted: The via sequence with it.
    """

    fitted: Fitted


@dataclass(frozen=True)
class LegSearch:
    """A leg among the others, in its world.

    Attributes:
        sequence: What there is so far.
        index: The leg.
        world: The known world.
        requirements: What to keep.
        router: Of this world and these requirements.
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
    ) -> tuple[Outcome[TautPath], Floats]:
        """The shortest taut path that passes what it meets on the sides that the mission allows.

        It can meet obstacles with a side of their own that were not met before; each such
        round adds at least one barrier, so there are no more rounds than obstacles.

        Args:
            active: (n,): obstacles to begin with; those met are added in place.
            closed: Further segments not to cross, (b, 4).

        Returns:
            What came of it, and the barriers that forbid sides, (f, 4).
        """
        barriers = self.forced_barriers(active)
        while True:
            self.requirements.spend(ROUTE_S)
            outcome = self.router.find(*self.ends, np.vstack((closed, barriers)), active)
            needed = self.forced_barriers(active)
            if len(needed) == len(barriers):
                return outcome, barriers
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
        """The spline along a taut path, or None where no slack makes it clear."""
        if taut_path is None:
            return None
        fitted = fit(self.sequence, self.index, taut_path, self.world, self.requirements.required)
        if fitted is None:
            return None
        vias = fitted.sequence.legs[self.index].points
        cost = measure(fitted.spans, self.world, self.requirements)
        return Spline(taut_path, vias, fitted.spans, cost, fitted)


def opposite(side: Side) -> Side:
    """The other side."""
    return "right" if side == "left" else "left"


def reason_of(outcome: Outcome[TautPath], side: Side) -> str:
    """Why there may be no curve on a side, from what the search for its taut path came to."""
    if outcome.value is not None or isinstance(outcome, Refusal):
        return f"no way is wide enough on the {side}"
    return f"no way was found on the {side} before the search was given up"
