"""Methods that are asked with ever sharper turns.

Tested through ``planning/test_plan_path``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from viaspline.planning.problem.method import Found, GaveUp, Method, Outcome, first_settled
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.turn_problem import TurnProblem


@dataclass(frozen=True)
class AtRadii:
    """Asks methods for the widest turns first, as a robot without a turning circle likes them.

    Only a refusal with the sharpest turns is a proof.

    Attributes:
        methods: In the order in which they are asked at each radius.
    """

    methods: Sequence[Method[TurnProblem, SplinePath]]

    def lay(self, problem: DrivenProblem, bound: float = math.inf) -> Outcome[SplinePath]:
        """See ``Method``."""
        tried: list[str] = []
        outcome: Outcome[SplinePath] = GaveUp(())
        for rho in problem.searched_radii:
            outcome = first_settled(self.methods, TurnProblem(problem, rho, problem.spots), bound)
            if isinstance(outcome, Found):
                return outcome
            tried += outcome.tried if isinstance(outcome, GaveUp) else []
        return replace(outcome, tried=tuple(tried)) if isinstance(outcome, GaveUp) else outcome
