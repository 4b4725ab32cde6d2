"""What another method lays, or turns that are round enough for the robot's own body.

A turn at a via point whose heading halves what it turns by may have room only where it is sharper
than the robot itself; with another heading there it may have room to be round.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.planning.problem.method import Found, Method, Outcome
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.turn_problem import TurnProblem

MOST_LONGER = 1.1  # what round turns may cost, over what sharper ones do


@dataclass(frozen=True)
class RounderTurns:
    """Lays a path by another method; where that is too sharp, looks for a round one.

    Attributes:
        method: The other one.
        rounder: Lays turns of at least a radius.
    """

    method: Method[DrivenProblem, SplinePath]
    rounder: Method[TurnProblem, SplinePath]

    def lay(self, problem: DrivenProblem, bound: float = math.inf) -> Outcome[SplinePath]:
        """See ``Method``. The round path is taken if it takes little longer.

        Only where there is none does the robot turn on the spot. Lanes are left as they are, and
        where it is the length that counts so is all.
        """
        outcome = self.method.lay(problem, bound)
        by_time = problem.requirements.objective.is_time
        if not isinstance(outcome, Found) or not by_time or problem.kept_lanes.are_any:
            return outcome
        if problem.own_radius <= problem.sharpest or problem.is_round(outcome.value):
            return outcome
        most = MOST_LONGER * outcome.cost
        try:
            for spots in ((), problem.spots) if problem.spots else ((),):
                found = self.rounder.lay(TurnProblem(problem, problem.own_radius, spots), most)
                if isinstance(found, Found) and found.cost < most and problem.is_round(found.value):
                    return found
        except SpentBudgetError:  # there is a path, and no time left to look for a rounder one
            pass
        return outcome
