"""How far a flying body is from things that move, at instants.

Tested through ``space/among/test_moving_solid``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.among.moving_solid import MovingSolid

POINT = FlyingBody(0.0, 0.0, 0.0)
"""A body without extent."""


def body_of(solid: MovingSolid) -> FlyingBody:
    """The body of something that moves."""
    return FlyingBody(*solid.body)


def gaps_to(solid: MovingSolid, body: FlyingBody, places: Floats, times: Floats) -> Floats:
    """Free space between a body at places and something at times, wherever that may be then.

    Args:
        solid: What moves.
        body: That of the robot.
        places: Of its reference point [m], (n, 3).
        times: When it is there [s], (n,).

    Returns:
        [m], (n,); infinite where it isn't there.
    """
    gaps = body.gaps(body_of(solid), solid.at(times) - places) - solid.off_at(times)
    return np.where(np.isnan(gaps), np.inf, gaps)


@dataclass(frozen=True, eq=False)
class MovingSolids:
    """Things that move in space as they are to one robot.

    Attributes:
        solids: They.
        body: The robot's.
    """

    solids: tuple[MovingSolid, ...]
    body: FlyingBody

    def __len__(self) -> int:
        return len(self.solids)

    @property
    def top_speed(self) -> float:
        """Of any of them [m/s]."""
        return max((one.top_speed for one in self.solids), default=0.0)

    def name(self, index: int) -> str:
        """What one is called."""
        return self.solids[index].name

    def alone(self, index: int) -> MovingSolids:
        """One of them."""
        return MovingSolids(self.solids[index : index + 1], self.body)

    def nearest(self, places: Floats, times: Floats) -> tuple[Floats, Ints]:
        """Free space to the nearest of them, and which that is.

        Args:
            places: Of the robot's reference point [m], (n, 3).
            times: When it is there [s], (n,).

        Returns:
            ([m], (n,), infinite where none is there; its number or -1, (n,)).
        """
        least, which = np.full(len(places), np.inf), np.full(len(places), -1, np.int64)
        for k, one in enumerate(self.solids):
            gaps = gaps_to(one, self.body, places, times)
            nearer = gaps < least
            least[nearer], which[nearer] = gaps[nearer], k
        return least, which

    def distance(self, places: Floats, times: Floats) -> Floats:
        """Free space to the nearest of them at times [s], (n,): [m], (n,)."""
        return self.nearest(places, times)[0]
