"""Whether a way is free as a whole, and what it costs.

Tested through ``space/routing/test_space_router``.
"""

from __future__ import annotations

from typing import Any

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import kernel
from viaspline.kernels.space.routing.route_protocol import is_free
from viaspline.kernels.space.routing.side_gates import gates_allow
from viaspline.kernels.space.routing.travel_norm import travel_between


@kernel
def way_is_free(space: Any, gates: Floats, way: Floats, radius: float) -> bool:
    """Whether all lines of a way, (n, 3), keep a radius from everything, and the gates' sides."""
    for row in range(way.shape[0] - 1):
        x, y, z = way[row, 0], way[row, 1], way[row, 2]
        dx, dy, dz = way[row + 1, 0] - x, way[row + 1, 1] - y, way[row + 1, 2] - z
        if not gates_allow(gates, x, y, z, dx, dy, dz):
            return False
        if not is_free(space, x, y, z, dx, dy, dz, radius):
            return False
    return True


@kernel
def way_cost(norm: Floats, way: Floats) -> float:
    """What a way, (n, 3), costs [m or s]."""
    cost = 0.0
    for row in range(way.shape[0] - 1):
        cost += travel_between(norm, way, row, row + 1)
    return cost
