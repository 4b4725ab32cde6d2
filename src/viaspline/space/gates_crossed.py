"""On which sides of things a curve passes, exactly: where it crosses their gates.

See ``space/routing/pass_gates`` for what a gate is. The crossings of a cubic span are the roots of
a cubic polynomial, so none is missed between samples.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.routing.side_gates import (
    AHEAD_X,
    AHEAD_Y,
    ALLOWED,
    GATE_X,
    GATE_Y,
    LEAST,
    LEFT,
    MIDDLE_Z,
    MOST,
    OVER,
    RIGHT,
    UNDER,
)

_NEAR_REAL = 1e-7


def crossings(spans: Floats, gate: Floats) -> Iterator[Floats]:
    """The places at which a curve goes through the plane of a gate.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, 3).
        gate: One row, (8,).

    >>> line = np.array([[[0.0, 1, 5], [1, 1, 5], [2, 1, 5], [3, 1, 5]]])
    >>> [place.round(6).tolist() for place in crossings(line, np.array([2.0, 0, 1, 0, 0, 0, 0, 1]))]
    [[2.0, 1.0, 5.0]]
    """
    ahead = gate[[AHEAD_X, AHEAD_Y]]
    before = (spans[:, :, :2] - gate[[GATE_X, GATE_Y]]) @ ahead
    for k in np.flatnonzero((before.min(axis=1) <= 0.0) & (before.max(axis=1) >= 0.0)).tolist():
        a, b, c, d = before[k].tolist()
        powers = np.array([d - 3 * c + 3 * b - a, 3 * (c - 2 * b + a), 3 * (b - a), a])
        roots = np.roots(powers)
        real = roots[np.abs(roots.imag) <= _NEAR_REAL].real if len(roots) else np.empty(0)
        for w in real[(real >= -_NEAR_REAL) & (real <= 1.0 + _NEAR_REAL)].tolist():
            u = 1.0 - w
            weights = np.array([u**3, 3 * u * u * w, 3 * u * w * w, w**3])
            yield weights @ spans[k]


def straight_crossings(places: Floats, gate: Floats) -> Iterator[Floats]:
    """The places at which straight lines go through the plane of a gate.

    Args:
        places: From each of these to the next one [m], (n, 3).
        gate: One row, (8,).

    >>> line = np.array([[0.0, 1, 5], [3, 1, 5]])
    >>> [at.tolist() for at in straight_crossings(line, np.array([2.0, 0, 1, 0, 0, 0, 0, 1]))]
    [[2.0, 1.0, 5.0]]
    """
    before = (places[:, :2] - gate[[GATE_X, GATE_Y]]) @ gate[[AHEAD_X, AHEAD_Y]]
    low, high = np.minimum(before[:-1], before[1:]), np.maximum(before[:-1], before[1:])
    for k in np.flatnonzero((low <= 0.0) & (high >= 0.0) & (low < high)).tolist():
        share = before[k] / (before[k] - before[k + 1])
        yield places[k] + share * (places[k + 1] - places[k])


def side_of(gate: Floats, place: Floats) -> int:
    """The side (a bit) of a gate on which a place of its plane lies."""
    left = gate[AHEAD_X] * (place[1] - gate[GATE_Y]) - gate[AHEAD_Y] * (place[0] - gate[GATE_X])
    if left > gate[MOST]:
        return LEFT
    if left < gate[LEAST]:
        return RIGHT
    return OVER if place[2] > gate[MIDDLE_Z] else UNDER


def wrong_side(spans: Floats, gates: Floats) -> Floats | None:
    """Where a curve passes something on a side that isn't allowed [m], (3,); None: nowhere.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, 3).
        gates: Of what it has to pass, (g, 8).
    """
    for gate in gates:
        for place in crossings(spans, gate):
            if not side_of(gate, place) & int(gate[ALLOWED]):
                return place
    return None
