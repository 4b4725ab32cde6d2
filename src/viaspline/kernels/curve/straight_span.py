"""Whether a span is a straight line that is never driven backwards.

On one, the parameter may stand still (P' = (w - a)² ahead) where the robot need not.

Tested through ``machine/test_drivability`` and ``kernels/timing/test_cut_cells``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined


@inlined
def span_rounding(spans: Floats, i: int) -> float:
    """What rounding does to the derivative of a span [m]; -1 where the span is a single point."""
    largest, longest = 0.0, 0.0
    for j in range(spans.shape[2]):
        for k in range(4):
            largest = max(largest, abs(spans[i, k, j]))
            if k < 3:
                longest = max(longest, abs(3.0 * (spans[i, k + 1, j] - spans[i, k, j])))
    return 2.0**-46 * (largest + longest) if longest > 0.0 else -1.0


@inlined
def _along(spans: Floats, i: int, k: int, chord: float) -> float:
    """How far a step between control points leads along the chord of its span [m]."""
    along = 0.0
    for j in range(spans.shape[2]):
        along += (spans[i, k + 1, j] - spans[i, k, j]) * (spans[i, 3, j] - spans[i, 0, j])
    return along / chord


@inlined
def runs_straight(spans: Floats, i: int, noise: float) -> bool:
    """Whether a span runs straight ahead and never back, though it may stand still on the way."""
    square = 0.0
    for j in range(spans.shape[2]):
        square += (spans[i, 3, j] - spans[i, 0, j]) ** 2
    if square <= 0.0:
        return False
    chord = np.sqrt(square)
    along, across = 0.0, 0.0
    for k in range(2):
        along += _along(spans, i, k, chord)
        for j in range(spans.shape[2]):
            ideal = along / chord * (spans[i, 3, j] - spans[i, 0, j])
            across = max(across, abs(spans[i, k + 1, j] - spans[i, 0, j] - ideal))
    if across > noise:
        return False
    first, middle = _along(spans, i, 0, chord), _along(spans, i, 1, chord)
    last = _along(spans, i, 2, chord)
    if min(first, last) < -noise:
        return False
    return middle >= -np.sqrt(max(first, 0.0) * max(last, 0.0)) - noise
