"""A range sensor in space: it tells where each thing that moves is, and how fast it goes.

Tested through ``space/online/test_solid_tracks``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.moving_solids import POINT, gaps_to
from viaspline.tracks.told_velocities import told_velocities


@dataclass(frozen=True, eq=False)
class SolidSighting:
    """One moving thing at one instant.

    Attributes:
        index: Which one it is: the same in every look.
        solid: How large it is and what it is called; nobody is told how it goes on.
        place: Of the middle of its body [m], (3,).
        velocity: As it was measured [m/s].
    """

    index: int
    solid: MovingSolid
    place: Floats
    velocity: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class SolidSensor:
    """Sees all round, up to a range, whatever is in between.

    Attributes:
        solids: What there is to see, as it truly moves.
        reach: How far it sees from the robot's reference point [m].
        velocity_noise: Standard deviation of each coordinate of a velocity [m/s]; the noise is cut
            off at three of them.
        seed: For the noise.
    """

    solids: tuple[MovingSolid, ...]
    reach: float
    velocity_noise: float = 0.0
    seed: int = 0

    def seen(self, place: Floats, time: float, number: int) -> tuple[SolidSighting, ...]:
        """What has a part in range.

        Args:
            place: Of the robot [m], (3,).
            time: By the clock of what moves [s].
            number: Of the look; looks with the same number have the same noise.
        """
        if not self.solids:
            return ()
        velocities = np.array([one.velocity(time) for one in self.solids])
        told = told_velocities(velocities, self.velocity_noise, self.seed, number)
        when = np.array([time])
        return tuple(
            SolidSighting(k, one, one.at(when)[0], told[k])
            for k, one in enumerate(self.solids)
            if self.shows(one, place, time)
        )

    def shows(self, solid: MovingSolid, place: Floats, time: float) -> bool:
        """Whether something has a part in range of a place [m], (3,), at a time [s]."""
        gap = gaps_to(solid, POINT, place[None], np.array([time]))[0]
        return bool(gap <= self.reach)
