r"""A polyline with its corners rounded: straight pieces, and two cubic spirals at each corner.

The curvature grows from 0 on the straight piece to the corner's middle and falls to 0 again, so the
curve is G2, and it is exact: cubic spans, nothing sampled.

Source: D. J. Walton and D. S. Meek, A planar cubic Bézier spiral (1996); K. Yang and S. Sukkarieh,
3D smooth path planning for a UAV in cluttered natural environments (IROS 2008), who give the pair
of spirals in closed form. Their constant 7.2364 is :math:`(1 + c_2)(4 + c_2)`, so that they meet.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.rounded_corners import rounded_corners


def rounded(points: Floats, reaches: Floats) -> Floats:
    """The spans of a polyline with rounded corners.

    Args:
        points: Its corners [m], shape (n, d), n >= 2, no two neighbours the same.
        reaches: How far before and after each inner corner its rounding begins and ends [m], shape
            (n - 2,); those of neighbours don't overlap. 0 leaves a corner as it is.

    Returns:
        Bézier control polygons [m], shape (m, 4, d), from the first point to the last.

    >>> corner = np.array([[0.0, 0, 0], [4, 0, 0], [4, 4, 0]])
    >>> spans = rounded(corner, np.array([2.0]))
    >>> spans.shape, spans[1, 3].round(3)
    ((4, 4, 3), array([3.547, 0.453, 0.   ]))
    """
    spans: Floats = rounded_corners(points, reaches)
    return spans


def straight_span(first: Floats, last: Floats) -> Floats:
    """The control polygon of a straight line between two places [m], (4, d)."""
    shares = np.array([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0])[:, None]
    line: Floats = (1.0 - shares) * first + shares * last
    line[3] = last
    return line
