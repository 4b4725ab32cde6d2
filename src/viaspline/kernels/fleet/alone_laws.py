"""The laws of robots that set out at once and never wait for another.

Tested through ``fleet/execution/test_fleet_orders``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Ints
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.growable import new_floats
from viaspline.kernels.jit import kernel


@kernel
def alone_laws(first: Ints, rides: PackedRides) -> PackedLaws:
    """When each robot is where if it sets out at 0 s and nobody is in its way.

    Args:
        first: The first node of each robot, (n + 1,).
        rides: PackedRides.
    """
    robots, nodes = first.size - 1, rides.square.size
    arrive, leave = new_floats(nodes, 1)[:, 0], new_floats(nodes, 1)[:, 0]
    speed = new_floats(nodes, 1)[:, 0]
    spent = 0.0
    for robot in range(robots):
        begin = spent
        for k in range(first[robot], first[robot + 1]):
            arrive[k] = spent - begin
            leave[k] = arrive[k] + rides.stays[k]
            speed[k] = math.sqrt(rides.square[k])
            spent += rides.lasts[k] + rides.stays[k]
    return PackedLaws(arrive, leave, speed, np.ones(robots, np.bool_))
