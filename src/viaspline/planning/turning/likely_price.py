"""What a path along another row of taut paths is likely to cost at least, told by its least turns.

Lines with the least turns round the bends of a leg are reckoned in a millisecond, and the widest
that fit take as much less on one way as on another: among much else the rows that are worth being
laid are told by them. Straight lines of the same length would tell hardly any apart.

Tested through ``planning/methods/test_other_sides``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from viaspline.planning.alternatives.homotopy_classes import TautRow
from viaspline.planning.checking.driving_time import leg_time
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import turn_path_s
from viaspline.planning.routing.taut_path import TautPath
from viaspline.planning.turning.bend_row import DETOUR, Bends, bend, rows_along
from viaspline.planning.turning.driven_price import DrivenPrice
from viaspline.planning.turning.turn_path import NoTurnPath, turn_path_on_sides

UNSURE = 1.06  # of what is told, by which a way may be better


@dataclass(frozen=True, eq=False)
class LikelyPrice(DrivenPrice):
    """What paths along rows of taut paths are chosen by, where one of them is laid.

    Attributes:
        laid: Along the shortest row.
    """

    laid: SplinePath

    def least(self, row: TautRow, /) -> float:
        """See ``Price``: what is laid, with other legs as much longer as their least turns are."""
        least = super().least(row)
        if not self.problem.requirements.objective.is_time:
            return least
        shortest_paths = self.problem.shortest_row.taut_paths
        others = [k for k, way in enumerate(row.taut_paths) if way is not shortest_paths[k]]
        if not all(map(self._is_told, others)):
            return least
        told = self.problem.cost(self.laid)
        for leg in others:
            ways = shortest_paths[leg], row.taut_paths[leg]
            now, then = (self._with_least_turns(leg, way) for way in ways)
            if now is None or then is None:
                return least
            told += self._laid_time(leg) * (then / (UNSURE * now) - 1.0)
        return max(least, told)

    def _is_told(self, leg: int) -> bool:
        """Whether there is much else about a leg: what little there is costs little to lay."""
        passed = self.problem.cleared.passed
        return leg in passed and not passed[leg].in_the_way.is_little

    def _laid_time(self, leg: int) -> float:
        """How long a leg takes as it is laid [s]."""
        if leg not in self._laid_times:
            pace, stands = self.problem.requirements.objective.pace, self.problem.legs[leg].stands
            self._laid_times[leg] = leg_time(self.laid.leg(leg), pace, stands)
        return self._laid_times[leg]

    @cached_property
    def _laid_times(self) -> dict[int, float]:
        """Those of them that are known [s]: each row is held against them."""
        return {}

    def _with_least_turns(self, leg: int, taut_path: TautPath) -> float | None:
        """How long a way takes with the least turns [s]; None where they have no room."""
        ask = partial(self._told_by_least_turns, leg, taut_path)
        places = taut_path.corners.tobytes(), taut_path.bends.tobytes()
        return self.problem.requirements.recalled(
            ("least turns", leg, self.problem.sharpest, places), ask
        )

    def _told_by_least_turns(self, leg: int, taut_path: TautPath) -> float | None:
        """See ``_with_least_turns``."""
        problem = self.problem
        start, goal = (bend(*end[:2].tolist()) for end in problem.legs[leg].ends)
        rows = np.vstack((start, rows_along(taut_path), goal))
        vias = np.full(len(rows), DETOUR)
        vias[[0, -1]] = leg, leg + 1
        problem.requirements.spend(turn_path_s(len(rows)))
        turn_path = turn_path_on_sides(Bends.free(rows, vias).turning(problem.sharpest))
        if isinstance(turn_path, NoTurnPath):
            return None
        pace, stands = problem.requirements.objective.pace, problem.legs[leg].stands
        return leg_time(turn_path.spans, pace, stands)
