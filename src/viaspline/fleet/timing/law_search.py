"""Looking for sooner laws, and for laws of those that have none, a piece of work at a time.

Tested through ``fleet/timing/test_improve_laws``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.timing.rides import FleetRides
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.first_come_laws import first_come_laws
from viaspline.kernels.fleet.foreseen_waits import SeenAhead
from viaspline.kernels.fleet.improved_laws import improved_laws
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.fleet.turned_orders import turned_orders

SEED = 1
"""Of the random numbers of a search."""
PRIORITY_WEIGHT = 2.0
"""What a second of a robot counts against one of a robot whose priority is less by one."""
FORESEEN = 0.2
"""What a second counts that is foreseen to be waited later on, where that is in view."""


def priority_weights(priorities: Sequence[float]) -> Floats:
    """What a second of each robot's lateness counts, (n,).

    Args:
        priorities: Who has more counts more, (n,).

    Example:
        >>> priority_weights([0.0, 2.0]).tolist()
        [0.5, 2.0]
    """
    by_mean = np.array(priorities, float) - np.mean(priorities)
    weights: Floats = PRIORITY_WEIGHT ** np.clip(by_mean, -20.0, 20.0)
    return weights


@dataclass(frozen=True, eq=False)
class LawSearch:
    """A search for better laws.

    Attributes:
        courses: The paths of the robots.
        crossings: Where these come near each other.
        passages: Of these.
        rides: How the robots drive alone.
        weight: What a second of a robot's lateness counts, (n,).
        movable: Whether a robot's law may be changed, (n,).
        state: Of its random numbers, (1,): written to.
    """

    courses: FleetCourses
    crossings: FleetCrossings
    passages: PackedPassages
    rides: FleetRides
    weight: Floats
    movable: Flags
    state: Ints

    @classmethod
    def of(
        cls, courses: FleetCourses, crossings: FleetCrossings, passages: PackedPassages,
        rides: FleetRides, priorities: Sequence[float], fixed: Sequence[int],
    ) -> LawSearch:  # fmt: skip
        """A search that begins.

        Args:
            courses: The paths of the robots.
            crossings: Where these come near each other.
            passages: Of these.
            rides: How the robots drive alone.
            priorities: Who has more counts more, (n,).
            fixed: The robots whose laws stay as they are.
        """
        movable = np.ones(len(priorities), np.bool_)
        movable[list(fixed)] = False
        weight = priority_weights(priorities)
        state = np.array([SEED], np.int64)
        return cls(courses, crossings, passages, rides, weight, movable, state)

    def first_come(self, laws: PackedLaws, foreseen: float = 0.0, chance: float = 0.0) -> int:
        """Give all that may be changed their laws at once: who comes first passes first.

        Args:
            laws: Of those that may not; written to.
            foreseen: What a second counts that is foreseen to be waited later on.
            chance: By how much an order may hold up more and be taken all the same, at random [s].

        Returns:
            How many nodes and passages were looked at.
        """
        sight = SeenAhead(foreseen, chance, np.zeros(len(self.weight)), self.state)
        return first_come_laws(
            self.courses.packed, self.crossings.packed, self.passages, self.rides.packed, laws,
            self.weight, self.movable, sight,
        )  # fmt: skip

    def look(self, laws: PackedLaws, work: int) -> int:
        """Make laws better, in place.

        Args:
            laws: Clear of each other.
            work: How many nodes and passages may be looked at.

        Returns:
            How many were.
        """
        return improved_laws(
            self.courses.packed, self.crossings.packed, self.passages, self.rides.packed, laws,
            self.rides.alone, self.weight, self.movable, work, self.state,
        )  # fmt: skip

    def turn(self, laws: PackedLaws, work: int) -> int:
        """Make laws sooner by letting robots pass before those that they wait for, in place.

        Args:
            laws: Clear of each other; all that may be changed have one.
            work: How many nodes and passages may be looked at.

        Returns:
            How many were.
        """
        return turned_orders(
            self.courses.packed, self.crossings.packed, self.passages, self.rides.packed, laws,
            self.rides.alone, self.weight, self.movable, work, self.state,
        )  # fmt: skip
