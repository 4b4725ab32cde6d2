"""The free space of a mission as shapely has it: for oracles that know nothing of the package."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from problems import Solids, core_of, rows_of_squares

import viaspline as vs

ARC_SEGMENTS = 16  # of a quarter of a circle
REACH_M = 1e9  # of bounds where a mission has none


@dataclass(frozen=True)
class FreeSpace:
    """Where the middle of a disc may be.

    Attributes:
        solids: What to keep clear of; convex cores.
        required: Distance to keep [m].
    """

    solids: Solids
    required: float

    @classmethod
    def of(cls, mission: vs.Mission) -> FreeSpace:
        """The known world of a mission, for the largest disc in the robot's body."""
        cores, radii = _cores(mission)
        robot, bounds = mission.robot, mission.world.bounds
        grids = [o.grid.extent for o in mission.world.known if o.grid is not None]
        if bounds is None and grids:
            low, high = np.array(grids)[:, :2].min(axis=0), np.array(grids)[:, 2:].max(axis=0)
            bounds = (*low.tolist(), *high.tolist())
        box = bounds or (-REACH_M, -REACH_M, REACH_M, REACH_M)
        solids = Solids(cores=cores, radii=radii, bounds=tuple(box))
        return cls(solids, robot.inner_radius + robot.clearance_m)

    def polygon(self, around: np.ndarray, margin: float) -> shapely.Geometry:
        """The free space about some places, a little larger than it is: arcs are cut short.

        Args:
            around: Places [m], (n, 2).
            margin: By which the box about them is larger [m].
        """
        x0, y0, x1, y1 = self.solids.bounds
        box = shapely.box(*(around.min(axis=0) - margin), *(around.max(axis=0) + margin))
        inside = shapely.box(*(np.array((x0, y0, -x1, -y1)) + self.required) * (1, 1, -1, -1))
        near = np.flatnonzero(shapely.dwithin(self.solids.cores, box, self.required + margin))
        grown = shapely.buffer(
            self.solids.cores[near], self.solids.radii[near] + self.required - 1e-6,
            quad_segs=ARC_SEGMENTS,
        )  # fmt: skip
        return shapely.difference(shapely.intersection(box, inside), shapely.union_all(grown))

    def room(self, geometries: np.ndarray) -> np.ndarray:
        """By how much more than required geometries are clear [m], (n,); 2 m at most."""
        return self.solids.room(geometries, self.required + 2.0) - self.required


def _cores(mission: vs.Mission) -> tuple[np.ndarray, np.ndarray]:
    """Convex geometries, and by how much each is grown [m]."""
    cores: list[shapely.Geometry] = []
    radii: list[float] = []
    for obstacle in mission.world.known:
        if obstacle.grid is not None:
            found = _squares(obstacle.grid)
            cores += found
            radii += [0.0] * len(found)
            continue
        core, radius = core_of(obstacle.model_dump(exclude_none=True))
        parts = _convex(core)
        cores += parts
        radii += [radius] * len(parts)
    return np.array(cores, object), np.array(radii)


def _convex(core: shapely.Geometry) -> list[shapely.Geometry]:
    """A geometry in convex parts."""
    if core.geom_type != "Polygon" or math.isclose(core.convex_hull.area, core.area, rel_tol=1e-12):
        return [core]
    return list(shapely.get_parts(shapely.constrained_delaunay_triangles(core)))


def _squares(grid: vs.Grid) -> list[shapely.Geometry]:
    """Blocked cells, equal rows of them joined."""
    boxes = rows_of_squares(grid.blocked, 1.0)
    corners = shapely.get_coordinates(boxes)
    return list(shapely.polygons(grid.to_world(corners).reshape(len(boxes), -1, 2)))
