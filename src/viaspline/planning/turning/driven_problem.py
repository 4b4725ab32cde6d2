"""The problem of a path that a robot is to drive, and what its turns go along.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import chain, tee

import numpy as np

from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.routing.taut_path import TautPath
from viaspline.planning.turning.bend_row import Bends, RowBends, bends_of_legs
from viaspline.planning.turning.kept_lanes import KeptLanes
from viaspline.planning.turning.laid_turns import through_spans, through_turns
from viaspline.planning.turning.spline_and_turns import turns_on_runs
from viaspline.planning.turning.turn_path import WOUND_RAD, TurnPath, turned_otherwise
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
        laid = self._turns_on_all(again)
        if self.requirements.has_own_tension and self.requirements.detours != "local":
            laid = chain(self._turns_on_blocked(taut_paths, tried), laid)
        return self._cheapest_unwound(laid)

    def _cheapest_unwound(self, laid: Iterator[tuple[SplinePath, float]]) -> SplinePath | None:
        """The first that is laid; where that is wound, the better of it and the next one.

        Where it makes a loop, the best up to one that makes none. A wide turn into a given heading
        may have room the longer way round alone, where a sharper one has it the other way, and so
        may one between the directions of a spline. Where length counts, or the mission says how
        taut its spline is to be, what is wound is left as it is: the next one is sharper.

        Args:
            laid: Paths, each with the largest of its turns [rad].
        """
        best: SplinePath | None = None
        needs = self.requirements
        is_left = not needs.objective.is_time or needs.has_own_tension
        first = LOOP_RAD if is_left else WOUND_RAD
        try:
            for number, (spline_path, turn) in enumerate(laid):
                if best is None or self.price(spline_path) < self.price(best):
                    best = spline_path
                if turn < (LOOP_RAD if number > 0 else first):
                    break
        except SpentBudgetError:
            if best is None:
                raise
        return best

    def _turns_on_all(self, choices: Iterable[RowBends]) -> Iterator[tuple[SplinePath, float]]:
        """Turns on all legs that keep to the asked sides, with the largest of them [rad].

        Where one is wound, or nowhere is room, via points are turned at to other sides as well.
        """
        stuck: list[tuple[Bends, float]] = []
        for legs, rho in self._at_radii(choices):
            bends = bends_of_legs(self.sequence, legs)
            found = self._laid(bends, rho)
            if found is None:
                stuck.append((bends, rho))
                continue
            otherwise = (self._laid(other, rho) for other in turned_otherwise(bends, found[1]))
            best = min((found, *filter(None, otherwise)), key=lambda laid: self.price(laid[0]))
            yield best[0], best[1].largest_turn
        for bends, rho in stuck:
            for other in turned_otherwise(bends, None):
                found = self._laid(other, rho)
                if found is not None:
                    yield found[0], found[1].largest_turn

    def _laid(self, bends: Bends, rho: float) -> tuple[SplinePath, TurnPath] | None:
        """Turns of at least a radius [m] round a row that keep to the asked sides, if there are."""
        turn_path = self.turns_round(bends, rho, self.rests_at_ends)
        if turn_path is None:
            return None
        spline_path = through_turns(self.sequence, [turn_path])
        return (spline_path, turn_path) if self.keeps_sides(spline_path) else None

    def _at_radii(self, choices: Iterable[RowBends]) -> Iterator[tuple[RowBends, float]]:
        """Each choice of bends with every least radius of turns [m]."""
        return ((legs, rho) for legs in choices for rho in self.least_radii)

    def _turns_on_blocked(
        self, taut_paths: Sequence[TautPath], choices: Iterable[RowBends]
    ) -> Iterator[tuple[SplinePath, float]]:
        """The spline with turns on its blocked legs, with the largest of them [rad].

        None where no leg is free, and none that can't be driven or doesn't keep to its sides.
        """
        bent = {k for k, taut_path in enumerate(taut_paths) if not taut_path.is_direct}
        blocked = bent | set(self.cleared.passed)
        if len(blocked) == len(self.sequence.legs):
            return
        for legs, rho in self._at_radii(choices):
            lay_row = partial(self.turns_round, rho=rho)
            found = turns_on_runs(self.sequence, legs, blocked, lay_row)
            if found is None:
                continue
            spans, joints, detours, turn = found
            spline_path = through_spans(self.sequence, spans, np.array(joints), detours)
            if self.is_drivable(spline_path.spans) and self.keeps_sides(spline_path):
                yield spline_path, turn

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
