"""How often a closed line winds round points."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.jit import kernel
from viaspline.kernels.packed import Floats, Ints


@kernel
def windings(ring: Floats, points: Floats) -> Ints:
    """How often a ring of corners (m, 2) winds anticlockwise round each of some points (n, 2).

    The last corner is joined to the first. Points on the ring itself count either way.
    """
    turns = np.zeros(points.shape[0], np.int64)
    last = ring.shape[0] - 1
    for k in range(points.shape[0]):
        x = points[k, 0]
        y = points[k, 1]
        ax = ring[last, 0]
        ay = ring[last, 1]
        for corner in range(ring.shape[0]):
            bx = ring[corner, 0]
            by = ring[corner, 1]
            if (ay > y) != (by > y):
                left = (bx - ax) * (y - ay) - (x - ax) * (by - ay)
                if by > ay and left > 0.0:
                    turns[k] += 1
                elif by < ay and left < 0.0:
                    turns[k] -= 1
            ax = bx
            ay = by
    return turns
