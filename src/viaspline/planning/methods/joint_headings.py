"""Turns with the headings at all via points chosen together.

Tested through ``planning/test_plan_path``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.driven_problem import TurnProblem
from viaspline.planning.turning.headings import HEADING_COUNT, costs_between, legs_of, posed
from viaspline.planning.turning.laid_turns import through_turns
from viaspline.planning.turning.repair import clear_turn_path, turn_path_if_clear


@dataclass(frozen=True)
class JointHeadings:
    """Lays turns between the best row of headings: legs as they are, else pushed clear.

    Attributes:
        max_rows: Rows of headings that are tried with legs as they are.
        max_pushed_rows: The same with legs that are pushed clear.
        max_pushed_pairs: Pairs of headings of a leg for which it is pushed, until one of them can
            be cleared.
        headings: That are tried at each via point, evenly round it.
    """

    max_rows: int = 300
    max_pushed_rows: int = 40
    max_pushed_pairs: int = 16
    headings: int = HEADING_COUNT

    def lay(self, problem: TurnProblem, bound: float = math.inf) -> Found[SplinePath] | GaveUp:
        """See ``Method``."""
        path = problem.path
        bound = path.requirements.objective.metres(bound)
        bends = path.bends.turning(problem.rho)
        legs = legs_of(bends, problem.spots, self.headings, path.walls)
        closed = path.bends.closed
        costs = costs_between(legs, path.requirements)
        as_it_is, pushed = (
            partial(path.leg_on_sides, lay=lay) for lay in (turn_path_if_clear, clear_turn_path)
        )
        poses = posed(legs, costs, closed, as_it_is, self.max_rows, self.max_rows, bound)
        if poses is None:
            rows, pairs = self.max_pushed_rows, self.max_pushed_pairs
            poses = posed(legs, costs, closed, pushed, rows, pairs, bound)
        if poses is None:
            return GaveUp((f"{self.max_rows} rows of headings at the via points",))
        spline_path = through_turns(path.sequence, poses.turn_paths)
        return Found(spline_path, path.cost(spline_path))
