"""Corners of a way left out, or taken as one, where the curve through the rest is cheaper.

A taut way is the cheapest polyline, not the corners of the cheapest curve. It bends a little at
every edge of what it passes, each bend has half of the short way to the next one for its rounding,
and so the robot slows down for bends that a curve a little farther outside doesn't have.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.space.laying.fewer_corners import outside_of

MOST_AS_ONE: Final = 5
"""So many corners are taken as one, at most."""

MOST_TRIED: Final = 150
"""So many polylines are tried in place of one, at most."""

WIDEST: Final = 2.0
"""How far apart the first and the last of these may be, of the radius that is wanted."""

LEAST_GAIN: Final = 1e-3
"""Part of the cost that has to be gained."""

LEAST_SIDE: Final = 1e-6
"""Shorter sides, of all of a way, have no direction."""

Cost = Callable[[Floats], float]
"""What the curve costs that is laid through a polyline (n, d) [m]; infinite: it can't be."""


def sooner_corners(points: Floats, radius: float, cost: Cost) -> Floats:
    """A way with fewer corners, as long as that is cheaper.

    Args:
        points: Via point, corners and via point [m], (n, d).
        radius: Of curvature that is wanted at corners [m].
        cost: Of a way.

    Returns:
        [m], (m, d), m <= n; it begins and ends where the way does.

    >>> way = np.array([[0.0, 0], [50, 5], [52, 5], [100, 0]])
    >>> sooner_corners(way, 10.0, lambda points: float(len(points)))  # nothing has to be passed
    array([[  0.,   0.],
           [ 52.,   5.],
           [100.,   0.]])
    """
    if len(points) < 4:
        return points
    found, least = points, cost(points)
    tried = 0
    while True:
        sooner = None
        for other in with_fewer(found, radius):
            tried += 1
            price = cost(other)
            if price < (1.0 - LEAST_GAIN) * least:
                sooner, least = other, price
                break
            if tried >= MOST_TRIED:
                return found
        if sooner is None:
            return found
        found = sooner


def with_fewer(points: Floats, radius: float) -> Iterator[Floats]:
    """Polylines with one corner left out, then with several taken as one; with one at least.

    Args:
        points: Via point, corners and via point [m], (n, d).
        radius: Of curvature that is wanted at corners [m].
    """
    count = len(points) - 2
    for size in range(1, min(MOST_AS_ONE, count) + 1):
        for first in range(1, count - size + 2):
            last = first + size - 1
            for instead in _instead(points[first - 1 : last + 2], radius):
                found = np.concatenate((points[:first], instead, points[last + 1 :]))
                sides = np.linalg.norm(np.diff(found, axis=0), axis=1)
                if len(found) > 2 and sides.min() > LEAST_SIDE * sides.sum():
                    yield found


def _instead(points: Floats, radius: float) -> Iterator[Floats]:
    """What may stand in the place of the corners of a polyline [m], (k, d), k = 0 or 1."""
    first, last = points[1], points[-2]
    if len(points) == 3:
        yield points[:0]
    elif np.linalg.norm(last - first) <= WIDEST * radius:
        yield 0.5 * (first + last)[None]
        outside = outside_of(points, radius)
        if outside is not None:
            yield outside[None]
