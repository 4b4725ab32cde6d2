"""What another method lays, or turns that are round enough for the robot's own body.

A turn at a via point whose heading halves what it turns by may have room only where it is sharper
than the robot itself; with another heading there it may have room to be round.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from viaspline.planning.problem.method import Found, Method, Outcome
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.turning.bend_row import RowBends, bends_of_legs
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.turn_problem import TurnProblem


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
        """See ``Method``. The round path is taken if it takes little longer."""
        outcome = self.method.lay(problem, bound)
        if not isinstance(outcome, Found):
            return outcome
        choices = problem.kept_lanes.bends_along(problem.shortest_row.taut_paths)
        rounder = rounder_path(problem, outcome.value, choices, self.rounder)
        if rounder is None:
            return outcome
        return Found(rounder, problem.cost(rounder), rivals=((outcome.cost, outcome.value),))


def rounder_path(
    problem: DrivenProblem,
    laid: SplinePath,
    choices: Iterable[RowBends],
    rounder: Method[TurnProblem, SplinePath],
    bound: float = math.inf,
) -> SplinePath | None:
    """A path that is round, where one that is laid is sharper and takes hardly less long.

    Only where there is none does the robot turn on the spot. Where it is the length that counts
    all is left as it is.

    Args:
        problem: What is to be driven.
        laid: The path.
        choices: The bends of all legs along which it may lead: the first are tried, and the last.
        rounder: Lays turns of at least a radius.
        bound: Only what costs less is of use [s].
    """
    by_time = problem.requirements.objective.is_time
    if not by_time or problem.own_radius <= problem.sharpest or problem.is_round(laid):
        return None
    most = min(bound, problem.price(laid))
    try:
        for legs in _first_and_last(choices):
            row = bends_of_legs(problem.sequence, legs)
            for spots in ((), problem.spots) if problem.spots else ((),):
                asked = TurnProblem(problem, problem.own_radius, spots, row)
                found = rounder.lay(asked, most)
                if isinstance(found, Found) and found.cost < most and problem.is_round(found.value):
                    return found.value
    except SpentBudgetError:  # there is a path, and no time left to look for a rounder one
        pass
    return None


def _first_and_last(choices: Iterable[RowBends]) -> Iterator[RowBends]:
    """Of some choices the first, then the last if that is another one."""
    last: RowBends | None = None
    for k, choice in enumerate(choices):
        if k == 0:
            yield choice
        else:
            last = choice
    if last is not None:
        yield last
