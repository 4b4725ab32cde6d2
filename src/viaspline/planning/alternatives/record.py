"""The account of a search: every group that was met, drawn up when it is asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from viaspline.planning.alternatives.comparison import Comparison
from viaspline.planning.alternatives.lead_round import Passed
from viaspline.planning.alternatives.leg_search import Curve
from viaspline.planning.checking.cost import measure
from viaspline.planning.problem.ledger import LedgerEntry
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.driven_alternatives import DrivenSides
from viaspline.world.world import World


@dataclass(frozen=True)
class Account:
    """What a search did, leg by leg.

    Among many groups the way that was taken is known to be the shortest before the other sides
    of the groups have been looked at; they are looked at when the ledger is read.

    Attributes:
        spline_path: The course as it was laid in the end.
        world: The known world.
        requirements: What the path keeps.
        passed: The legs that were led round something.
        driven: The other sides as a robot with a body or a turning circle drives them; None for
            others.
    """

    spline_path: SplinePath
    world: World
    requirements: Requirements
    passed: Mapping[int, Passed] = field(default_factory=dict)
    driven: DrivenSides | None = None

    @cached_property
    def ledger(self) -> tuple[LedgerEntry, ...]:
        """All entries, with the chosen curves as they lie in the end.

        A leg that was led round after its neighbour has turned the tangents at the via point
        between them; what was not chosen stays as it was weighed.
        """
        comparison = (self._weighed(leg) for leg in sorted(self.passed))
        return tuple(entry for leg in comparison for entry in leg.entries)

    def _weighed(self, leg: int) -> Comparison:
        comparison = self.passed[leg].comparison
        if self.driven is not None:
            return self.driven.comparison(comparison, self.spline_path)
        winner, spans = comparison.winner, self.spline_path.leg(leg)
        if np.array_equal(winner.spans, spans):
            return comparison
        price = measure(spans, self.world, self.requirements)
        return comparison.taking(
            Curve(winner.taut_path, self.spline_path.detours(leg), spans, price)
        )
