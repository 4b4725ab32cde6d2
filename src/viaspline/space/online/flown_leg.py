"""A stretch of a flight: one path, one time law, one profile of headings.

Tested through ``space/online/test_fly``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.space.timing.yaw_profile import YawProfile
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.trajectory.trajectory import Trajectory

STANDS_M: Final = 1e-6
"""How far from the place of a turn a law may stand for it."""


@dataclass(frozen=True, eq=False)
class FlownLeg:
    """What is followed from one re-plan to the next.

    Attributes:
        path: In space.
        law: When it is where on it.
        yaw: Where it looks.
        until: When something else takes its place [s].
        moving: How far it stays from what moves; None where nothing does.
    """

    path: Path
    law: Trajectory
    yaw: YawProfile
    until: float
    moving: MovingCertificate | None = None

    def states(self, times: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """Positions (n, 3) [m], headings [rad], speeds and climbs [m/s] at times [s], (n,)."""
        distances, speeds, _ = self.law.state_at(np.minimum(times, self.law.end_time))
        distances = np.clip(distances, 0.0, self.path.length)
        u = np.asarray(self.path.parameter(distances))
        climbs = speeds * self.path.tangent(u)[:, 2]
        return self.path.evaluate(u), self._headings(times, distances), speeds, climbs

    def _headings(self, times: Floats, distances: Floats) -> Floats:
        """Of the body: [rad], (n,); it turns on the spot evenly for as long as it stands there."""
        headings = self.yaw.at(distances)
        law = self.law
        for place, by in self.yaw.turns:
            stands = np.flatnonzero(np.abs(law.distances - place) <= STANDS_M)
            if not len(stands):
                continue
            begin, end = law.times[stands[[0, -1]]].tolist()
            at = (times >= begin) & (times < end)
            first = float(self.yaw.at(np.nextafter(place, -np.inf)))
            headings[at] = first + by * (times[at] - begin) / (end - begin)
        return headings
