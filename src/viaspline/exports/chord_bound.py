"""How far a curve gets from straight lines: bounds that are proven, by control polygons."""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats

_PIECES: Final = 4
"""Each span is cut into so many, whose control polygons are nearer to the curve."""


def chord_bound(spans: Floats, start: Floats, end: Floats) -> float:
    """An upper bound of the distance between a curve and a straight line [m], either way.

    No point of the curve is farther from the line than the bound, and no point of the line farther
    from the curve. A cubic stays in the hull of its control points, and the distance to a line is a
    convex function, so that the control points bound it; each span is cut into four before, which
    brings the bound within a few percent of the truth. The other way round, what of the line isn't
    opposite to the curve is as near to the curve's ends as the line's ends are.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).
        start: Where the line begins [m], shape (d,).
        end: Where it ends [m], shape (d,).

    Example:
        >>> arc = np.array([[[0, 0], [1, 1], [3, 1], [4, 0]]], float)  # 0.75 high
        >>> 0.75 <= chord_bound(arc, arc[0, 0], arc[0, 3]) < 0.78
        True
    """
    pieces = np.einsum("kij,mjd->mkid", _CUTS, spans).reshape(-1, spans.shape[2])
    along = end - start
    square = float(along @ along)
    offset = pieces - start
    if square > 0.0:
        part = np.clip(offset @ along / square, 0.0, 1.0)
        offset = offset - part[:, None] * along
    ends = (np.linalg.norm(spans[0, 0] - start), np.linalg.norm(spans[-1, 3] - end))
    return max(float(np.sqrt((offset * offset).sum(axis=1).max())), *map(float, ends))


def _cuts() -> Floats:
    """From the control points of a cubic to those of its pieces, shape (pieces, 4, 4)."""
    cuts = np.empty((_PIECES, 4, 4))
    for k in range(_PIECES):
        low, high = k / _PIECES, (k + 1) / _PIECES
        for i, at in enumerate(((low, low, low), (low, low, high), (low, high, high), (high,) * 3)):
            blossom = np.eye(4)
            for w in at:
                blossom = (1.0 - w) * blossom[:-1] + w * blossom[1:]
            cuts[k, i] = blossom[0]
    return cuts


_CUTS: Final = _cuts()
