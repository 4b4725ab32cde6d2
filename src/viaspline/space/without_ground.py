"""A world in space for what stands on its ground: all of it but the ground.

Tested through ``space/test_solve_route``.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.spatial_world import SpatialWorld


def without_ground(world: SpatialWorld) -> SpatialWorld:
    """The solids and bounds of a world, without its ground and its limits of height.

    >>> flat = SpatialWorld.of([], ground=0.0, bounds=(0, 0, 9, 9))
    >>> float(without_ground(flat).distance((4, 5, 0)))
    4.0
    """
    read_only = np.empty((0, 0))
    read_only.flags.writeable = False  # as the ground's heights are: see PackedSpace
    packed = world.packed._replace(
        heights=read_only,
        ground_frame=np.array((0.0, 0.0, 1.0, -np.inf, -np.inf)),
        ground_levels=np.empty((0, 3), np.int64),
        ground_tops=np.empty(0),
        ground_planes=np.empty((0, 5)),
        height_limits=np.array(HeightBand().numbers),
    )
    return replace(world, packed=packed, ground=None, band=HeightBand())
