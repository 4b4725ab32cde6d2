"""What other methods lay, with corners at stations where a robot turns while it stands there."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.planning.problem.method import Found, Method, Outcome, first_settled
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.parts_at_corners import PartsAtCorners
from viaspline.planning.turning.station_corners import StationCorners

ROUNDING = 1e-9
"""Of its length, by which a straight line may be longer than its ends are apart."""


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
            line = _straight_line(part)
            outcome = first_settled(self.methods, part) if line is None else Found(line, 0.0)
            if not isinstance(outcome, Found):
                return None
            laid.append(outcome.value)
        turns = zip(parts.corners, parts.turns(laid).tolist(), strict=True)
        if not all(corners.fits(via, turn) for via, turn in turns):
            return None
        whole = parts.joined(laid)
        return Found(whole, parts.whole.cost(whole))


def _straight_line(part: DrivenProblem) -> SplinePath | None:
    """A part as the straight line between its ends, where it is one: nothing is sooner."""
    spline_path, sequence = part.cleared.spline_path, part.sequence
    if len(sequence.legs) > 1 or part.cleared.passed or part.requirements.objective.pace.zones:
        return None
    start, goal = (via.at for via in sequence.vias)
    is_line = spline_path.length <= (1.0 + ROUNDING) * float(np.linalg.norm(goal - start))
    return spline_path if is_line else None
