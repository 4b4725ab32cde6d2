"""Where a run of spans is nearest to the world, as far as samples tell, and which way off it is."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld

U, X, Y, GAP, ALONG_X, ALONG_Y, OFF_X, OFF_Y = range(8)
"""What is told of a place: its parameter, where it is [m], its distance to the world [m], the
direction of the curve there, and that in which the distance grows (unit vectors)."""


@inner
def _unit(x: float, y: float) -> tuple[float, float]:
    """A direction as a unit vector; along x where there is none."""
    size = math.hypot(x, y)
    return (x / size, y / size) if size > 0.0 else (1.0, 0.0)


@kernel
def tight_place(world: PackedWorld, spans: Floats, samples: int, step: float) -> Floats:
    """The nearest of some places on a run of spans; of several the first.

    Args:
        world: PackedWorld.
        spans: Bézier control polygons [m], (m, 4, 2).
        samples: How many for each span, evenly spaced, with both ends of the run.
        step: Of the gradient of the distance [m].

    Returns:
        See the columns above, (8,).
    """
    count = samples * spans.shape[0]
    found = np.zeros(8)
    found[GAP] = np.inf
    for i in range(count):
        u = spans.shape[0] * i / (count - 1)
        k = min(int(u), spans.shape[0] - 1)
        t, s, span = u - k, 1.0 - (u - k), spans[k]
        b0, b1, b2, b3 = s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t
        x = b0 * span[0, 0] + b1 * span[1, 0] + b2 * span[2, 0] + b3 * span[3, 0]
        y = b0 * span[0, 1] + b1 * span[1, 1] + b2 * span[2, 1] + b3 * span[3, 1]
        gap, _ = nearest(world, x, y, found[GAP])
        if gap < found[GAP] or i == 0:
            found[U], found[X], found[Y], found[GAP] = u, x, y, gap
    k = min(int(found[U]), spans.shape[0] - 1)
    t, s, span = found[U] - k, 1.0 - (found[U] - k), spans[k]
    found[ALONG_X], found[ALONG_Y] = _unit(
        s * s * (span[1, 0] - span[0, 0]) + 2.0 * s * t * (span[2, 0] - span[1, 0])
        + t * t * (span[3, 0] - span[2, 0]),
        s * s * (span[1, 1] - span[0, 1]) + 2.0 * s * t * (span[2, 1] - span[1, 1])
        + t * t * (span[3, 1] - span[2, 1]),
    )  # fmt: skip
    x, y = found[X], found[Y]
    found[OFF_X], found[OFF_Y] = _unit(
        nearest(world, x + step, y, np.inf)[0] - nearest(world, x - step, y, np.inf)[0],
        nearest(world, x, y + step, np.inf)[0] - nearest(world, x, y - step, np.inf)[0],
    )
    return found
