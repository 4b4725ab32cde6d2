"""How far a curve gets from straight lines: bounds that are proven, by control polygons."""

from __future__ import annotations

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.chord_bounds import chord_bounds as bounds_of_parts
from viaspline.kernels.curve.chord_bounds import own_chord_bound


def chord_bounds(curve: PiecewiseCubic, u: Floats, points: Floats) -> Floats:
    """Upper bounds of the distance between parts of a curve and straight lines [m], either way.

    No point of a part is farther from its line than the bound, and no point of the line farther
    from the part. A cubic stays in the hull of its control points, and the distance to a line is a
    convex function, so that the control points bound it; each span is cut into four before, which
    brings the bound within a few percent of the truth. The other way round, what of the line isn't
    opposite to the part is as near to the part's ends as the line's ends are.

    Args:
        curve: The curve.
        u: Its parameters where parts begin and end, increasing, shape (n,).
        points: Where the lines do [m], shape (n, d).

    Returns:
        Shape (n - 1,).

    Example:
        >>> import numpy as np
        >>> arc = PiecewiseCubic([[(0, 0), (1, 1), (3, 1), (4, 0)]])  # 0.75 high
        >>> chord_bounds(arc, np.array([0.0, 1.0]), arc.evaluate([0, 1]))
        array([0.75])
    """
    return bounds_of_parts(curve.spans, u, points)


def chord_bound(curve: PiecewiseCubic, begin: float, end: float) -> float:
    """Such a bound of a part of a curve and the line between its ends [m].

    Args:
        curve: The curve.
        begin: The parameter where the part begins.
        end: Where it ends, after that.
    """
    return own_chord_bound(curve.spans, begin, end)
