"""What a search for a route in space comes to.

Tested through ``space/routing/test_space_router``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.method import Found, GaveUp, Refusal

Place3 = tuple[float, float, float]

Norm = tuple[float, float, float]
"""Greatest speed, climbing speed and sinking speed [m/s]: cheap is what takes little time."""

LENGTH: Norm = (0.0, 0.0, 0.0)
"""Instead of a norm of speeds: what is cheap is what is short."""


@dataclass(frozen=True, eq=False)
class TautRoute:
    """A polyline between two places, pulled taut and clear as a whole.

    Attributes:
        points: Its vertices [m], shape (n, 3), read-only; start and goal among them.
        cost: Its length [m], or the time that it takes at least [s].
        clearance: What all of it keeps, by exact tests of its lines [m].
    """

    points: Floats
    cost: float
    clearance: float

    def __post_init__(self) -> None:
        points = np.array(self.points, np.float64)
        points.flags.writeable = False
        object.__setattr__(self, "points", points)

    @property
    def length(self) -> float:
        """[m]."""
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())

    @property
    def is_direct(self) -> bool:
        """Whether nothing stands between the two places."""
        return len(self.points) == 2


@dataclass(frozen=True)
class SpaceRefusal(Refusal):
    """A proof that there is no route in space.

    Attributes:
        where: The place that it is about: the end that can't be served, or that is shut in [m].
        obstacle: What is nearest to it, as the world numbers it; see ``SpatialWorld.name``.
    """

    where: Place3 = (0.0, 0.0, 0.0)
    obstacle: int = -1


@dataclass(frozen=True)
class SpaceGaveUp(GaveUp):
    """No route was found in space, and it isn't known whether there is one.

    Attributes:
        resolution: Step of the finest lattice that was searched [m].
    """

    resolution: float = 0.0


SpaceOutcome: TypeAlias = Found[TautRoute] | SpaceRefusal | SpaceGaveUp
"""A route, a proof that there is none, or neither."""
