"""At which stations a robot had better stop, turn where it stands, and go on straight.

Tested through ``planning/methods/test_corners_at_stations``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from viaspline.planning.turning.bend_row import LegBends, bends_of_legs
from viaspline.planning.turning.driven_problem import DrivenProblem

LEAST_TURN_RAD: Final = 0.5
"""Ways that turn by less at a station are driven in one curve: that takes hardly longer."""


@dataclass(frozen=True)
class StationCorners:
    """The stations of a path at which there had better be corners.

    A robot that stands at a station turns there while it dwells, so it goes there and away as if
    there were nothing before and after. A turn that takes longer than it stays there is no sooner
    than a curve, for that loses little.

    Attributes:
        problem: The path.
    """

    problem: DrivenProblem

    @property
    def found(self) -> tuple[int, ...]:
        """The via points, in order."""
        if not self.may_be_any:
            return ()
        return tuple(via for via in self._stations if self._is_corner(via))

    @property
    def may_be_any(self) -> bool:
        """Whether the robot may turn at its stations, and would be sooner for it."""
        needs = self.problem.requirements
        if not needs.is_free_disc or not needs.objective.is_time or needs.has_own_tension:
            return False
        return needs.turns_on_spot != "never"

    def fits(self, via: int, turn: float) -> bool:
        """Whether a turn [rad] at a station takes no longer than the robot stays there."""
        stays = self.problem.sequence.vias[via].dwell
        return self.problem.requirements.turning.time(turn) <= stays

    @property
    def _stations(self) -> Iterator[int]:
        sequence = self.problem.sequence
        ends = () if sequence.closed else (0, len(sequence.vias) - 1)
        for k, via in enumerate(sequence.vias):
            if via.dwell > 0.0 and k not in ends and self.fits(k, LEAST_TURN_RAD):
                yield k

    def _is_corner(self, via: int) -> bool:
        """Whether the ways there and away turn enough, and no more than the robot has time for."""
        sequence, taut_paths = self.problem.sequence, self.problem.shortest_row.taut_paths
        legs = (via - 1) % len(sequence.legs), via
        if min(taut_paths[leg].length for leg in legs) <= 0.0:
            return False
        bends = [LegBends.along(taut_paths[leg]) for leg in legs]
        row = bends_of_legs(sequence.between(legs[0], legs[0] + 2), bends)
        turn = abs(row.turn_at(row.places(1)))
        return turn >= LEAST_TURN_RAD and self.fits(via, turn)
