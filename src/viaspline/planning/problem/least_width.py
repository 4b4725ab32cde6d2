"""How narrow a convex body is at its narrowest.

Tested through ``planning/problem/test_requirements``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def least_width(corners: Sequence[tuple[float, float]]) -> float:
    """The distance of the two nearest parallel lines between which a convex polygon lies [m].

    One of them lies along an edge. Of a polygon that isn't convex none is told: 0.

    Args:
        corners: In order [m], each (2,).

    >>> least_width([(-1, -0.8), (3, -0.8), (3, 0.8), (-1, 0.8)])
    1.6
    >>> least_width([(0, 0), (2, 0), (1, 0.5), (0, 2)])
    0.0
    """
    ring = np.array(corners, np.float64)
    edges = np.roll(ring, -1, axis=0) - ring
    edges /= np.linalg.norm(edges, axis=1)[:, None]
    away = ring[:, None] - ring  # corners, edges
    beside = edges[:, 0] * away[..., 1] - edges[:, 1] * away[..., 0]
    beside *= np.sign(beside.sum(axis=0))  # to the side where most of it lies
    if (beside.min(axis=0) < -1e-9 * np.abs(beside).max()).any():
        return 0.0
    return float(beside.max(axis=0).min())
