"""Range measurements: where beams from one place first meet a surface of a packed world.

Every obstacle within reach is projected onto the beams that can hit it, so the cost is that of the
obstacles in sight and not of beams times obstacles. Bounds and fences are lines on a map: beams
don't see them.

Tested through ``robot/perception/test_lidar``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import kernel
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.plane import box_signed
from viaspline.kernels.world.shape import cast_obstacle


@kernel
def cast(
    world: PackedWorld, x: float, y: float, first: float, step: float, beams: int, reach: float
) -> Floats:
    """Distance from (x, y) to the first surface along each of some beams.

    Args:
        world: PackedWorld.
        x: Of the sensor [m].
        y: Of the sensor [m].
        first: Direction of beam 0, anticlockwise from x [rad].
        step: From each beam to the next, above 0 [rad].
        beams: How many there are; they span a full turn at most.
        reach: The length of a beam [m].

    Returns:
        (beams,) [m]; infinite where nothing is within reach.
    """
    rays = np.empty((beams, 2))
    for beam in range(beams):
        rays[beam, 0] = math.cos(first + beam * step)
        rays[beam, 1] = math.sin(first + beam * step)
    ranges = np.full(beams, reach)
    node = 0
    while node < world.leaf.size:
        if box_signed(world.boxes, node, x, y) >= reach:
            node = world.skip[node]
            continue
        obstacle = world.leaf[node]
        node += 1
        if obstacle < 0:
            continue
        cast_obstacle(world, obstacle, x, y, rays, first, step, reach, ranges)
    for beam in range(beams):
        if ranges[beam] >= reach:
            ranges[beam] = np.inf
    return ranges
