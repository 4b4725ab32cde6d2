"""Which of many segments keep their distance to a world.

Tested through ``fleet/lattice_order/test_cell_lattice``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.jit import kernel
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.segment import nearest_to_segment


@kernel
def clear_segments(world: PackedWorld, segments: Floats, kept: float) -> Flags:
    """Which segments are so far from everything.

    Args:
        world: PackedWorld.
        segments: Where they begin and end [m], (m, 4).
        kept: [m].

    Returns:
        (m,).
    """
    found = np.empty(segments.shape[0], np.bool_)
    for k in range(segments.shape[0]):
        distance, _ = nearest_to_segment(
            world, segments[k, 0], segments[k, 1], segments[k, 2], segments[k, 3], kept
        )
        found[k] = distance >= kept
    return found
