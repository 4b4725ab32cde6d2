"""A law in pieces of even acceleration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats

NO_TIME_S = 1e-12
"""LawKnots that are no farther apart are one [s]."""


@dataclass(frozen=True, eq=False)
class LawKnots:
    """When a law is where and how fast, with even acceleration between.

    Attributes:
        times: [s], not decreasing, (n,).
        places: Distances along the path [m], (n,).
        speeds: [m/s], (n,).

    Example:
        >>> stand = LawKnots(np.zeros(1), np.zeros(1), np.zeros(1)).then(1.0).then(3.0)
        >>> stand.merged().times.tolist()
        [0.0, 3.0]
    """

    times: Floats
    places: Floats
    speeds: Floats

    @property
    def fields(self) -> tuple[Floats, Floats, Floats]:
        """Times, places, speeds."""
        return self.times, self.places, self.speeds

    def followed_by(self, later: LawKnots) -> LawKnots:
        """These, and then others."""
        both = zip(self.fields, later.fields, strict=True)
        return LawKnots(*(np.concatenate(pair) for pair in both))

    def then(self, time: float) -> LawKnots:
        """These, and then it stays until a time [s]."""
        return self.followed_by(LawKnots(np.array([time]), self.places[-1:], self.speeds[-1:]))

    def since(self, first: int) -> LawKnots:
        """Those from one on."""
        return LawKnots(*(values[first:] for values in self.fields))

    def merged(self) -> LawKnots:
        """Those that are needed: neither twice, nor in the middle of standing."""
        times, places, _ = self.fields
        if (times[1:] > times[:-1] + NO_TIME_S).all() and (places[1:] > places[:-1]).all():
            return self
        once = np.flatnonzero(np.append(True, np.diff(times) > NO_TIME_S))
        if once.size > 1:
            once[-1] = len(times) - 1  # where it ends is kept to the bit
        stays = np.diff(places[once]) == 0.0
        middle = np.concatenate(([False], stays[:-1] & stays[1:], [False]))[: once.size]
        return LawKnots(*(values[once[~middle]] for values in self.fields))
