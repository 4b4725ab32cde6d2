"""What another method lays, bent less where a part of the length buys that."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from viaspline.planning.problem.method import Found, Method, Outcome
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.gentler_path import gentler_path

MOST_RIVALS = 3  # that are bent
NEAR_TIED = 1.05  # what a rival costs, over what the best does: it may be the best when bent
NEAR_TIED_IN_ZONES = 1.1  # where a little aside may be much slower
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
        price, zones = math.inf, problem.requirements.objective.pace.zones
        near_tied = NEAR_TIED_IN_ZONES if zones else NEAR_TIED
        try:
            for rival_cost, laid in ((outcome.cost, outcome.value), *outcome.rivals[:MOST_RIVALS]):
                if rival_cost > limit:
                    break
                for bent in _bent(problem, laid):
                    its_price = weighed(bent)
                    if its_price < (1.0 - LEAST_GAIN) * price:
                        best, price = bent, its_price
                saved = laid_cost - price
                limit = max(near_tied * laid_cost, laid_cost + LIKELY_SAVED * saved)
        except SpentBudgetError:  # there is a path, and no time left to bend it
            pass
        return replace(outcome, value=best, cost=problem.cost(best), rivals=())


def _bent(problem: DrivenProblem, laid: SplinePath) -> Iterator[SplinePath]:
    """A path bent less. Its time jumps where it meets zones: the way as if there were none, too."""
    yield gentler_path(problem, laid) or laid
    needs = problem.requirements
    if needs.objective.pace.zones:
        objective = replace(needs.objective, pace=needs.objective.pace.beside_zones)
        beside = replace(problem, requirements=replace(needs, objective=objective))
        bent = gentler_path(beside, laid)
        if bent is not None:
            yield bent
