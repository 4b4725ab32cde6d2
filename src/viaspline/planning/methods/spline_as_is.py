"""The spline as it is, if the robot can drive it.

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
    """Takes the spline that is clear for the disc in the body."""

    def lay(self, problem: DrivenProblem, bound: float = math.inf) -> Found[SplinePath] | GaveUp:
        """See ``Method``."""
        spline_path = problem.cleared.spline_path
        if problem.requirements.is_free_disc or problem.is_drivable(spline_path.spans):
            return Found(spline_path, spline_path.length)
        return GaveUp(("the spline as it is",))
