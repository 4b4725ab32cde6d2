"""The curves past what a leg meets, side by side.

Tested through ``planning/problem/test_ledger``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.alternatives.leg_search import Curve, LegSearch
from viaspline.planning.problem.ledger import Candidate, LedgerEntry
from viaspline.planning.routing.side_barrier import Barriers
from viaspline.planning.routing.taut_path import TautPath
from viaspline.presentable.told_in_lines import told_in_lines

SIDES: tuple[Side, Side] = ("left", "right")
NOT_WEIGHED = "where much stands around, the shortest way is taken if it loses little to its bends"


@dataclass(frozen=True)
class Met:
    """What stands in the way of a leg and is passed as one: a group, or an island.

    Attributes:
        members: The names of its obstacles.
        barriers: What closes either side of it.
        asked: The side on which the mission has it passed, and the member that it says so of;
            None where either will do. Every curve of the leg keeps it.
    """

    members: tuple[str, ...]
    barriers: Barriers
    asked: tuple[Side, str] | None

    @property
    def forced(self) -> Side | None:
        """The only side on which it may be passed, if there is one."""
        return None if self.asked is None else self.asked[0]

    def forbidden(self, side: Side) -> str | None:
        """Why it may not be passed on a side, if it may not."""
        if self.asked is None or self.asked[0] == side:
            return None
        forced, name = self.asked
        return f"the mission has {name!r} passed on the {forced}"

    def side_of(self, taut_path: TautPath) -> Side:
        """The side on which a taut path passes it."""
        if self.asked is not None:
            return self.asked[0]
        return "right" if taut_path.crosses(self.barriers.right) else "left"


@told_in_lines
@dataclass(frozen=True)
class Comparison:
    """A leg, what it met and the curves past that.

    Attributes:
        leg: The leg.
        met: What stands in its way.
        curves: One along the shortest taut path, and those on the other side of what was met.
        winner: The one that is taken, of these.
        reasons: For each that was met, why there might be no curve on one of its sides.
    """

    leg: LegSearch
    met: tuple[Met, ...]
    curves: tuple[Curve, ...]
    winner: Curve
    reasons: tuple[str, ...]

    @property
    def entries(self) -> tuple[LedgerEntry, ...]:
        """For each that was met the shortest curve on either side."""
        start, goal = self.leg.sequence.ends(self.leg.index)
        return tuple(
            LedgerEntry(
                one.members,
                (start.name, goal.name),
                tuple(self._candidate(one, side, one.forbidden(side) or reason) for side in SIDES),
                one.forced,
            )
            for one, reason in zip(self.met, self.reasons, strict=True)
        )

    def taking(self, curve: Curve) -> Comparison:
        """This comparison with another curve in the place of the winner."""
        curves = tuple(curve if one is self.winner else one for one in self.curves)
        return replace(self, curves=curves, winner=curve)

    def _candidate(self, met: Met, side: Side, reason: str) -> Candidate:
        passing = [curve for curve in self.curves if met.side_of(curve.taut_path) == side]
        if not passing:
            dimension = len(self.leg.ends[0])
            none = np.empty((0, dimension))
            return Candidate(side, none, none.reshape(0, 4, dimension), impossible=reason)
        chosen = any(curve is self.winner for curve in passing)
        objective = self.leg.requirements.objective
        best = min(passing, key=lambda curve: curve.measured.of(objective))
        curve = self.winner if chosen else best
        is_cheaper = curve.measured.of(objective) < self.winner.measured.of(objective)
        return Candidate(
            side=side,
            vias=curve.vias,
            spans=curve.spans,
            length=curve.measured.length,
            duration=curve.measured.duration,
            clearance=curve.measured.clearance,
            max_curvature=curve.measured.max_curvature,
            chosen=chosen,
            passed_over=self._why_passed_over(curve) if is_cheaper else None,
        )

    def _why_passed_over(self, curve: Curve) -> str:
        """Why a curve isn't taken that costs less than the one that is."""
        whole, taken = curve.whole_cost, self.winner.whole_cost
        if self._is_round(self.winner) and not self._is_round(curve):
            return "it turns more sharply than the robot itself"
        if whole is None or taken is None or whole < taken:
            return f"found for the ledger alone: {NOT_WEIGHED}"
        what = "sooner" if self.leg.requirements.objective.is_time else "shorter"
        return f"the whole path is no {what} with it"

    def _is_round(self, curve: Curve) -> bool:
        """Whether a curve turns no more sharply than the robot itself."""
        return curve.measured.max_curvature * self.leg.requirements.outer_radius <= 1.0
