"""What the oracles and the planner are asked alike: a world, a disc, and two places in it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
import shapely

import viaspline as vs

Box = tuple[float, float, float, float]
Place = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Solids:
    """Shapes as shapely has them, each grown by a radius of its own.

    Attributes:
        cores: Points, lines and polygons, shape (n,).
        radii: By which they are grown [m], shape (n,).
        bounds: What everything has to stay inside of [m].
    """

    cores: np.ndarray
    radii: np.ndarray
    bounds: Box

    @cached_property
    def trees(self) -> list[tuple[shapely.STRtree, np.ndarray]]:
        """Find the cores near a place, those that aren't grown by one of their own."""
        bare = self.radii == 0.0
        return [
            (shapely.STRtree(self.cores[some]), self.radii[some])
            for some in (bare, ~bare)
            if some.any()
        ]

    def room(self, lines: np.ndarray, reach: float) -> np.ndarray:
        """Distance of geometries to the nearest solid and the bounds [m], ``reach`` at most, (k,).

        Inside of a solid it is minus its radius at least, or 0 if that is none.
        """
        x0, y0, x1, y1 = self.bounds
        low_x, low_y, high_x, high_y = shapely.bounds(lines).T
        edges = np.column_stack((low_x - x0, low_y - y0, x1 - high_x, y1 - high_y))
        found = np.minimum(reach, edges.min(axis=1))
        for tree, radii in self.trees:
            far = reach + float(radii.max())
            of, core = tree.query(lines, predicate="dwithin", distance=far)
            gaps = shapely.distance(lines[of], tree.geometries[core]) - radii[core]
            np.minimum.at(found, of, gaps)
        return found


@dataclass(frozen=True, kw_only=True)
class Problem:
    """One plan that is asked for.

    Attributes:
        kind: Of its world, for the table.
        bounds: x_min, y_min, x_max, y_max [m].
        radius: Of the robot [m].
        clearance: Kept in addition [m].
        start: x, y [m].
        goal: x, y [m].
        obstacles: As a mission has them: circles, capsules and polygons.
        cells: True where a cell is blocked, shape (rows, columns), of a map whose lower left
            corner is the origin; None if there is no map.
        resolution: Side of a cell [m].
        note: What else tells it from others of its kind.
    """

    kind: str
    bounds: Box
    radius: float
    start: Place
    goal: Place
    clearance: float = 0.0
    obstacles: tuple[dict[str, Any], ...] = ()
    cells: np.ndarray | None = field(default=None, repr=False)
    resolution: float = 1.0
    note: str = ""

    @property
    def required(self) -> float:
        """Distance that the path keeps from everything [m]."""
        return self.radius + self.clearance

    def for_robot(self, radius: float, clearance: float = 0.0) -> Problem:
        """The same for another robot [m]."""
        return replace(self, radius=radius, clearance=clearance)

    def shared_out(self, random: np.random.Generator) -> Problem:
        """The same, with some of what is required as clearance now and then."""
        share = float(random.choice((1.0, 1.0, random.uniform(0.2, 0.9))))
        return self.for_robot(share * self.required, (1.0 - share) * self.required)

    def asked(self) -> dict[str, Any]:
        """The mission as a file would have it."""
        known: list[Any] = list(self.obstacles)
        if self.cells is not None:
            known.insert(0, vs.Obstacle(grid=vs.Grid(self.cells, self.resolution)))
        return {
            "world": {"bounds": self.bounds, "known": known},
            "robot": {"radius_m": self.radius, "clearance_m": self.clearance},
            "route": {"start": {"at": self.start}, "goal": {"at": self.goal}},
        }

    def mission(self, optimise: str = "time") -> vs.Mission:
        """As it is asked of the planner, with what a path is to have little of."""
        asked = self.asked()
        asked["route"]["optimise"] = optimise
        return vs.Mission.model_validate(asked)

    @cached_property
    def solids(self) -> Solids:
        """Its world as shapely has it."""
        cores, radii = [], []
        for obstacle in self.obstacles:
            core, radius = core_of(obstacle)
            cores.append(core)
            radii.append(radius)
        if self.cells is not None:
            squares = rows_of_squares(self.cells, self.resolution)
            cores.extend(squares)
            radii.extend([0.0] * len(squares))
        return Solids(cores=np.array(cores, object), radii=np.array(radii), bounds=self.bounds)


def core_of(obstacle: dict[str, Any]) -> tuple[Any, float]:
    """An obstacle as shapely has it, and by how much that is to be grown [m]."""
    if "circle" in obstacle:
        return shapely.Point(obstacle["circle"]["center"]), obstacle["circle"]["radius"]
    if "capsule" in obstacle:
        line = obstacle["capsule"]
        return shapely.LineString([line["from"], line["to"]]), line["radius"]
    return shapely.Polygon(obstacle["polygon"], obstacle.get("holes", ())), 0.0


def rows_of_squares(cells: np.ndarray, resolution: float) -> np.ndarray:
    """Blocked cells, those that touch in a row as one box."""
    edges = np.diff(np.pad(cells.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    y, first = np.nonzero(edges == 1)
    _, behind = np.nonzero(edges == -1)
    return shapely.box(*(resolution * a for a in (first, y, behind, y + 1)))


def places_with_room(
    random: np.random.Generator, solids: Solids, box: Box, room: float, count: int, tries: int = 400
) -> list[Place]:
    """Random places in a box that keep at least ``room`` [m]; fewer where there is none."""
    at = random.uniform(box[:2], box[2:], (tries, 2))
    kept = at[solids.room(shapely.points(at), 2.0 * room + 1e-3) >= room]
    return [(float(x), float(y)) for x, y in kept[:count]]


def turned(points: np.ndarray, angle: float) -> np.ndarray:
    """Points (n, 2) turned about the origin by an angle [rad]."""
    cos, sin = math.cos(angle), math.sin(angle)
    return points @ np.array([[cos, sin], [-sin, cos]])
