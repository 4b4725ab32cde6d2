"""What the path of a closed route goes on with at its end: the laps to come.

Tested through ``robot/navigation/test_rounds``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace


@dataclass(frozen=True)
class LapsAhead:
    """What a path goes on with at its end.

    Attributes:
        points: So many points of the route has a lap.
        round: So many has the path, which may be several laps: after them it comes round again.
        goal: Index in the route of the point at which the drive ends.
        unseen: Length of the path's end that isn't looked at yet [m]; 0 on the last lap, on which
            the path ends at the goal.
        timed: Length of the path ahead that the time law reaches over [m].
        kept: Length of the path that stays behind the robot when it grows [m].
        given_up: By their place in the round, points that were given up: up to which lap's that has
            been noted (as an index in the route), and why.
    """

    points: int
    round: int
    goal: int
    unseen: float
    timed: float = math.inf
    kept: float = 0.0
    given_up: Mapping[int, tuple[int, str]] = field(default_factory=dict)

    def is_goal(self, index: int) -> bool:
        """Whether a point of the route, by its index, is in the place where the drive ends."""
        return (self.goal - index) % self.points == 0

    def without(self, skipped: Mapping[int, str]) -> LapsAhead:
        """The laps without points that are given up from now on: their indices, and why."""
        lost = {index % self.round: (index, why) for index, why in skipped.items()}
        return replace(self, given_up={**self.given_up, **lost})

    def newly_missed(self, after: int, before: int) -> tuple[tuple[int, str], ...]:
        """Points between two of the route that were given up in an earlier lap, and why."""
        places = (
            (index, self.given_up.get(index % self.round)) for index in range(after + 1, before)
        )
        return tuple(
            (index, found[1]) for index, found in places if found is not None and index > found[0]
        )
