"""What stands in a spatial world, as its pictures see it.

Tested through ``report/space/test_spatial_pictures``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.maps.grid import Grid
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.solids import GridPrism, Prism, RoundedSegment, Solid


@dataclass(frozen=True)
class NamedSolid:
    """A solid and what it is called; the name is empty where it has none of its own."""

    solid: Solid
    name: str = ""

    @cached_property
    def shadow(self) -> shapely.Geometry:
        """Its outline from above; of voxels the box that holds them."""
        solid = self.solid
        if isinstance(solid, Prism):
            around: shapely.Geometry = solid.ring.outline(16)
            return around
        if isinstance(solid, RoundedSegment):
            first, last = solid.first[:2], solid.last[:2]
            core = shapely.Point(first) if first == last else shapely.LineString([first, last])
            return shapely.buffer(core, solid.radius, quad_segs=16)
        if isinstance(solid, GridPrism):
            return _squares(solid.grid)
        x0, y0, _, x1, y1, _ = solid.extent
        return shapely.box(x0, y0, x1, y1)

    @property
    def heights(self) -> tuple[float, float]:
        """From where to where it reaches in height [m]; infinite for a prism without an end."""
        solid = self.solid
        box = solid.extent if isinstance(solid, Voxels) else solid.box
        return box[2], box[5]


def _squares(grid: Grid) -> shapely.Geometry:
    """The blocked squares of a grid, those that follow each other in a row taken together.

    >>> _squares(Grid([[True, True], [False, True]], 2.0)).area
    12.0
    """
    edges = np.diff(np.pad(grid.blocked.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    row, first = np.nonzero(edges > 0)
    last = np.nonzero(edges < 0)[1]
    around: shapely.Geometry = shapely.union_all(shapely.box(first, row, last, row + 1))
    return shapely.transform(around, grid.to_world)


@dataclass(frozen=True)
class SpatialScene:
    """What stands in a spatial world.

    Attributes:
        solids: All of it but the ground.
        terrain: The ground, if it isn't even.
        flat: Height of even ground [m]; None if there is none, or terrain.
        bounds: x_min, y_min, x_max, y_max of the world [m], if it has them.
    """

    solids: Sequence[NamedSolid]
    terrain: Terrain | None = None
    flat: float | None = None
    bounds: tuple[float, float, float, float] | None = None

    @cached_property
    def shadows(self) -> NDArray[np.object_]:
        """The outlines of the solids from above, shape (n,)."""
        found = np.empty(len(self.solids), object)
        for k, one in enumerate(self.solids):
            found[k] = one.shadow
        return found

    def ground(self, places: Floats) -> Floats:
        """Height of the ground under places (n, 2) [m], shape (n,); NaN where none is known."""
        if self.terrain is not None:
            return self.terrain.height_at(places)
        return np.full(len(places), np.nan if self.flat is None else self.flat)

    def is_overhead(self, one: NamedSolid) -> bool:
        """Whether a solid begins above the ground under it; above zero where none is known."""
        low = one.heights[0]
        under = self.ground(shapely.get_coordinates(shapely.point_on_surface(one.shadow)))
        return math.isfinite(low) and low > (float(under[0]) if np.isfinite(under[0]) else 0.0)

    def corners(self) -> Floats:
        """Corners of the boxes of the solids from above [m], shape (2 n, 2)."""
        boxes = shapely.bounds(self.shadows).reshape(-1, 4)
        return np.asarray(boxes.reshape(-1, 2)[np.isfinite(boxes.reshape(-1, 2)).all(axis=1)])
