"""Better paths on the other sides of what the legs meet.

Tested through ``planning/test_plan_path`` and ``planning/turning/test_driven_alternatives``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from viaspline.kernels.routing.tangent_arcs import BEND_RADIUS, HEADING_IN, SIDE, TURN
from viaspline.planning.alternatives.homotopy_classes import Attempt, TautRow, cheapest_laid
from viaspline.planning.methods.rounder_turns import rounder_path
from viaspline.planning.problem.method import Found, Method, Outcome, first_settled
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.likely_price import LikelyPrice
from viaspline.planning.turning.turn_problem import TurnProblem

MAX_SOUGHT_BENDS = 60
"""Legs among much else are led to other sides in rows of no more bends: to lay one takes longer
than what is gained by one of so many turns."""

MOST_GAPS, LEAST_TURN_RAD = 4, 0.3
"""A leg among much else is led past the gaps in which it turns most, and by so much at least."""

NEARLY_AS_SOON = 1.02
"""Of what is laid, that turns of a row promise at most: bent it may be the sooner one."""

MOST_STUCK = 3
"""Rows for which no rounder turns are found, after which none are sought any more."""

MAX_LAID = 60_000
"""Rows that are laid to find a better one, times the square of their bends: what that costs."""


@dataclass(frozen=True)
class OtherSides:
    """What other methods find, or a better path on other sides of the groups in its way.

    A side that is shorter for a point can take longer for a robot that has to swing out for it.

    Attributes:
        methods: The others, in the order in which they are asked.
        rounder: Lays turns of at least a radius on other sides, where others are sharper.
    """

    methods: Sequence[Method[DrivenProblem, SplinePath]]
    rounder: Method[TurnProblem, SplinePath]

    def lay(self, problem: DrivenProblem, bound: float = math.inf) -> Outcome[SplinePath]:
        """See ``Method``."""
        outcome = first_settled(self.methods, problem, bound)
        if not isinstance(outcome, Found):
            return outcome
        if not problem.cleared.passed:  # nothing was in the way: there are no other sides
            return replace(outcome, cost=problem.cost(outcome.value))

        stuck = [] if problem.is_round(outcome.value) else [problem.shortest_row]
        known = [outcome.value, *(rival for _, rival in outcome.rivals)]

        def attempt(row: TautRow, bound: float) -> Attempt[SplinePath]:
            choices = problem.kept_lanes.bends_along(row.taut_paths)
            first = next(choices)
            if not problem.is_promising(first, NEARLY_AS_SOON * bound):
                return Attempt(None)
            laid = problem.turns_along(row.taut_paths, chain((first,), choices))
            if laid is None:
                return Attempt(None)
            known.append(laid)
            if len(stuck) < MOST_STUCK and not problem.is_round(laid):
                rounder = rounder_path(problem, laid, (first,), self.rounder, bound)
                if rounder is None:
                    stuck.append(row)
                else:
                    known.append(rounder)
                    laid = rounder
            return Attempt(laid, _other_rows(problem, row, laid))

        try:
            rows = list(_other_rows(problem, problem.shortest_row, outcome.value))
        except SpentBudgetError:  # there is a path, and no time left to look for another
            return outcome
        most = max(MAX_LAID // max(len(problem.bends.rows), 1) ** 2, 1)
        best = cheapest_laid(
            rows, attempt, LikelyPrice(problem, outcome.value), outcome.value, most
        )
        assert best is not None  # there was one to begin with
        rivals = {id(one): (problem.cost(one), one) for one in known if one is not best}
        in_order = sorted(rivals.values(), key=lambda rival: rival[0])
        return Found(best, problem.cost(best), rivals=tuple(in_order))


def _other_rows(problem: DrivenProblem, row: TautRow, laid: SplinePath) -> Iterator[TautRow]:
    """The rows that pass something on another side, of those legs that don't yet.

    Args:
        problem: What is to be driven.
        row: The row.
        laid: What was laid along it.
    """
    is_short = len(problem.bends.rows) <= MAX_SOUGHT_BENDS
    for leg, passed in problem.cleared.passed.items():
        is_shortest = row.taut_paths[leg] is problem.shortest_row.taut_paths[leg]
        is_little = passed.in_the_way.is_little
        if is_shortest and (is_little or (is_short and problem.loses_much(laid, leg))):
            for taut_path in passed.rivals:
                yield row.with_leg(leg, taut_path)
            if not is_little and problem.requirements.budget is None:  # else there is no time
                yield from _past_sharpest(problem, row, leg)


def _past_sharpest(problem: DrivenProblem, row: TautRow, leg: int) -> Iterator[TautRow]:
    """The rows without the gaps in which a leg turns most.

    A way round an island may differ from the shortest by one gap beside it alone.
    """
    search = problem.legs[leg]
    near = replace(search, router=search.router.among_made)
    bends = row.taut_paths[leg].bends[1:-1]
    turns = np.abs(bends[:, TURN])
    for k in np.argsort(-turns)[:MOST_GAPS].tolist():
        if turns[k] < LEAST_TURN_RAD:
            break
        way = bends[k, HEADING_IN] + 0.5 * bends[k, TURN]
        out = bends[k, SIDE] * np.array([math.sin(way), -math.cos(way)])
        by = bends[k, :2] + (bends[k, BEND_RADIUS] - problem.requirements.required) * out
        other = row.past_gap(near, by)
        if other is not None:
            yield other
