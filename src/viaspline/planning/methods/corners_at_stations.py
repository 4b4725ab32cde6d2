"""What other methods lay, with corners at stations where a robot turns while it stands there."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from viaspline.planning.problem.method import Found, Method, Outcome, first_settled
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.parts_at_corners import PartsAtCorners
from viaspline.planning.turning.station_corners import StationCorners


@dataclass(frozen=True)
class CornersAtStations:
    """Lays what lies between such stations by itself, and puts it together.

    Attributes:
        methods: The others, in the order in which they are asked.
    """

    methods: Sequence[Method[DrivenProblem, SplinePath]]

    def lay(self, problem: DrivenProblem, bound: float = math.inf) -> Outcome[SplinePath]:
        """See ``Method``. Where a part can't be laid, the path has no corners."""
        corners = StationCorners(problem)
        if found := corners.found:
            laid = self._in_parts(PartsAtCorners(problem, found), corners)
            if laid is not None:
                return laid
        return first_settled(self.methods, problem, bound)

    def _in_parts(self, parts: PartsAtCorners, corners: StationCorners) -> Found[SplinePath] | None:
        laid: list[SplinePath] = []
        for part in parts.problems:
            outcome = first_settled(self.methods, part)
            if not isinstance(outcome, Found):
                return None
            laid.append(outcome.value)
        turns = zip(parts.corners, parts.turns(laid).tolist(), strict=True)
        if not all(corners.fits(via, turn) for via, turn in turns):
            return None
        whole = parts.joined(laid)
        return Found(whole, parts.whole.cost(whole))
