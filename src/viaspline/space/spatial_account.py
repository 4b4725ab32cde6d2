"""What a search in space did: what was weighed, and sides that are looked at when it is read.

Tested through ``space/test_plan_spatial``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Final, NamedTuple

from viaspline.curve.certificate import Certificate
from viaspline.planning.problem.ledger import Candidate, LedgerEntry
from viaspline.space.laying.clear_route import StuckLegError
from viaspline.space.leg_check import LegCheck
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.weighed_ways import LegScale, WaysPast

NOT_WEIGHED: Final = "found for the ledger alone"
"""Why a shorter side of all voxels together isn't taken."""


class LedLeg(NamedTuple):
    """A leg that is led round something: which one, and what is nearest to it if it isn't."""

    leg: int
    proof: Certificate


@dataclass(frozen=True, eq=False)
class UntoldSides:
    """Ways on sides that weren't weighed when the path was laid, and how long those take that were.

    Attributes:
        problem: What was asked.
        router: Finds the ways past things.
        legs: Which legs these are, by their place in the ledger.
    """

    problem: SpatialProblem
    router: WaysPast
    legs: Mapping[int, LedLeg]

    def told(self, entries: tuple[LedgerEntry, ...]) -> tuple[LedgerEntry, ...]:
        """A ledger with what these ways cost."""
        return tuple(
            self._with_others(entry, self.legs[k]) if k in self.legs else entry
            for k, entry in enumerate(entries)
        )

    def _with_others(self, entry: LedgerEntry, led: LedLeg) -> LedgerEntry:
        ways = self.router.others(led.leg, led.proof)
        scale = LegScale(self.problem, LegCheck(self.problem, self.router.gates), led.leg)
        entry = replace(entry, candidates=tuple(map(scale.timed, entry.candidates)))
        try:
            found = scale.weighed(ways) if ways else ()
        except StuckLegError:  # none of them can be laid
            found = ()
        taken = entry.chosen
        least = taken.length if taken is not None else None
        others = (_passed_over(one.candidate, least) for one in found)
        return replace(entry, candidates=(*entry.candidates, *others))


def _passed_over(candidate: Candidate, least: float | None) -> Candidate:
    """One of a leg, the way of which that was taken is so long [m]."""
    if candidate.length is None or least is None or candidate.length >= least:
        return candidate
    return replace(candidate, passed_over=NOT_WEIGHED)


@dataclass(frozen=True)
class SpatialAccount:
    """What a search did, leg by leg.

    Attributes:
        weighed: What stood in the way of each leg, and the ways past it that were weighed.
        others: The ways on other sides; None where all were weighed.
    """

    weighed: tuple[LedgerEntry, ...]
    others: UntoldSides | None = field(default=None, repr=False)

    @cached_property
    def ledger(self) -> tuple[LedgerEntry, ...]:
        """All entries; the ways on other sides are looked for when they are read first."""
        return self.weighed if self.others is None else self.others.told(self.weighed)
