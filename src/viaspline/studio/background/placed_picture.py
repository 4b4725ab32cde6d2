"""Where a picture lies in the mission's metres: one flat sheet."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.formats.items import LatLon
from viaspline.formats.local_frame import MAX_REACH_M, LocalFrame
from viaspline.kernels.arrays import Floats
from viaspline.studio.background.background import Background
from viaspline.studio.background.earth_grids import DEGREES, METRES, geodetic
from viaspline.studio.background.picture_place import Matrix, PicturePlace
from viaspline.studio.refused_error import RefusedError

PLACES_A_SIDE: Final = 5
"""Of the picture, as many are laid out exactly, for the sheet that fits them best."""

MAX_METRES: Final = 1e7
LEAST_SIZE_M: Final = 1e-3


@dataclass(frozen=True)
class PlacedPicture:
    """A picture as a flat sheet.

    Attributes:
        sheet: a, b, c, d, e, f: x is a + b u + c v, y is d + e u + f v [m], with u from 0 to 1 from
            left to right, and v from the top down.
        off_by: How far a place of the sheet lies from its true one at most [m]: earth is round.
    """

    sheet: Matrix
    off_by: float


def placed_picture(
    asked: Background, said: PicturePlace | None, size: tuple[int, int], origin: LatLon | None
) -> PlacedPicture:
    """Lay out a picture.

    Args:
        asked: What is asked for: corners go before what the file says.
        said: What the file says.
        size: Its pixels in a row, and its rows.
        origin: Latitude and longitude of the mission's 0, 0 [deg], if they are known.

    Raises:
        RefusedError: Nothing says where it lies, or that is nowhere.
    """
    uv = _places()
    if asked.corners is not None:
        grid, points = asked.grid, _between(asked, uv)
    elif said is not None:
        grid, points = said.grid or asked.grid, _by_matrix(said.matrix, uv * np.array(size))
    else:
        problem = "the picture doesn't say where it lies, and has no world file"
        raise RefusedError(f"{problem}: give its corners")
    return _fitted(uv, _local(grid, points, origin))


def _places() -> Floats:
    steps = np.linspace(0.0, 1.0, PLACES_A_SIDE)
    return np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)


def _between(asked: Background, uv: Floats) -> Floats:
    assert asked.corners is not None
    low, high = (np.array(corner) for corner in asked.corners)
    if asked.grid == DEGREES:  # latitude comes first in words, and last in x and y
        low, high = low[::-1], high[::-1]
    across = np.stack([uv[:, 0], 1.0 - uv[:, 1]], axis=1)
    return np.asarray(low + across * (high - low), np.float64)


def _by_matrix(matrix: Matrix, pixels: Floats) -> Floats:
    a, b, c, d, e, f = matrix
    column, row = pixels.T
    return np.stack([a + b * column + c * row, d + e * column + f * row], axis=1)


def _local(grid: str, points: Floats, origin: LatLon | None) -> Floats:
    """Places in a grid as metres of the mission."""
    if grid == METRES:
        if np.abs(points).max() > MAX_METRES:
            problem = "lies farther out than 10,000 km: are these metres of the mission?"
            raise RefusedError(f"the picture {problem} Say which grid they are of")
        return points
    if origin is None:
        problem = "the picture lies by latitude and longitude, and the mission has no origin"
        raise RefusedError(f"{problem}: give the latitude and longitude of its 0, 0")
    latitude, longitude = geodetic(grid, points)
    if np.abs(latitude).max() > 90 or np.abs(longitude).max() > 360:
        problem = f"latitudes to {np.abs(latitude).max():g}, longitudes"
        raise RefusedError(f"the picture has {problem} to {np.abs(longitude).max():g} degrees")
    frame = LocalFrame(*origin)
    away = max(frame.arc(*place) for place in zip(latitude, longitude, strict=True))
    if away > MAX_REACH_M:
        problem = f"the picture lies up to {away / 1e3:.0f} km from the mission's origin"
        raise RefusedError(f"{problem}, farther than the {MAX_REACH_M / 1e3:.0f} km of a flat map")
    return frame.to_local(latitude, longitude)


def _fitted(uv: Floats, places: Floats) -> PlacedPicture:
    """The sheet that is nearest to the places."""
    columns = np.column_stack([np.ones(len(uv)), uv])
    found = np.linalg.lstsq(columns, places, rcond=None)[0]
    off = float(np.hypot(*(columns @ found - places).T).max())
    (a, d), (b, e), (c, f) = found.tolist()
    if min(np.hypot(b, e), np.hypot(c, f)) < LEAST_SIZE_M:
        raise RefusedError("the picture would be less than a millimetre wide or high")
    return PlacedPicture((a, b, c, d, e, f), off)
