"""The spline that was led round what stands in the way of the disc in the body.

Tested through ``planning/test_plan_path``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.driven_problem import DrivenProblem


@dataclass(frozen=True)
class SplineLedRound:
    """Takes the spline with its detour via points, if the robot can drive it."""

    def lay(self, problem: DrivenProblem, bound: float = math.inf) -> Found[SplinePath] | GaveUp:
        """See ``Method``."""
        spline_path = problem.cleared.spline_path
        if not problem.is_drivable(spline_path.spans):
            return GaveUp(("the spline led round",))
        return Found(spline_path, problem.cost(spline_path))
