"""From the grids that pictures of the ground come in to latitudes and longitudes."""

from __future__ import annotations

import math
import re
from typing import Any, Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.studio.refused_error import RefusedError

METRES: Final = "metres"
"""The grid of the mission itself."""

DEGREES: Final = "degrees"
"""Longitudes and latitudes; a pair of them is said latitude first."""

_LONGITUDES_AND_LATITUDES: Final = (4326, 4258, 4269, 4979)
_WEB_MERCATOR: Final = 3857
_NORTH: Final = {326: "WGS 84", 258: "ETRS89", 269: "NAD83"}
"""The first digits of UTM's zones north of the equator; they differ by a metre at most."""
_SOUTH: Final = 327

_EARTH_RADIUS_M: Final = 6378137.0
_FLATTENING: Final = 1 / 298.257223563
_UTM_SCALE: Final = 0.9996
_FALSE_EAST_M: Final = 500e3
_FALSE_NORTH_M: Final = 10_000e3


def grid_of(epsg: int) -> str:
    """What a code of EPSG is called here.

    >>> grid_of(4326), grid_of(32632)
    ('degrees', 'EPSG:32632')
    """
    return DEGREES if epsg in _LONGITUDES_AND_LATITUDES else f"EPSG:{epsg}"


def check_grid(grid: str) -> None:
    """Refuse a grid that isn't known.

    Raises:
        RefusedError: Naming those that are.
    """
    if grid not in (METRES, DEGREES):
        _code(grid)


def geodetic(grid: str, points: Any) -> tuple[Floats, Floats]:
    """Latitudes and longitudes [deg] of places in a grid.

    Krüger's series for UTM to the third order, good to less than a millimetre within a zone.

    Args:
        grid: ``degrees`` or ``EPSG:…``.
        points: x and y, shape (..., 2): east and north [m], or longitude and latitude [deg].

    Raises:
        RefusedError: The grid isn't known.

    >>> latitude, longitude = geodetic("EPSG:32617", (630084.0, 4833438.0))
    >>> round(float(latitude), 4), round(float(longitude), 4)
    (43.6426, -79.3871)
    """
    x, y = np.moveaxis(np.asarray(points, np.float64), -1, 0)
    if grid == DEGREES:
        return y, x
    code = _code(grid)
    if code == _WEB_MERCATOR:
        latitude = np.arctan(np.sinh(y / _EARTH_RADIUS_M))
        return np.degrees(latitude), np.degrees(x / _EARTH_RADIUS_M)
    zone, is_south = code % 100, code // 100 == _SOUTH
    return _from_utm(zone, x, y - _FALSE_NORTH_M if is_south else y)


def _code(grid: str) -> int:
    found = re.fullmatch(r"EPSG:(\d{4,5})", grid)
    code = int(found[1]) if found else 0
    is_utm = code // 100 in (*_NORTH, _SOUTH) and 1 <= code % 100 <= 60
    if code != _WEB_MERCATOR and not is_utm:
        raise RefusedError(
            f"the grid '{grid:.20}' isn't known here, but UTM (EPSG:32601 to 32660, 32701 to "
            "32760), EPSG:3857 and degrees are: gdalwarp -t_srs EPSG:4326, or give its corners"
        )
    return code


def _from_utm(zone: int, east: Floats, north: Floats) -> tuple[Floats, Floats]:
    """Of places in a zone, the equator being 0 north [m]."""
    n = _FLATTENING / (2 - _FLATTENING)
    radius = _EARTH_RADIUS_M / (1 + n) * (1 + n**2 / 4 + n**4 / 64)
    xi = north / (_UTM_SCALE * radius)
    eta = (east - _FALSE_EAST_M) / (_UTM_SCALE * radius)
    to_sphere = (
        n / 2 - 2 * n**2 / 3 + 37 * n**3 / 96, n**2 / 48 + n**3 / 15, 17 * n**3 / 480,
    )  # fmt: skip
    back = (2 * n - 2 * n**2 / 3 - 2 * n**3, 7 * n**2 / 3 - 8 * n**3 / 5, 56 * n**3 / 15)
    up, across = xi, eta
    for j, b in enumerate(to_sphere, start=1):
        xi = xi - b * np.sin(2 * j * up) * np.cosh(2 * j * across)
        eta = eta - b * np.cos(2 * j * up) * np.sinh(2 * j * across)
    chi = np.arcsin(np.sin(xi) / np.cosh(eta))
    latitude = chi + sum(d * np.sin(2 * j * chi) for j, d in enumerate(back, start=1))
    longitude = math.radians(6 * zone - 183) + np.arctan2(np.sinh(eta), np.cos(xi))
    return np.degrees(latitude), np.degrees(longitude)
