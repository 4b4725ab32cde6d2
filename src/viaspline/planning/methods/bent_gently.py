"""What another method lays, bent less where a part of the length buys that."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from viaspline.planning.problem.method import Found, Method, Outcome
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.gentler_path import gentler_path

MOST_RIVALS = 3  # that are bent
NEAR_TIED = 1.005  # what a rival costs, over what the best does: it may be the best when bent
LIKELY_SAVED = 1.0  # more of it than of the best may be saved by bending, of what that saved
LEAST_GAIN = 1e-6  # of what a path costs, for which another is taken


@dataclass(frozen=True)
class BentGently:
    """Lays a path by another method and bends it less, as a strip under tension.

    Attributes:
        method: The other one.
    """

    method: Method[DrivenProblem, SplinePath]

    def lay(self, problem: DrivenProblem, bound: float = math.inf) -> Outcome[SplinePath]:
        """See ``Method``. Rivals that cost little more are bent as well: the best so is taken."""
        outcome = self.method.lay(problem, bound)
        if not isinstance(outcome, Found):
            return outcome
        best, limit, laid_cost = outcome.value, math.inf, outcome.cost
        weighed = problem.price if outcome.rivals else problem.cost
        price = math.inf
        try:
            for rival_cost, laid in ((outcome.cost, outcome.value), *outcome.rivals[:MOST_RIVALS]):
                if rival_cost > limit:
                    break
                bent = gentler_path(problem, laid) or laid
                its_price = weighed(bent)
                if its_price < (1.0 - LEAST_GAIN) * price:
                    best, price = bent, its_price
                saved = laid_cost - price
                limit = max(NEAR_TIED * laid_cost, laid_cost + LIKELY_SAVED * saved)
        except SpentBudgetError:  # there is a path, and no time left to bend it
            pass
        return replace(outcome, value=best, cost=problem.cost(best), rivals=())
