"""In which heights a place may be: limits of height, and of height above ground."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.jit import uncounted
from viaspline.kernels.space.ground_pyramid import ground_height
from viaspline.kernels.space.packed_space import PackedSpace


@uncounted
def heights_allowed(space: PackedSpace, x: float, y: float) -> tuple[float, float]:
    """Least and greatest height that a place over (x, y) may have [m].

    Over ground that isn't known they are inf and -inf if it blocks and a limit is one above it.
    """
    limits = space.height_limits
    low, high = limits[0], limits[1]
    if limits[2] == -np.inf and limits[3] == np.inf:
        return low, high
    ground = ground_height(space, x, y)
    if math.isnan(ground):
        if space.ground_frame[4] == np.inf:
            return np.inf, -np.inf
        return low, high
    return max(low, ground + limits[2]), min(high, ground + limits[3])
