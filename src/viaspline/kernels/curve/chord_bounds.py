"""How far parts of a curve get from straight lines, by the control polygons of their pieces.

Tested through ``exports/test_chord_bound``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cubic import subspan
from viaspline.kernels.jit import inner, kernel

PIECES = 4
"""Each span is cut into so many, whose control polygons are nearer to the curve."""


@kernel
def chord_bounds(spans: Floats, u: Floats, points: Floats) -> Floats:
    """Upper bounds of the distance between parts of a curve and lines, either way [m], (n - 1,).

    Args:
        spans: Bézier control polygons [m], (m, 4, d).
        u: Parameters where the parts begin and end, increasing, (n,).
        points: Where the lines do [m], (n, d).
    """
    found = np.empty(u.size - 1)
    for k in range(found.size):
        found[k] = _bound(spans, u[k], u[k + 1], points[k], points[k + 1])
    return found


@kernel
def own_chord_bound(spans: Floats, begin: float, end: float) -> float:
    """An upper bound of the distance between a part of a curve and the line between its ends [m].

    Args:
        spans: (m, 4, d).
        begin: Where the part begins.
        end: Where it ends, after that.
    """
    first, last = int(begin), math.ceil(end) - 1
    one, other = np.empty(spans.shape[1:]), np.empty(spans.shape[1:])
    subspan(spans[first], begin - first, 1.0, one)
    subspan(spans[last], 0.0, end - last, other)
    return _bound(spans, begin, end, one[0], other[3])


@inner
def _bound(spans: Floats, begin: float, end: float, start: Floats, stop: Floats) -> float:
    """Of one part, from one parameter to another, and the line from start to stop."""
    first, last = int(begin), math.ceil(end) - 1
    piece = np.empty(spans.shape[1:])
    farthest = 0.0
    for span in range(first, last + 1):
        low, high = max(begin - span, 0.0), min(end - span, 1.0)
        for k in range(PIECES):
            a = low + (high - low) * k / PIECES
            b = high if k == PIECES - 1 else low + (high - low) * (k + 1) / PIECES
            subspan(spans[span], a, b, piece)
            for j in range(4):
                farthest = max(farthest, _square_from(start, stop, piece[j]))
            if span == first and k == 0:
                farthest = max(farthest, _square_from(start, start, piece[0]))
            if span == last and k == PIECES - 1:
                farthest = max(farthest, _square_from(stop, stop, piece[3]))
    return math.sqrt(farthest)


@inner
def _square_from(start: Floats, stop: Floats, place: Floats) -> float:
    """The squared distance of a place from a line, which may be a point [m²]."""
    square = 0.0
    along = 0.0
    for axis in range(start.size):
        way = stop[axis] - start[axis]
        square += way * way
        along += (place[axis] - start[axis]) * way
    part = min(max(along / square, 0.0), 1.0) if square > 0.0 else 0.0
    found = 0.0
    for axis in range(start.size):
        off = place[axis] - start[axis] - part * (stop[axis] - start[axis])
        found += off * off
    return found
