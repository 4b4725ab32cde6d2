"""One leg on its way round what it meets: taut paths, curves along them, and what they cost.

Tested through ``planning/problem/test_ledger``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.kernels.arrays import Flags, Floats
from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.alternatives.fit import Fitted, fit
from viaspline.planning.checking.cost import CandidateCost, measure
from viaspline.planning.problem.method import Outcome, Refusal
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.problem.work_budget import ROUTE_S
from viaspline.planning.routing.asked_sides import AskedSides
from viaspline.planning.routing.route_on_sides import route_on_sides
from viaspline.planning.routing.route_problem import NO_BARRIERS
from viaspline.planning.routing.router import Router
from viaspline.planning.routing.taut_path import TautPath
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.world.world import World


@told_in_lines
@dataclass(frozen=True)
class Curve:
    """A curve along a taut path, and what it costs.

    Attributes:
        taut_path: What it follows.
        vias: Its detour via points [m], shape (k, d).
        spans: Bézier control polygons of the whole leg [m], shape (m, 4, d).
        measured: What it costs.
        whole_cost: What the whole path costs with it [s or m]; None where that wasn't laid.
    """

    taut_path: TautPath
    vias: Floats
    spans: Floats
    measured: CandidateCost
    whole_cost: float | None = None


@told_in_lines
@dataclass(frozen=True, kw_only=True)
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
        sides: On which the mission has obstacles passed, as this leg sees them.
    """

    sequence: ViaSequence
    index: int
    world: World
    requirements: Requirements
    router: Router
    sides: AskedSides

    @property
    def ends(self) -> tuple[Floats, Floats]:
        """The places of the via points before and after [m], shape (d,)."""
        start, goal = self.sequence.ends(self.index)
        return start.at, goal.at

    @property
    def stands(self) -> tuple[bool, bool]:
        """Whether the robot stands still at the via points before and after."""
        return self.sequence.stands(self.index), self.sequence.stands(self.index + 1)

    def shortest_allowed(
        self, active: Flags, closed: Floats = NO_BARRIERS
    ) -> tuple[Outcome[TautPath], Floats]:
        """The shortest taut path that passes what it meets on the sides that the mission allows.

        See ``route_on_sides``.

        Args:
            active: (n,): obstacles to begin with; those met are added in place.
            closed: Further segments not to cross, (b, 4).

        Returns:
            What came of it, and the barriers that forbid sides, (f, 4).
        """
        return route_on_sides(self._route, self.sides, active, closed)

    def _route(self, closed: Floats, active: Flags) -> tuple[Outcome[TautPath], Flags]:
        """The shortest taut path past segments, and the obstacles that were met, (n,)."""
        return self.route_between(*self.ends, closed, active)

    def route_between(
        self, start: Floats, goal: Floats, closed: Floats, active: Flags
    ) -> tuple[Outcome[TautPath], Flags]:
        """The shortest taut path from one place to another, and the obstacles that were met, (n,).

        Args:
            start: [m], (d,).
            goal: [m], (d,).
            closed: Segments not to cross, (b, 4).
            active: (n,): obstacles to begin with.
        """

        def found() -> tuple[Outcome[TautPath], Flags]:
            self.requirements.spend(ROUTE_S)
            met = active.copy()
            return self.router.find(start, goal, closed, met, self.requirements.spend), met

        ends = (start.tobytes(), goal.tobytes())
        how = self.router.required, self.router.methods
        asked = ("route", self.world, how, ends, closed.tobytes(), active.tobytes())
        return self.requirements.recalled(asked, found)

    def curve(self, taut_path: TautPath | None, active: Flags) -> Spline | None:
        """The spline along a taut path, or None where no slack makes it clear.

        Args:
            taut_path: The path, if there is one.
            active: (n,): obstacles that were met when it was found: it passes them as asked.
        """
        if taut_path is None:
            return None
        closed = self.sides.binding_if_met(active).closed
        required = self.requirements.required
        fitted = fit(self.sequence, self.index, taut_path, self.world, required, closed)
        if fitted is None:
            return None
        vias = fitted.sequence.legs[self.index].points
        cost = measure(fitted.spans, self.world, self.requirements, self.stands)
        return Spline(taut_path, vias, fitted.spans, cost, fitted=fitted)


def opposite(side: Side) -> Side:
    """The other side."""
    return "right" if side == "left" else "left"


def reason_of(outcome: Outcome[TautPath], side: Side) -> str:
    """Why there may be no curve on a side, from what the search for its taut path came to."""
    if outcome.value is not None:
        return f"no curve was found along the way on the {side}"
    if isinstance(outcome, Refusal):
        return f"no way is wide enough on the {side}"
    return f"no way was found on the {side} before the search was given up"
