"""What another method lays, bent less where a part of the length buys that."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from viaspline.planning.problem.method import Found, Method, Outcome
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.gentler_path import gentler_path


@dataclass(frozen=True)
class BentGently:
    """Lays a path by another method and bends it less, as a strip under tension.

    Attributes:
        method: The other one.
    """

    method: Method[DrivenProblem, SplinePath]

    def lay(self, problem: DrivenProblem, bound: float = math.inf) -> Outcome[SplinePath]:
        """See ``Method``. It costs what was laid: what is gentler is not weighed with others."""
        outcome = self.method.lay(problem, bound)
        if not isinstance(outcome, Found):
            return outcome
        try:
            gentle = gentler_path(problem, outcome.value)
        except SpentBudgetError:  # there is a path, and no time left to bend it
            return outcome
        return outcome if gentle is None else replace(outcome, value=gentle)
