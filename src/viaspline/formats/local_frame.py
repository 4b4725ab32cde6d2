"""The local frame: metres east and north of an origin, for latitudes and longitudes [deg]."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from viaspline.kernels.arrays import Floats

MAX_REACH_M: Final = 500e3
"""How far from the origin a place may be; farther off, a flat frame is no map any more."""


@dataclass(frozen=True)
class LocalFrame:
    """East and north in the plane that touches the WGS 84 ellipsoid at the origin.

    Heights don't take part: the plane's own up grows with the square of the distance, which
    nobody who gives a height over the ground means.

    Attributes:
        latitude: Of the origin [deg].
        longitude: Of the origin [deg].
    """

    latitude: float
    longitude: float

    @property
    def geographic(self) -> tuple[float, float]:
        """Latitude and longitude of the origin [deg], the latter from -180 to 180.

        >>> LocalFrame(47.0, 352.0).geographic
        (47.0, -8.0)
        """
        return self.latitude, self.longitude - 360.0 * round(self.longitude / 360.0)

    def to_local(self, latitude: Any, longitude: Any) -> Floats:
        """Metres east and north of the origin, shape (..., 2), for places on the ground.

        >>> frame = LocalFrame(47.0, 180.0)
        >>> frame.to_local(47.0, -179.999).round(2).tolist()
        [76.06, 0.0]
        """
        import pymap3d

        east, north, _ = pymap3d.geodetic2enu(
            np.asarray(latitude, dtype=float),
            np.asarray(longitude, dtype=float),
            0.0,
            self.latitude,
            self.longitude,
            0.0,
        )
        return np.stack(np.broadcast_arrays(east, north), axis=-1)

    def to_geodetic(self, local: Any) -> tuple[Floats, Floats]:
        """Latitude and longitude [deg] of places on the ground, the inverse of `to_local`.

        >>> latitude, longitude = LocalFrame(47.0, 8.0).to_geodetic([0.0, 0.0])
        >>> float(latitude), float(longitude)
        (47.0, 8.0)
        """
        import pymap3d

        east, north = np.moveaxis(np.asarray(local, dtype=float), -1, 0)
        up = np.zeros_like(east)
        # The ground lies below the plane; each round squares away most of what is left.
        for _ in range(6):
            latitude, longitude, height = pymap3d.enu2geodetic(
                east, north, up, self.latitude, self.longitude, 0.0
            )
            up = up - height
        return np.asarray(latitude, dtype=float), np.asarray(longitude, dtype=float)

    def arc(self, latitude: float, longitude: float) -> float:
        """The distance from the origin over a globe [m], good to a percent.

        >>> round(LocalFrame(0.0, 179.0).arc(0.0, -179.0), -3)
        222000.0
        """
        a, b = math.radians(self.latitude), math.radians(latitude)
        turn = math.radians(longitude - self.longitude)
        half = math.sin((b - a) / 2) ** 2 + math.cos(a) * math.cos(b) * math.sin(turn / 2) ** 2
        return 2 * 6.371e6 * math.asin(math.sqrt(min(max(half, 0.0), 1.0)))
