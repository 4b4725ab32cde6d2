"""Turns along the next shortest taut paths, where a turning circle can't follow the shortest.

Where a turn path gets stuck, the gap that its taut path goes through there is closed, and the
shortest that is left is tried: always the shortest of all that are known.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.planning.alternatives.homotopy_classes import (
    Attempt,
    TautRow,
    cheapest_laid,
)
from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.bend_row import bends_along
from viaspline.planning.turning.laid_turns import through_turns
from viaspline.planning.turning.repair import clear_turn_path_or_why
from viaspline.planning.turning.turn_path import TurnPath
from viaspline.planning.turning.turn_problem import TurnProblem


@dataclass(frozen=True)
class NextHomotopyClasses:
    """Lays turns along rows of taut paths that pass something on another side.

    Attributes:
        max_rows: Rows that are tried.
        settled_within: Of the shortest row's length: what is longer is compared with what other
            methods find.
    """

    max_rows: int = 12
    settled_within: float = 1.01

    def lay(self, problem: TurnProblem, bound: float = math.inf) -> Found[SplinePath] | GaveUp:
        """See ``Method``."""
        path = problem.path

        def attempt(row: TautRow, bound: float) -> Attempt[TurnPath]:
            bends = bends_along(path.sequence, row.taut_paths).turning(problem.rho)
            made = clear_turn_path_or_why(bends, path.world, path.requirements)
            if isinstance(made, TurnPath):
                places = path.passed_wrong(made)
                if not places:
                    return Attempt(made)
            else:
                places = made.places(path.requirements)
            others = (row.past_gap(path.legs[leg], by) for leg, by in places)
            return Attempt(None, (other for other in others if other is not None))

        first = path.shortest_row
        found = cheapest_laid([first], attempt, _Length(), max_rows=self.max_rows)
        if found is None:
            return GaveUp((f"turns on up to {self.max_rows} longer ways",))
        is_settled = found.length <= self.settled_within * first.length
        spline_path = through_turns(path.sequence, [found])
        return Found(spline_path, path.cost(spline_path), is_settled)


class _Length:
    """Little of length: see ``Price``."""

    def of(self, laid: TurnPath, /) -> float:
        return laid.length

    def least(self, row: TautRow, /) -> float:
        return row.length
