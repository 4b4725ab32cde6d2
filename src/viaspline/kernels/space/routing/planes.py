"""A short list of planes that a way stays beyond.

Tested through ``kernels/space/routing/test_pull_taut``.
"""

from __future__ import annotations

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined
from viaspline.kernels.space.routing.route_protocol import (
    NORMAL_X,
    NORMAL_Y,
    NORMAL_Z,
    OFFSET,
    WHERE,
)

_SAME = 1e-9


@inlined
def add_plane(
    planes: Floats, count: int, nx: float, ny: float, nz: float, offset: float, where: float
) -> int:
    """Add a plane unless it is there already, or the list is full; how many there are then."""
    for row in range(count):
        if (
            abs(planes[row, NORMAL_X] - nx) < _SAME
            and abs(planes[row, NORMAL_Y] - ny) < _SAME
            and abs(planes[row, NORMAL_Z] - nz) < _SAME
        ):
            if offset > planes[row, OFFSET]:  # of planes that are parallel one counts
                planes[row, OFFSET] = offset
                planes[row, WHERE] = where
            return count
    if count == planes.shape[0]:
        return count
    planes[count, NORMAL_X] = nx
    planes[count, NORMAL_Y] = ny
    planes[count, NORMAL_Z] = nz
    planes[count, OFFSET] = offset
    planes[count, WHERE] = where
    return count + 1
