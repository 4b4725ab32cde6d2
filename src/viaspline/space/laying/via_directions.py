"""The direction of the curve at via points where a leg that is led round something ends."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.kernels.arrays import Floats

Inner = Floats | None
"""The detour via points of a leg [m], (k, d); None: it is left to the spline."""


def via_directions(vias: Floats, inner: Sequence[Inner], given: Floats) -> Floats:
    """Directions at the via points that end or begin a leg that isn't left to the spline.

    That of the cardinal spline through the neighbours, detour via points included: of the parabola
    through three points with chordal knots, :math:`h_1 d_0 + h_0 d_1`, but never against the way
    there or on. At an end of the route, and where the way turns right back, it is free.

    Args:
        vias: The via points [m], shape (n, d).
        inner: Of each leg, n - 1.
        given: Directions that are fixed, shape (n, d), NaN where none is.

    Returns:
        Unit vectors, shape (n, d); NaN where the direction is free or the spline's own.

    >>> corner = np.array([[0.0, 0], [4, 0], [4, 4]])
    >>> via_directions(corner, [np.empty((0, 2)), None], np.full((3, 2), np.nan)).round(3)
    array([[  nan,   nan],
           [0.707, 0.707],
           [  nan,   nan]])
    """
    ways = given.copy()
    for k in range(1, len(vias) - 1):
        before, after = inner[k - 1], inner[k]
        if (before is None and after is None) or not np.isnan(given[k]).any():
            continue
        back = vias[k] - (vias[k - 1] if before is None or not len(before) else before[-1])
        on = (vias[k + 1] if after is None or not len(after) else after[0]) - vias[k]
        ways[k] = _parabolic(back, on)
    return ways


def _parabolic(back: Floats, on: Floats) -> Floats:
    """The direction in the middle of three points from the ways to it and from it.

    Where the way nearly goes back, that of the parabola is against the longer one of both: the
    curve would run past the middle and come back to it. It is square to that at most.
    """
    h0, h1 = float(np.linalg.norm(back)), float(np.linalg.norm(on))
    if h0 == 0.0 or h1 == 0.0:
        return np.full_like(back, np.nan)
    cosine = float(back @ on) / (h0 * h1)
    first = max(h1, -cosine * h0)
    last = max(h0, -cosine * h1)
    way = first * back / h0 + last * on / h1
    size = np.linalg.norm(way)
    if size <= 1e-6 * (h0 + h1):
        return np.full_like(back, np.nan)
    return np.asarray(way / size)
