"""The problem of a path that a robot is to drive, and what its turns go along.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import tee

import numpy as np

from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.routing.taut_path import TautPath
from viaspline.planning.turning.bend_row import RowBends, bends_of_legs
from viaspline.planning.turning.kept_lanes import KeptLanes
from viaspline.planning.turning.laid_turns import through_spans, through_turns
from viaspline.planning.turning.spline_and_turns import turns_on_runs
from viaspline.planning.turning.turning_problem import TurningProblem

LOOP_RAD = 1.25 * math.pi  # a turn by more is a loop: it begins to the other side


@dataclass(frozen=True)
class DrivenProblem(TurningProblem):
    """A path that is asked for, laid of turns along taut paths and lanes."""

    @cached_property
    def kept_lanes(self) -> KeptLanes:
        """The lanes that its legs keep to."""
        return KeptLanes(self)

    def turns_along(
        self, taut_paths: Sequence[TautPath], choices: Iterable[RowBends] | None = None
    ) -> SplinePath | None:
        """Lines and turns along a row of taut paths, with the widest turns that keep clear.

        Where the mission says how taut its spline is to be, on the blocked legs alone if that
        keeps clear.

        Args:
            taut_paths: One for each leg.
            choices: The bends along them, if they are known: see ``KeptLanes.bends_along``.
        """
        tried, again = tee(self.kept_lanes.bends_along(taut_paths) if choices is None else choices)
        if self.requirements.has_own_tension and self.requirements.detours != "local":
            spline_path = self._turns_on_blocked(taut_paths, tried)
            if spline_path is not None:
                return spline_path
        return self._cheapest_unwound(again)

    def _cheapest_unwound(self, choices: Iterable[RowBends]) -> SplinePath | None:
        """The first that is laid; where that makes a loop, the cheapest up to one that makes none.

        A wide turn into a given heading may have room by a loop alone, where a sharper one needs
        none.
        """
        best: SplinePath | None = None
        cost = math.inf
        try:
            for legs, rho in self._at_radii(choices):
                bends = bends_of_legs(self.sequence, legs)
                turn_path = self.turns_round(bends, rho, self.rests_at_ends)
                if turn_path is None:
                    continue
                spline_path = through_turns(self.sequence, [turn_path])
                if not self.keeps_sides(spline_path):
                    continue
                its_cost = self.cost(spline_path)
                if its_cost < cost:
                    best, cost = spline_path, its_cost
                if float(np.abs(turn_path.turns).max()) < LOOP_RAD:
                    break
        except SpentBudgetError:
            if best is None:
                raise
        return best

    def _at_radii(self, choices: Iterable[RowBends]) -> Iterator[tuple[RowBends, float]]:
        """Each choice of bends with every least radius of turns [m]."""
        return ((legs, rho) for legs in choices for rho in self.least_radii)

    def _turns_on_blocked(
        self, taut_paths: Sequence[TautPath], choices: Iterable[RowBends]
    ) -> SplinePath | None:
        """The spline with turns on its blocked legs, if some are free and it can be driven."""
        bent = {k for k, taut_path in enumerate(taut_paths) if not taut_path.is_direct}
        blocked = bent | set(self.cleared.passed)
        if len(blocked) == len(self.sequence.legs):
            return None
        for legs, rho in self._at_radii(choices):
            lay_row = partial(self.turns_round, rho=rho)
            found = turns_on_runs(self.sequence, legs, blocked, lay_row)
            if found is None:
                continue
            spans, joints, detours = found
            spline_path = through_spans(self.sequence, spans, np.array(joints), detours)
            if self.is_drivable(spline_path.spans) and self.keeps_sides(spline_path):
                return spline_path
        return None

    def is_promising(self, legs: RowBends, bound: float) -> bool:
        """Whether turns round the bends of all legs may cost less than a bound [m or s].

        Those of a good driver do where nothing else stands beside them.
        """
        if not self.requirements.objective.is_time:
            return True
        bends, stands = bends_of_legs(self.sequence, legs), tuple(leg.stands for leg in self.legs)
        asked = ("ideal time", self.sharpest, bends.key, stands)
        return (
            self.requirements.recalled(asked, partial(self.ideal_time, self.sequence, bends))
            < bound
        )
