"""Straight lines and turns with ramps along the shortest taut paths.

Tested through ``planning/test_plan_path``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.repair import MAX_PUSH_ROUNDS


@dataclass(frozen=True)
class TurnsOnShortest:
    """Lays turns along the shortest taut paths, pushed away from what they come too close to."""

    def lay(self, problem: DrivenProblem, bound: float = math.inf) -> Found[SplinePath] | GaveUp:
        """See ``Method``."""
        spline_path = problem.turns_along(problem.shortest_row.taut_paths)
        if spline_path is None:
            return GaveUp((f"turns on the shortest way, pushed away {MAX_PUSH_ROUNDS} times",))
        return Found(spline_path, problem.cost(spline_path))
