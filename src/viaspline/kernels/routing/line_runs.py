"""Where a straight line comes too close to something.

Tested through ``planning/routing/test_blocked_runs``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.growable import sized_floats
from viaspline.kernels.jit import kernel
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld

MAX_HALVINGS = 60  # beyond which a piece has no length left


@kernel
def line_runs(
    world: PackedWorld, start: Floats, along: Floats, length: float, required: float, finest: float
) -> Floats:
    """The pieces of a line that come nearer to something than is required.

    Args:
        world: What to keep clear of.
        start: Where the line begins [m], (2,).
        along: Its direction, (2,).
        length: [m], more than 0.
        required: Distance to keep [m].
        finest: Length of a piece that is not looked into any further [m].

    Returns:
        Distances from its start between which it is blocked [m], (k, 2), in order.
    """
    open_ends = np.empty(MAX_HALVINGS + 1)  # of the pieces after this one, the next one last
    runs = np.empty((4, 2))
    found, depth, low = 0, 1, 0.0
    open_ends[0] = length
    while depth > 0:
        high = open_ends[depth - 1]
        half, middle = 0.5 * (high - low), 0.5 * (high + low)
        x, y = start[0] + middle * along[0], start[1] + middle * along[1]
        room = nearest(world, x, y, required + 2.0 * half)[0] - required
        if -half <= room < half and 2.0 * half > finest and depth <= MAX_HALVINGS:
            open_ends[depth] = middle
            depth += 1
            continue
        if room < half:
            if found > 0 and runs[found - 1, 1] >= low:
                runs[found - 1, 1] = high
            else:
                if found == runs.shape[0]:
                    runs = sized_floats(runs, found, 2 * found)
                runs[found, 0], runs[found, 1] = low, high
                found += 1
        low = high
        depth -= 1
    return sized_floats(runs, found, found)
