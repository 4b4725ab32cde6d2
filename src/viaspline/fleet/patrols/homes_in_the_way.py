"""Which patrols can't be, because they come again and again to where another robot stands.

Tested through ``fleet/patrols/test_timed_patrols``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings, box_owners
from viaspline.kernels.arrays import Flags, Ints


@dataclass(frozen=True, eq=False)
class PatrolMeetings:
    """Where one lap of a patrol passes places at which others stand.

    Attributes:
        starts: (patrol, robot whose start it passes, or where whose laps begin), each pair once,
            (m, 2).
        goals: (patrol, robot whose goal it passes and that stays there), (k, 2).
    """

    starts: Ints
    goals: Ints

    @classmethod
    def of(
        cls, courses: FleetCourses, crossings: FleetCrossings, vanishes: Flags, patrols: Flags,
        take_off: Flags,
    ) -> PatrolMeetings:  # fmt: skip
        """Find them.

        Args:
            courses: Of a fleet, with one lap of each patrol.
            crossings: Where these come near each other.
            vanishes: Which robots leave the world when they arrive, (n,).
            patrols: Which ones are patrols, (n,).
            take_off: Which ones begin their laps where they end, and not where they start, (n,).
        """
        packed, first = crossings.packed, courses.packed.first
        owner = box_owners(packed)
        by_patrol = patrols[packed.other]
        comes_back = take_off[owner] & (packed.cell == first[owner + 1] - 2)
        at_start = by_patrol & ((packed.cell == first[owner]) | comes_back)
        at_goal = by_patrol & (packed.cell == first[owner + 1] - 2)
        at_goal &= ~(vanishes | patrols)[owner]
        pairs = np.column_stack([packed.other, owner])
        return cls(np.unique(pairs[at_start], axis=0), np.unique(pairs[at_goal], axis=0))

    def hopeless(self, patrols: Flags) -> dict[int, int]:
        """Robots that can't be served, each with the one that is in its way.

        A patrol can't pass the start of another one, which comes back there every lap. A robot
        can't stay where a patrol passes; if it starts there as well it is the patrol that goes.

        Args:
            patrols: Which robots are patrols, (n,).
        """
        found = {p: other for p, other in self.starts.tolist() if patrols[other]}
        starts = {tuple(pair) for pair in self.starts.tolist()}
        for patrol, robot in self.goals.tolist():
            if patrol in found:
                continue
            if (patrol, robot) in starts:
                found[patrol] = robot
            else:
                found[robot] = patrol
        return found

    def with_passers(self, out: dict[int, int]) -> dict[int, int]:
        """Robots that aren't served, and the patrols that pass the start of one: it stands there.

        Args:
            out: Robots, each with one that is in its way.
        """
        found = dict(out)
        while True:
            more = {p: k for p, k in self.starts.tolist() if k in found and p not in found}
            if not more:
                return found
            found |= more

    def start_passed_by(self, robot: int) -> list[int]:
        """The patrols that pass the start of a robot."""
        return [patrol for patrol, other in self.starts.tolist() if other == robot]
