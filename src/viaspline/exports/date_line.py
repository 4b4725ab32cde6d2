"""Lines across the meridian of 180°, cut there.

RFC 7946 asks for that, so that no reader draws them round the earth.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.exports.path_table import DIGITS_DEG
from viaspline.formats.local_frame import LocalFrame
from viaspline.kernels.arrays import Floats, Ints

FAR_DEG = 180.0
HALVINGS = 60
"""How often a chord is halved about its crossing: down to rounding."""


class GeoCorners(NamedTuple):
    """Corners of lines along a path.

    Attributes:
        parameters: Of the places of the path that they stand for, (n,).
        points: [m], (n, 2) or (n, 3).
        degrees: Their latitudes and longitudes [deg], (n, 2).
    """

    parameters: Floats
    points: Floats
    degrees: Floats


def with_crossings(corners: GeoCorners, path: PiecewiseCubic, frame: LocalFrame) -> GeoCorners:
    """Corners, and one more wherever a line crosses the meridian of 180°, at longitude 180.

    Args:
        corners: Of the lines.
        path: The path that they stand for. The new corner stands for where that crosses.
        frame: Of their points.
    """
    u, points, degrees = corners
    longitudes = degrees[:, 1]
    far = np.abs(longitudes) == FAR_DEG
    wide = np.abs(np.diff(longitudes)) > FAR_DEG
    for k in np.flatnonzero(wide & ~far[:-1] & ~far[1:])[::-1].tolist():
        is_east = float(longitudes[k]) > 0.0
        point = _between(points[k], points[k + 1], is_east, frame)
        between = _between_on(path, float(u[k]), float(u[k + 1]), is_east, frame)
        latitude = round(float(frame.to_geodetic(point[:2])[0]), DIGITS_DEG)
        point[:2] = frame.to_local(latitude, FAR_DEG)
        u = np.insert(u, k + 1, between)
        points = np.insert(points, k + 1, point, axis=0)
        degrees = np.insert(degrees, k + 1, (latitude, FAR_DEG), axis=0)
    return GeoCorners(u, points, degrees)


def _between(first: Floats, last: Floats, is_east: bool, frame: LocalFrame) -> Floats:
    """Where the line from one place to another crosses [m]."""
    share = _crossing(lambda w: first + w * (last - first), is_east, frame)
    place: Floats = first + share * (last - first)
    return place


def _between_on(
    path: PiecewiseCubic, first: float, last: float, is_east: bool, frame: LocalFrame
) -> float:
    """The parameter between two of a path at which that crosses."""
    share = _crossing(lambda w: path.evaluate(first + w * (last - first)), is_east, frame)
    return first + share * (last - first)


def _crossing(at: Callable[[float], Floats], is_east: bool, frame: LocalFrame) -> float:
    """The share of a line at which it crosses the meridian of 180°.

    Args:
        at: Its places by their shares [m], (2,) or (3,).
        is_east: Whether it begins at eastern longitudes.
        frame: Of these places.
    """
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if (float(frame.to_geodetic(at(middle)[:2])[1]) > 0.0) == is_east:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def sides_of_180(longitudes: Floats) -> list[tuple[Ints, Floats]]:
    """The parts of a line on either side of 180°: which corners, and their longitudes [deg].

    A corner at 180° where the line changes sides ends one part and begins the next.

    Args:
        longitudes: Of the corners, with one at ±180 wherever a line crosses that [deg], (n,).

    >>> [(k.tolist(), at.tolist()) for k, at in sides_of_180(np.array([179.0, 180.0, -179.0]))]
    [([0, 1], [179.0, 180.0]), ([1, 2], [-180.0, -179.0])]
    """
    far = np.abs(longitudes) == FAR_DEG
    sides = np.where(far, 0.0, np.where(longitudes < 0.0, -1.0, 1.0))
    edges, before = [0], 0.0
    for k, side in enumerate(sides.tolist()):
        if side == -before != 0.0 and far[k - 1]:
            edges.append(k - 1)
        before = side or before
    parts = []
    for first, last in zip(edges, [*edges[1:], len(sides) - 1], strict=True):
        kept = np.arange(first, last + 1)
        side = -1.0 if (sides[kept] < 0.0).any() else 1.0
        parts.append((kept, np.where(far[kept], side * FAR_DEG, longitudes[kept])))
    return [part for part in parts if len(part[0]) > 1] or parts[:1]
