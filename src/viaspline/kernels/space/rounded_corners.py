"""The spans of a polyline whose corners are rounded by two cubic spirals each.

The formulas are those of ``space/laying/corner_rounding``.

Tested through ``space/laying/test_corner_rounding``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.space.corner_polygon import C2, C3, STRAIGHT, side_length, turn_at

SAME = 1e-9  # of a side and a metre: what is no longer is no straight piece,
ABSORBED = 1e-3  # nor what is no longer than that of the reach beside it, which begins there then


@kernel
def rounded_corners(points: Floats, reaches: Floats) -> Floats:
    """The spans of a polyline with rounded corners.

    Args:
        points: Its corners [m], (n, d), n >= 2, no two neighbours the same.
        reaches: How far before and after each inner corner its rounding begins and ends [m],
            (n - 2,); 0 leaves a corner as it is.

    Returns:
        Bézier control polygons [m], (m, 4, d).
    """
    count, axes = points.shape
    spans = np.empty((3 * count, 4, axes))
    made = 0
    here = points[0].copy()
    beside = 0.0
    for k in range(1, count - 1):
        turn, reach = turn_at(points, k), reaches[k - 1]
        if turn <= STRAIGHT:
            continue
        if reach <= 0.0:
            made = _straight(spans, made, here, points[k])
            beside = 0.0
            continue
        _spirals(spans, made, points, k, reach, turn)
        gap = 0.0
        for axis in range(axes):
            gap += (spans[made, 0, axis] - here[axis]) ** 2
        if math.sqrt(gap) > max(SAME * (1.0 + side_length(points, k - 1)), ABSORBED * reach):
            _spirals(spans, made + 1, points, k, reach, turn)
            begins = spans[made + 1, 0].copy()
            made = _straight(spans, made, here, begins)
        else:
            for axis in range(axes):
                spans[made, 0, axis] = here[axis]
        made += 2
        beside = reach
        for axis in range(axes):
            here[axis] = spans[made - 1, 3, axis]
    gap = 0.0
    for axis in range(axes):
        gap += (points[count - 1, axis] - here[axis]) ** 2
    least = max(SAME * (1.0 + side_length(points, count - 2)), ABSORBED * beside)
    if math.sqrt(gap) > least or made == 0:
        made = _straight(spans, made, here, points[count - 1])
    else:
        for axis in range(axes):
            spans[made - 1, 3, axis] = points[count - 1, axis]
    return spans[:made].copy()


@inner
def _straight(spans: Floats, made: int, here: Floats, to: Floats) -> int:
    """Writes a straight span up to a place, which is where it goes on from; how many there are."""
    for axis in range(len(here)):
        spans[made, 0, axis] = here[axis]
        spans[made, 1, axis] = 2.0 / 3.0 * here[axis] + 1.0 / 3.0 * to[axis]
        spans[made, 2, axis] = 1.0 / 3.0 * here[axis] + 2.0 / 3.0 * to[axis]
        spans[made, 3, axis] = to[axis]
        here[axis] = to[axis]
    return made + 1


@inner
def _spirals(spans: Floats, at: int, points: Floats, k: int, reach: float, turn: float) -> None:
    """Writes the two cubics of a corner."""
    inner_part, outer_part = C3 * reach, C2 * C3 * reach
    half = 6.0 * C3 * math.cos(0.5 * turn) / (C2 + 4.0) * reach
    before, after = side_length(points, k - 1), side_length(points, k)
    size = 0.0
    for axis in range(points.shape[1]):
        back = (points[k - 1, axis] - points[k, axis]) / before
        on = (points[k + 1, axis] - points[k, axis]) / after
        size += (on - back) ** 2
    size = math.sqrt(size)
    for axis in range(points.shape[1]):
        corner = points[k, axis]
        back = (points[k - 1, axis] - corner) / before
        on = (points[k + 1, axis] - corner) / after
        over = half * (on - back) / size
        spans[at, 0, axis] = corner + back * reach
        spans[at, 1, axis] = corner + back * (reach - outer_part)
        spans[at, 2, axis] = corner + back * (reach - outer_part - inner_part)
        spans[at + 1, 1, axis] = corner + on * (reach - outer_part - inner_part)
        spans[at + 1, 2, axis] = corner + on * (reach - outer_part)
        spans[at + 1, 3, axis] = corner + on * reach
        middle = 0.5 * (spans[at, 2, axis] + over + spans[at + 1, 1, axis] - over)
        spans[at, 3, axis] = middle
        spans[at + 1, 0, axis] = middle
