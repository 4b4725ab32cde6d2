"""Length, bending and largest curvature of Bézier spans, for comparing candidates.

Tested through ``kernels/world/test_distance``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, kernel

CURVATURE_SAMPLES = 32  # of curvature on a span
LENGTH_RULES = 4  # Gauss-Legendre rules of five points on a span
NODES, WEIGHTS = np.polynomial.legendre.leggauss(5)


@kernel
def length_and_curvature(spans: Floats) -> tuple[float, float]:
    """Length [m], to about 1e-7 of it, and largest sampled plane curvature [1/m] of (m, 4, d)."""
    dimension = spans.shape[2]
    length = 0.0
    sharpest = 0.0
    for span in range(spans.shape[0]):
        for part in range(LENGTH_RULES):
            for node in range(NODES.size):
                w = (part + 0.5 * (1.0 + NODES[node])) / LENGTH_RULES
                squared = 0.0
                for axis in range(dimension):
                    a = spans[span, 1, axis] - spans[span, 0, axis]
                    b = spans[span, 2, axis] - spans[span, 1, axis]
                    c = spans[span, 3, axis] - spans[span, 2, axis]
                    slope = 3.0 * ((1 - w) * ((1 - w) * a + 2 * w * b) + w * w * c)
                    squared += slope * slope
                length += 0.5 / LENGTH_RULES * WEIGHTS[node] * math.sqrt(squared)
        for k in range(CURVATURE_SAMPLES + 1):
            sharpest = max(sharpest, _curvature(spans, span, k / CURVATURE_SAMPLES))
    return length, sharpest


@kernel
def bending(spans: Floats) -> tuple[float, float]:
    """How much spans bend in the plane.

    Args:
        spans: Bézier control polygons [m], (m, 4, d).

    Returns:
        The integral of the squared curvature [1/m], and the largest curvature of a few samples of
        each span [1/m].
    """
    total, sharpest = 0.0, 0.0
    for span in range(spans.shape[0]):
        for node in range(NODES.size):
            w = 0.5 * (1.0 + NODES[node])
            slope = 0.0
            for axis in range(2):
                a = spans[span, 1, axis] - spans[span, 0, axis]
                b = spans[span, 2, axis] - spans[span, 1, axis]
                c = spans[span, 3, axis] - spans[span, 2, axis]
                slope += (3.0 * ((1 - w) * ((1 - w) * a + 2 * w * b) + w * w * c)) ** 2
            curvature = _curvature(spans, span, w)
            total += 0.5 * WEIGHTS[node] * curvature * curvature * math.sqrt(slope)
            sharpest = max(sharpest, curvature)
        sharpest = max(sharpest, _curvature(spans, span, 0.0), _curvature(spans, span, 1.0))
    return total, sharpest


@inlined
def _curvature(spans: Floats, span: int, w: float) -> float:
    ax = spans[span, 1, 0] - spans[span, 0, 0]
    ay = spans[span, 1, 1] - spans[span, 0, 1]
    bx = spans[span, 2, 0] - spans[span, 1, 0]
    by = spans[span, 2, 1] - spans[span, 1, 1]
    cx = spans[span, 3, 0] - spans[span, 2, 0]
    cy = spans[span, 3, 1] - spans[span, 2, 1]
    vx = (1 - w) * ((1 - w) * ax + 2 * w * bx) + w * w * cx
    vy = (1 - w) * ((1 - w) * ay + 2 * w * by) + w * w * cy
    dx = (1 - w) * (bx - ax) + w * (cx - bx)
    dy = (1 - w) * (by - ay) + w * (cy - by)
    squared = vx * vx + vy * vy
    if squared <= 1e-24:
        return 0.0
    # P' = 3 v and P'' = 6 d
    return abs(vx * dy - vy * dx) * 2.0 / (3.0 * squared * math.sqrt(squared))
