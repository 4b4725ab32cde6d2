"""A leg that was led round what stands in its way, and what it was chosen from.

Tested through ``planning/problem/test_ledger``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.alternatives.comparison import Comparison, Met
from viaspline.planning.alternatives.leg_search import LegSearch, Spline, opposite


class InTheWay(Protocol):
    """What stands in the way of a leg: groups where they are few, else islands of cells."""

    @property
    def leg(self) -> LegSearch:
        """The leg."""
        ...

    @property
    def met(self) -> tuple[Met, ...]:
        """What is passed as one, in the order of the leg."""
        ...

    def other_side(self, met: Met, side: Side, best: Spline) -> tuple[Spline | None, str]:
        """The shortest curve on a side of one of them, or why there is none.

        Args:
            met: One of those in the way.
            side: On which it is to be passed.
            best: The curve along the shortest taut path of all, which passes it on the other.
        """
        ...


@dataclass(frozen=True)
class PassedLeg:
    """A leg past what it meets.

    Where little is in the way, the curves on the other sides are weighed at once, and the shortest
    is taken. Where much is, the shortest taut path is taken whatever the other sides cost; they
    are looked at when the ledger is read.

    Attributes:
        in_the_way: What the leg was led round.
        best: The curve along the shortest taut path.
        is_weighed: Whether the curves on the other sides compete with it.
    """

    in_the_way: InTheWay
    best: Spline
    is_weighed: bool

    @cached_property
    def comparison(self) -> Comparison:
        """The curves on either side of all that is in the way."""
        curves, reasons = [self.best], []
        met = self.in_the_way.met
        for one in met:
            side = opposite(one.side_of(self.best.taut_path))
            other, reason = self.in_the_way.other_side(one, side, self.best)
            curves += [] if other is None else [other]
            reasons.append(reason)
        rivals = curves if self.is_weighed else curves[:1]
        objective = self.in_the_way.leg.requirements.objective
        winner = min(rivals, key=lambda curve: curve.measured.of(objective))
        return Comparison(self.in_the_way.leg, met, tuple(curves), winner, tuple(reasons))

    @property
    def taken(self) -> Spline:
        """The curve that the leg takes."""
        if not self.is_weighed:
            return self.best
        winner = self.comparison.winner
        assert isinstance(winner, Spline)  # every curve of an undriven comparison is one
        return winner
