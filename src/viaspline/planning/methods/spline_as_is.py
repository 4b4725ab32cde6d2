"""The spline through the via points as it is, where nothing stands in its way.

Tested through ``planning/test_plan_path``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.driven_problem import DrivenProblem


@dataclass(frozen=True)
class SplineAsItIs:
    """Takes the spline, if it was not led round anything and the robot can drive it.

    Where the mission doesn't say how taut it is to be, turns may be faster, or shorter. A bend that
    is sharper than the robot itself never is, whatever a time law for points says: it is what
    remains where nothing else is found. So it is where lanes are to be kept: it swings out between
    via points, or goes straight to the next one from beside a lane.
    """

    def lay(self, problem: DrivenProblem, bound: float = math.inf) -> Found[SplinePath] | GaveUp:
        """See ``Method``."""
        spline_path, needs = problem.cleared.spline_path, problem.requirements
        if problem.cleared.passed or not problem.is_drivable(spline_path.spans):
            return GaveUp(("the spline as it is",))
        if needs.detours == "local":
            return Found(spline_path, math.inf, is_settled=False)
        if needs.has_own_tension:
            return Found(spline_path, problem.cost(spline_path))
        is_last = problem.kept_lanes.are_any or not problem.is_round(spline_path)
        cost = math.inf if is_last else problem.cost(spline_path)
        return Found(spline_path, cost, is_settled=False)
