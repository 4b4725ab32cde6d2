"""What was driven, moment by moment, close together.

Tested through ``robot/simulation/test_near_misses``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats

MAX_TURN_RAD = 0.02
"""A body turns no more than this from one moment to the next [rad]."""


@dataclass(frozen=True, eq=False)
class DrivenMotion:
    """A body's motion.

    Attributes:
        times: [s], shape (n,).
        places: Of its reference point [m], shape (n, 2).
        headings: [rad], shape (n,).
        speeds: Over the ground [m/s], shape (n,).
        distances: Along what was driven [m], shape (n,).
        step: From one look of the sensor to the next [s].
    """

    times: Floats
    places: Floats
    headings: Floats
    speeds: Floats
    distances: Floats
    step: float

    @property
    def looks(self) -> NDArray[np.int64]:
        """At which moments the sensor looks, in order."""
        within = np.floor(self.times / self.step)
        within = within[np.diff(within, prepend=-1.0) > 0.0]
        ticks = np.unique(np.concatenate((within, within + 1.0)))
        ticks = self.step * ticks[ticks <= np.floor(self.times[-1] / self.step + 1e-9)]
        return np.unique(np.searchsorted(self.times, ticks - 1e-9).clip(max=len(self.times) - 1))

    def with_turns(self) -> DrivenMotion:
        """The motion with more moments where it turns far from one to the next, as on the spot.

        Example:
            >>> spot = DrivenMotion(*(np.zeros(k) for k in (2, (2, 2), 2, 2, 2)), step=0.1)
            >>> spot.headings[1] = np.pi
            >>> len(spot.with_turns().headings)
            159
        """
        headings = np.unwrap(self.headings)
        counts = np.maximum(np.ceil(np.abs(np.diff(headings)) / MAX_TURN_RAD), 1.0).astype(int)
        old = np.arange(len(headings), dtype=float)
        first = np.repeat(np.cumsum(counts) - counts, counts)
        within = (np.arange(len(first)) - first) / np.repeat(counts, counts)
        new = np.append(np.repeat(old[:-1], counts) + within, old[-1])

        def at(values: Floats) -> Floats:
            return np.asarray(np.interp(new, old, values))

        places = np.column_stack([at(axis) for axis in self.places.T])
        return DrivenMotion(
            at(self.times), places, at(headings), at(self.speeds), at(self.distances), self.step
        )
