"""What paths along rows of taut paths cost, and what they cost at least.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.planning.alternatives.homotopy_classes import TautRow
from viaspline.planning.checking.driving_time import straight_time
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.driven_problem import DrivenProblem


@dataclass(frozen=True)
class DrivenPrice:
    """What paths along rows of taut paths are chosen by.

    Attributes:
        problem: What is to be driven.
    """

    problem: DrivenProblem

    def of(self, laid: SplinePath, /) -> float:
        """See ``Price``."""
        return self.problem.price(laid)

    def least(self, row: TautRow, /) -> float:
        """See ``Price``: straight lines of the same lengths from halt to halt."""
        objective, sequence = self.problem.requirements.objective, self.problem.sequence
        if not objective.is_time:
            return row.length
        total, run = 0.0, 0.0
        for k, taut_path in enumerate(row.taut_paths):
            run += taut_path.length
            if sequence.stands(k + 1):
                total += straight_time(run, objective.pace)
                run = 0.0
        return total + run / objective.pace.speed
