"""Turns with the headings at all via points chosen together.

Tested through ``planning/test_plan_path``.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.turning.heading_costs import cheapest
from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.turning.clear_ends import with_clear_ends
from viaspline.planning.turning.headings import (
    HEADING_COUNT,
    HeadingLeg,
    costs_between,
    with_room,
)
from viaspline.planning.turning.posed_legs import Poses, posed
from viaspline.planning.turning.repair import clear_turn_path, turn_path_if_clear
from viaspline.planning.turning.turn_problem import TurnProblem

MUCH_LONGER = 1.05  # than the shortest row, where that isn't clear: pushed it may be shorter


@dataclass(frozen=True)
class JointHeadings:
    """Lays turns between the best row of headings: legs as they are, or pushed clear.

    Pushed are they where none is clear as it is, or only such as are much longer.

    Attributes:
        max_rows: Rows of headings that are tried with legs as they are.
        max_pushed_rows: The same with legs that are pushed clear.
        max_pushed_pairs: Pairs of headings of a leg for which it is pushed, until one of them can
            be cleared.
        headings: That are tried at each via point, evenly round it.
        settled_within: Of the shortest row's length, clear or not: what is longer is compared with
            what other methods find.
    """

    max_rows: int = 300
    max_pushed_rows: int = 40
    max_pushed_pairs: int = 16
    headings: int = HEADING_COUNT
    settled_within: float = math.inf

    def lay(self, problem: TurnProblem, bound: float = math.inf) -> Found[SplinePath] | GaveUp:
        """See ``Method``."""
        poses = self.poses(problem, problem.vias, bound)
        if poses is None:
            return GaveUp((f"{self.max_rows} rows of headings at the via points",))
        spline_path = problem.laid(poses)
        roomy = problem.without_blocked_spots(spline_path)
        if roomy is not None:
            return self.lay(roomy, bound)
        return Found(spline_path, problem.path.cost(spline_path), self._settles(problem, poses))

    def _settles(self, problem: TurnProblem, poses: Poses) -> bool:
        """Whether no other method need be asked: where hardly any row could be shorter."""
        if math.isinf(self.settled_within):
            return True
        legs, costs = self._legs(problem, problem.vias)
        least = _least_length(legs, costs, problem.path.sequence.closed)
        return poses.length <= self.settled_within * least

    def _legs(
        self, problem: TurnProblem, sought: Collection[int]
    ) -> tuple[tuple[HeadingLeg, ...], Floats]:
        """The legs between headings at some via points, and what they cost."""
        needs = problem.path.requirements
        legs = problem.heading_legs(sought, self.headings)
        return with_room(legs, costs_between(legs, needs), needs)

    def poses(
        self, problem: TurnProblem, sought: Collection[int], bound: float = math.inf
    ) -> Poses | None:
        """The best row of headings at some via points, None if there is none.

        Args:
            problem: What is asked.
            sought: The via points; at the others headings come to be as they are.
            bound: Only what costs less is of use [m or s].
        """
        needs, closed = problem.path.requirements, problem.path.sequence.closed
        bound = needs.objective.metres(bound)
        legs, costs = self._legs(problem, sought)
        as_it_is, pushed = map(problem.on_sides, (turn_path_if_clear, clear_turn_path))
        found = posed(legs, costs, closed, as_it_is, self.max_rows, self.max_rows, bound)
        if found is not None:
            if found.length <= MUCH_LONGER * _least_length(legs, costs, closed):
                return found
            bound = min(bound, found.length)
        rows, pairs = self.max_pushed_rows, self.max_pushed_pairs
        try:
            costs = with_clear_ends(legs, costs, pushed)
            return posed(legs, costs, closed, pushed, rows, pairs, bound) or found
        except SpentBudgetError:  # no time is left to look for a shorter one, if there is one
            if found is None:
                raise
            return found


def _least_length(legs: Sequence[HeadingLeg], costs: Floats, closed: bool) -> float:
    """How long the shortest row of legs is, clear or not [m]; see ``posed``."""
    counts = np.array([*(len(leg.starts) for leg in legs), len(legs[-1].goals)])
    return float(cheapest(costs, counts, closed)[1])
