"""The account of a search: every group that was met, drawn up when it is asked for.

Tested through ``planning/problem/test_ledger_as_laid``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.alternatives.comparison import Comparison
from viaspline.planning.alternatives.kept_account import KeptAccount
from viaspline.planning.alternatives.leg_search import Curve
from viaspline.planning.alternatives.passed_leg import PassedLeg
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.checking.cost import measure, measure_body
from viaspline.planning.problem.ledger import Candidate, LedgerEntry
from viaspline.planning.problem.preferred_clearance import PreferredClearance
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.world.world import World


@told_in_lines
@dataclass(frozen=True)
class ThroughZones:
    """A path through speed zones that another one leaves out.

    Attributes:
        names: What the zones are called where they stand as obstacles.
        spline_path: The path.
    """

    names: frozenset[str]
    spline_path: SplinePath


@told_in_lines
@dataclass(frozen=True)
class Account:
    """What a search did, leg by leg.

    Among many groups the taut path that was taken is known to be the shortest before the other
    sides of the groups have been looked at; they are looked at when the ledger is read.

    Attributes:
        spline_path: What was laid in the end.
        world: The known world.
        requirements: What the path keeps.
        passed: The legs that were led round something.
        driven: Turns a comparison of splines into one of the curves that a robot with a body or a
            turning circle drives, beside what was laid; None for others.
        measured_in: The world as it is, where the path was laid among grown obstacles.
        preferred: What more clearance was weighed; None where none is asked for.
        through: What was laid through zones that the path leaves out; None where it leaves none.
    """

    spline_path: SplinePath
    world: World
    requirements: Requirements
    passed: Mapping[int, PassedLeg] = field(default_factory=dict)
    driven: Callable[[Comparison, SplinePath], Comparison] | None = None
    measured_in: World | None = None
    preferred: PreferredClearance | None = None
    through: ThroughZones | None = None

    @property
    def kept(self) -> Account | KeptAccount:
        """What a plan keeps of it: where nothing was met, not what the search went through."""
        return self if self.passed else KeptAccount((), self.preferred)

    def without_lattices(self) -> None:
        """Let go of the lattices of the search: they are made again when the ledger is read."""
        for passed in self.passed.values():
            passed.in_the_way.leg.router.without_lattices()

    @cached_property
    def ledger(self) -> tuple[LedgerEntry, ...]:
        """All entries, with the chosen curves as they lie in the end.

        A leg that was led round after its neighbour has turned the tangents at the via point
        between them; what was not chosen stays as it was weighed.
        """
        budget = self.requirements.budget
        if budget is None:
            return self._entries
        with budget.afterwards():
            return self._entries

    @property
    def _entries(self) -> tuple[LedgerEntry, ...]:
        return tuple(
            self._with_through(self._as_it_is(entry), comparison)
            for comparison in (self._as_laid(leg) for leg in sorted(self.passed))
            for entry in comparison.entries
        )

    def _as_it_is(self, entry: LedgerEntry) -> LedgerEntry:
        """An entry with what its candidates keep in the world as it is."""
        world = self.measured_in
        if world is None:
            return entry
        return replace(
            entry, candidates=tuple(self._measured(one, world) for one in entry.candidates)
        )

    def _with_through(self, entry: LedgerEntry, comparison: Comparison) -> LedgerEntry:
        """An entry with the way through the zones in it that are left out, if there are any."""
        taken, through = entry.chosen, self.through
        if through is None or taken is None or through.names.isdisjoint(entry.members):
            return entry
        leg, laid = comparison.leg, through.spline_path
        spans, world = laid.leg(leg.index), self.measured_in
        cost = measure_body(
            spans, self.world if world is None else world, self.requirements, leg.stands
        )
        is_sooner = taken.duration is not None and cost.duration < taken.duration
        candidate = Candidate(
            "through", laid.detours(leg.index), spans, cost.length, cost.duration, cost.clearance,
            cost.max_curvature,
            passed_over="the whole path is no sooner with it" if is_sooner else None,
        )  # fmt: skip
        return replace(entry, candidates=(*entry.candidates, candidate))

    def _measured(self, candidate: Candidate, world: World) -> Candidate:
        """A candidate with its clearance in the world as it is."""
        if candidate.impossible is not None:
            return candidate
        clearance = proven(PiecewiseCubic(candidate.spans), world, self.requirements).clearance
        return replace(candidate, clearance=clearance)

    def _as_laid(self, leg: int) -> Comparison:
        comparison = self.passed[leg].comparison
        if self.driven is not None:
            return self.driven(comparison, self.spline_path)
        winner, spans = comparison.winner, self.spline_path.leg(leg)
        if np.array_equal(winner.spans, spans):
            return comparison
        cost = measure(spans, self.world, self.requirements, comparison.leg.stands)
        return comparison.taking(
            Curve(winner.taut_path, self.spline_path.detours(leg), spans, cost)
        )
