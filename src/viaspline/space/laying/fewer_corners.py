"""Corners that stand close together, taken as fewer: there is room for a gentler turn then.

A taut way bends a little at every edge of what it passes. Each of these bends has only half of the
short way to the next one for its rounding, and so is sharp, however little it turns.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from viaspline.kernels.arrays import Floats

MOST: int = 5
"""So many corners are taken as one, at most."""

WIDEST = 8.0
"""How far apart the first and the last of them may be, of the radius that is wanted."""

STRAIGHT = 1e-9
"""What turns by less has no outside."""


def fewer_corners(points: Floats, corner: int, radius: float) -> Iterator[tuple[int, int, Floats]]:
    """Ways to have fewer corners about one of a polyline.

    Several are replaced by one that lies as far outside as an arc through it has to begin for the
    outermost of them to be inside of it; then one corner is left out.

    Args:
        points: Via point, corners and via point [m], (n, d).
        corner: Which of the points, 1 to n - 2.
        radius: That is wanted [m].

    Yields:
        (first, last, instead): the corners from the first to the last one, and what stands in
        their place [m], (k, d), k = 0 or 1.

    >>> way = np.array([[0.0, 0], [9.9, 0], [10, 0.1], [10, 10]])
    >>> [(first, last) for first, last, _ in fewer_corners(way, 1, 1.0)]
    [(1, 2), (1, 1)]
    """
    count = len(points) - 2
    for size in range(2, min(MOST, count) + 1):
        for first in range(max(1, corner - size + 1), min(corner, count - size + 1) + 1):
            last = first + size - 1
            if np.linalg.norm(points[last] - points[first]) > WIDEST * radius:
                continue
            instead = outside_of(points[first - 1 : last + 2], radius)
            if instead is not None:
                yield first, last, instead[None]
    yield corner, corner, points[:0]


def outside_of(points: Floats, radius: float) -> Floats | None:
    """The place of one corner for those between the ends of a polyline; None: it is straight."""
    inner = points[1:-1]
    before, after = inner[0] - points[0], points[-1] - inner[-1]
    out = before / np.linalg.norm(before) - after / np.linalg.norm(after)
    size = float(np.linalg.norm(out))
    if size < STRAIGHT:
        return None
    out /= size
    middle = 0.5 * (inner[0] + inner[-1])
    half = 0.5 * float(np.linalg.norm(inner[-1] - inner[0]))
    beyond = float(((inner - middle) @ out).max()) + 0.5 * half * half / radius
    return np.asarray(middle + beyond * out)
