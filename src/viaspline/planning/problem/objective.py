"""What a path is to have little of: time, or length.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.mission.route_spec import Optimise
from viaspline.planning.problem.path_pace import Pace


@dataclass(frozen=True)
class Objective:
    """By what paths are chosen.

    Attributes:
        optimise: ``time`` or ``length``.
        pace: How fast the robot may go.
    """

    optimise: Optimise
    pace: Pace

    @property
    def is_time(self) -> bool:
        """Whether it is the time in which they are driven."""
        return self.optimise == "time"

    def metres(self, cost: float) -> float:
        """The greatest length that a path of this cost can have [m]."""
        return cost * self.pace.speed if self.is_time else cost
