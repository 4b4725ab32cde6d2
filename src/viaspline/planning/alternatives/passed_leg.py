"""A leg that was led round what stands in its way, and what it was chosen from.

Tested through ``planning/problem/test_ledger``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

from viaspline.kernels.arrays import Flags
from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.alternatives.comparison import Comparison, Met
from viaspline.planning.alternatives.leg_search import LegSearch, Spline, opposite, reason_of
from viaspline.planning.problem.method import Outcome
from viaspline.planning.routing.taut_path import TautPath
from viaspline.presentable.told_in_lines import told_in_lines


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

    @property
    def active(self) -> Flags:
        """(n,): the obstacles that the leg's shortest taut path was found with."""
        ...

    @property
    def is_little(self) -> bool:
        """Whether it is so little that the ways on the other sides are always sought."""
        ...

    @property
    def among_made(self) -> InTheWay:
        """This one, whose other ways are sought on no finer lattices than the leg's own was."""
        ...

    def other_way(self, met: Met, side: Side, best: TautPath) -> Outcome[TautPath]:
        """The shortest taut path on a side of one of them, if the mission allows it.

        Args:
            met: One of those in the way.
            side: On which it is to be passed.
            best: The shortest taut path of all, which passes it on the other.
        """
        ...


@dataclass(frozen=True)
class OtherWay:
    """The other side of what is in the way.

    Attributes:
        taut_path: The shortest there; None where there is none.
        reason: Why there might be no curve.
    """

    taut_path: TautPath | None
    reason: str


@told_in_lines
@dataclass(frozen=True)
class PassedLeg:
    """A leg past what it meets.

    Where little is in the way, the curves on the other sides are weighed at once if it is a spline
    that is driven, and the best is taken. Where much is, the shortest taut path is taken whatever
    the other sides cost; they are looked at when the ledger is read, or where what was laid along
    it loses much to its bends.

    Attributes:
        in_the_way: What the leg was led round.
        best: The curve along the shortest taut path.
        is_weighed: Whether the curves on the other sides compete with it.
    """

    in_the_way: InTheWay
    best: Spline
    is_weighed: bool

    @cached_property
    def other_ways(self) -> tuple[OtherWay, ...]:
        """The other side of each that is in the way."""
        where = self.in_the_way
        if self.is_weighed or where.among_made is where:
            return tuple(self._other_way(where, met) for met in where.met)
        return tuple(
            self._other_way(where, met) if near.taut_path is None else near
            for near, met in zip(self._near_ways, where.met, strict=True)
        )

    @cached_property
    def _near_ways(self) -> tuple[OtherWay, ...]:
        """The other sides, where that takes no finer lattices than those that are made."""
        where = self.in_the_way.among_made
        return tuple(self._other_way(where, met) for met in self.in_the_way.met)

    def _other_way(self, where: InTheWay, met: Met) -> OtherWay:
        side = opposite(met.side_of(self.best.taut_path))
        forbidden = met.forbidden(side)
        if forbidden is not None:
            return OtherWay(None, forbidden)
        outcome = where.other_way(met, side, self.best.taut_path)
        return OtherWay(outcome.value, reason_of(outcome, side))

    @cached_property
    def comparison(self) -> Comparison:
        """The curves on either side of all that is in the way."""
        leg, active = self.in_the_way.leg, self.in_the_way.active
        others = (leg.curve(way.taut_path, active) for way in self.other_ways)
        curves = [self.best, *(other for other in others if other is not None)]
        rivals = curves if self.is_weighed else curves[:1]
        winner = min(rivals, key=lambda curve: curve.measured.of(leg.requirements.objective))
        reasons = tuple(way.reason for way in self.other_ways)
        return Comparison(leg, self.in_the_way.met, tuple(curves), winner, reasons)

    @property
    def rivals(self) -> tuple[TautPath, ...]:
        """Taut paths on other sides of what is in the way; those along which splines fit, if known.

        Only the paths are sought where other curves than splines are laid along them, and among
        much else: splines take their time there, and so do lattices that are finer than the leg's
        own way took.
        """
        if self.is_weighed:
            curves = self.comparison.curves
            return tuple(curve.taut_path for curve in curves if curve is not self.best)
        ways = self.other_ways if self.in_the_way.is_little else self._near_ways
        return tuple(way.taut_path for way in ways if way.taut_path is not None)

    @property
    def taken(self) -> Spline:
        """The curve that the leg takes."""
        if not self.is_weighed:
            return self.best
        winner = self.comparison.winner
        assert isinstance(winner, Spline)  # every curve of an undriven comparison is one
        return winner
