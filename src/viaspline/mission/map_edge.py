"""Where maps end: the bounds that they bring along.

Tested through ``mission/test_resolve_files``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

from viaspline.maps.grid import Grid
from viaspline.mission.fields import Corners

Bounds: TypeAlias = tuple[float, float, float, float]


class MapEdge(NamedTuple):
    """What keeps the robot on the map: an upright box, or a fence where that says it better.

    Attributes:
        bounds: ``x_min, y_min, x_max, y_max`` [m].
        fence: The corners of the one place where all maps lie, if it is turned.
    """

    bounds: Bounds | None = None
    fence: Corners | None = None


def edge_of(grids: Sequence[Grid]) -> MapEdge:
    """The box round all of some maps, or their corners if they all lie in one turned place.

    >>> import numpy as np
    >>> edge_of([Grid(np.zeros((2, 3)), 1.0), Grid(np.zeros((1, 1)), 0.5, (-1, 0, 0))])
    MapEdge(bounds=(-1.0, 0.0, 3.0, 2.0), fence=None)
    """
    if not grids:
        return MapEdge()
    places = {tuple((x, y) for x, y in grid.corners.tolist()) for grid in grids}
    if len(places) == 1 and abs(math.sin(2 * grids[0].origin[2])) > 1e-9:
        return MapEdge(fence=places.pop())
    x_min, y_min, x_max, y_max = zip(*(grid.extent for grid in grids), strict=True)
    return MapEdge(bounds=(min(x_min), min(y_min), max(x_max), max(y_max)))
