"""Which resting places a curve comes too near to, by true bounds of the curve."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.clearance.disc import conflicts
from viaspline.world.pack import pack_discs


def rests_met(spans: Floats, rests: Floats, reach: float) -> Flags:
    """Which resting places a curve comes nearer to than both reaches together.

    Args:
        spans: Bézier control polygons of the curve [m], (m, 4, d).
        rests: x, y and reach of each place [m], (n, 3).
        reach: Of the robot that drives the curve [m].

    Returns:
        (n,).

    Example:
        >>> line = np.array([[[0.0, 0.0], [3.0, 0.0], [6.0, 0.0], [9.0, 0.0]]])
        >>> rests_met(line, np.array([[4.0, 1.9, 1.0], [6.0, -2.1, 1.0]]), 1.0).tolist()
        [True, False]
    """
    met = np.zeros(len(rests), np.bool_)
    left = np.arange(len(rests))
    curve = np.ascontiguousarray(spans)
    writable = curve if curve.flags.writeable else curve.copy()  # numba compiles for one kind
    while left.size:  # a span names one place that it comes too near to
        found = conflicts(pack_discs(rests[left]), writable, reach)[0]
        hit = np.unique(found[found >= 0])
        if not hit.size:
            break
        met[left[hit]] = True
        left = np.delete(left, hit)
    return met
