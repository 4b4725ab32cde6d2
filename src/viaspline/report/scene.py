"""A world on a map: obstacles, the clearance that is required around them, bounds and fences.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePath

import numpy as np
import shapely
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from viaspline.kernels.arrays import Floats
from viaspline.maps.grid import Grid
from viaspline.mission.map_edge import edge_of
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.report import style
from viaspline.report.canvas import outline, shape_of, shapes_of
from viaspline.report.labels import Labels
from viaspline.report.map_ground import (
    MapColours,
    MapGround,
    nearest_point,
    too_near,
    view_of,
)
from viaspline.report.scene_layers import (
    MAX_OBSTACLES_NAMED,
    counted,
    draw_grids,
    draw_known,
    draw_outside,
    draw_unseen,
    grown,
)
from viaspline.report.sheet import Box
from viaspline.world.world import World

MAX_CORNERS_DRAWN = 20_000  # of all outlines, beyond which their grown edges lose what is hidden
LEAST_RING_PX = 3.0  # from an obstacle to the edge of its required distance, to be told apart
HIDDEN_DOTS = 0.25  # detail of a picture that can't be seen [pixels]


@dataclass
class Scene:
    """What stands in a world, ready to be drawn as often as one likes.

    Attributes:
        known: Polygons of the circles and polygons on the map.
        unseen: Polygons of those that only the sensor finds.
        grids: The occupancy grids on the map.
        unseen_grids: Those that only the sensor finds.
        names: Of the known polygons, then of the unseen ones; None for those without.
        free: Where the robot may be as far as bounds and fences say; None without.
        required: Distance that the path keeps from everything [m].
        frame: What ``free`` is made of: bounds, fences or both.
    """

    known: NDArray[np.object_]
    unseen: NDArray[np.object_]
    grids: tuple[MapGround, ...]
    unseen_grids: tuple[MapGround, ...]
    names: tuple[str | None, ...]
    free: BaseGeometry | None
    required: float
    frame: str

    @classmethod
    def of(cls, world: World, required: float, unseen: Sequence[Obstacle] = ()) -> Scene:
        """A world, and what is there but not on its map."""
        parts = [shapely.Polygon(ring) for ring in world.fences]
        if world.corridor:
            parts.append(shapely.Polygon(world.corridor[0], world.corridor[1:]))
        if world.bounds is not None:
            parts.append(shapely.box(*world.bounds))
        free = shapely.intersection_all(np.array(parts, object)) if parts else None
        known = [obstacle for obstacle in world.obstacles if obstacle.grid is None]
        hidden = [obstacle for obstacle in unseen if obstacle.grid is None]
        names = tuple(obstacle.name for obstacle in (*known, *hidden))
        return cls(
            shapes_of(known), shapes_of(hidden), _grounds(world.obstacles), _hidden(unseen), names,
            free, required, _frame_of(world),
        )  # fmt: skip

    @property
    def corners(self) -> Floats:
        """Corners of the boxes of all obstacles and of the free area [m], shape (n, 2)."""
        shapes = [*self.known, *self.unseen] + ([] if self.free is None else [self.free])
        boxes = shapely.bounds(np.array(shapes, object)).reshape(-1, 4)
        extents = [ground.grid.extent for ground in (*self.grids, *self.unseen_grids)]
        boxes = np.vstack([boxes, np.array(extents).reshape(-1, 4)])
        corners: Floats = boxes[np.isfinite(boxes).all(1)].reshape(-1, 2)
        return corners

    @property
    def box(self) -> Box | None:
        """The box around bounds and fences [m]."""
        if self.free is None or self.free.is_empty:
            return None
        x0, y0, x1, y1 = self.free.bounds
        return x0, y0, x1, y1

    def draw(
        self, axes: Axes, pixels_per_metre: float, *, reveal: bool = True, faint: bool = False
    ) -> list[Artist]:
        """Draw it below everything else.

        Args:
            axes: Its limits say what can be seen.
            pixels_per_metre: The scale; a clearance that can hardly be seen is not drawn.
            reveal: Whether to draw the unseen obstacles.
            faint: Whether the unseen ones are to stay in the background.

        Returns:
            What belongs in a legend.
        """
        view = view_of(axes)
        artists: list[Artist] = []
        if self.free is not None:
            artists += draw_outside(axes, view, self.free, self.frame)
        grids = (*self.grids, *(self.unseen_grids if reveal else ()))
        artists += draw_grids(axes, grids)
        known, unseen = _within(self.known, view), _within(self.unseen, view)
        if not reveal:
            unseen = unseen[:0]
        if known.size:
            words = counted(len(self.known), "obstacle")
            artists.append(draw_known(axes, known, pixels_per_metre, words))
        if unseen.size:
            artists.append(draw_unseen(axes, unseen, len(self.unseen), faint))
        if self.required * pixels_per_metre >= LEAST_RING_PX:
            near = grown(view, self.required)  # what is just out of sight has an edge in sight
            shapes = _within(self.known, near)
            if reveal:
                shapes = np.concatenate((shapes, _within(self.unseen, near)))
            ring = self._ring(shapes, grids, view, pixels_per_metre)
            if not ring.is_empty:
                patch = PathPatch(
                    outline(ring), facecolor="none", edgecolor=style.RING, linewidth=0.6,
                    linestyle=(0, (4, 2)), zorder=3, label="required distance of the path",
                )  # fmt: skip
                axes.add_artist(patch)
                artists.append(patch)
        return artists

    def _ring(
        self, shapes: NDArray[np.object_], grids: Sequence[MapGround], view: Box, scale: float
    ) -> BaseGeometry:
        """Where the path may not be, as far as its edge can be seen."""
        if self.required <= 0:
            return shapely.Polygon()
        segments = 16 if len(shapes) < 400 else 4
        if shapely.get_num_coordinates(shapes).sum() > MAX_CORNERS_DRAWN:
            shapes = shapely.simplify(shapes, HIDDEN_DOTS / scale)
        areas = [*shapely.buffer(shapes, self.required, quad_segs=segments)]
        dots = round((view[3] - view[1]) * scale), round((view[2] - view[0]) * scale)
        areas += [too_near(ground.grid, view, dots, self.required) for ground in grids]
        if self.free is not None:
            inner = self.free.buffer(-self.required)
            far = max(2 * self.required, view[2] - view[0], view[3] - view[1])
            areas.append(shapely.box(*grown(view, far)).difference(inner))
        return shapely.union_all(np.array(areas, object))

    def name(self, labels: Labels) -> None:
        """Ask for the names of the obstacles, if they are few."""
        named = [
            (name, shape)
            for name, shape in zip(self.names, [*self.known, *self.unseen], strict=True)
            if name is not None
        ]
        for name, shape in named if len(named) <= MAX_OBSTACLES_NAMED else []:
            middle = shape.representative_point() if not _centred(shape) else shape.centroid
            width = shape.bounds[2] - shape.bounds[0]
            labels.add(
                style.short(name), (middle.x, middle.y), rank=7, colour=style.OBSTACLE_EDGE,
                inside=0.95 * width,
            )  # fmt: skip

    def nearest_to(self, point: tuple[float, ...]) -> tuple[float, float] | None:
        """The nearest point of any obstacle or of the edge of the free area [m]."""
        here = point[0], point[1]
        shapes = [*self.known, *self.unseen]
        if self.free is not None:
            shapes.append(shapely.boundary(self.free))
        places = []
        if shapes:
            distances = shapely.distance(np.array(shapes, object), shapely.Point(here))
            places.append(_on_shape(shapes[int(np.argmin(distances))], here))
        for ground in (*self.grids, *self.unseen_grids):
            place = nearest_point(ground.grid, here)
            places += [] if place is None else [place]
        return min(places, key=lambda place: math.dist(place, here), default=None)


def nearest_on(obstacle: Obstacle, point: tuple[float, ...]) -> tuple[float, float] | None:
    """The point of an obstacle that is nearest to a place [m]; None for a free grid."""
    here = point[0], point[1]
    if obstacle.grid is not None:
        return nearest_point(obstacle.grid, here)
    return _on_shape(shape_of(obstacle), here)


def _on_shape(shape: shapely.Geometry, here: tuple[float, float]) -> tuple[float, float]:
    x, y = shapely.get_coordinates(shapely.shortest_line(shape, shapely.Point(here)))[0].tolist()
    return x, y


def _frame_of(world: World) -> str:
    """What a legend calls that which the robot stays inside of."""
    edge = edge_of([obstacle.grid for obstacle in world.obstacles if obstacle.grid is not None])
    if world.corridor:
        others = world.bounds is not None or bool(world.fences)
        return "corridor and fences" if others else "corridor"
    if world.bounds == edge.bounds and world.fences == (
        () if edge.fence is None else (edge.fence,)
    ):
        return "edge of the map"
    if not world.fences:
        return "bounds"
    return "fence" if world.bounds is None else "bounds and fences"


def _grounds(obstacles: Sequence[Obstacle]) -> tuple[MapGround, ...]:
    """The grids on the map: one is just what is blocked, several have their names and colours."""
    grids = [obstacle for obstacle in obstacles if obstacle.grid is not None]
    if len(grids) == 1:
        return tuple(MapGround(o.grid, o.name or "blocked on the map") for o in grids if o.grid)
    tones = [MapColours(*colours) for colours in style.OBSTACLES]
    return tuple(
        MapGround(o.grid, style.short(o.name or _file_of(o.grid)), tones[i % len(tones)])
        for i, o in enumerate(grids)
        if o.grid is not None
    )


def _file_of(grid: Grid) -> str:
    return "occupancy grid" if grid.source is None else PurePath(grid.source).name


def _hidden(obstacles: Sequence[Obstacle]) -> tuple[MapGround, ...]:
    tone = MapColours(style.UNSEEN_FILL, style.UNSEEN)
    label = "blocked, but not on the map"
    return tuple(MapGround(o.grid, label, tone) for o in obstacles if o.grid is not None)


def _centred(shape: BaseGeometry) -> bool:
    return bool(shape.contains(shape.centroid))


def _within(shapes: NDArray[np.object_], view: Box) -> NDArray[np.object_]:
    seen: NDArray[np.object_] = shapes[shapely.intersects(shapes, shapely.box(*view))]
    return seen
