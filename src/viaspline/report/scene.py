"""A world on a map: obstacles, the clearance that is required around them, bounds and fences."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.patches import PathPatch, Rectangle
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from viaspline.mission.parts import Obstacle
from viaspline.report import style
from viaspline.report.drawing import Floats, outline, shapes_of
from viaspline.report.labels import Labels
from viaspline.report.sheet import Box
from viaspline.world.world import World

NAMED = 30  # obstacles with a name on the picture, at most


@dataclass
class Scene:
    """What stands in a world, ready to be drawn as often as one likes.

    Attributes:
        known: Polygons of the obstacles on the map.
        unseen: Polygons of the obstacles that only the sensor finds.
        names: Of the known ones, then of the unseen ones; None for those without.
        free: Where the robot may be as far as bounds and fences say; None without.
        required: Distance that the path keeps from everything [m].
        frame: What ``free`` is made of: bounds, fences or both.
    """

    known: NDArray[np.object_]
    unseen: NDArray[np.object_]
    names: tuple[str | None, ...]
    free: BaseGeometry | None
    required: float
    frame: str

    @classmethod
    def of(cls, world: World, required: float, unseen: Sequence[Obstacle] = ()) -> Scene:
        """A world, and what is there but not on its map."""
        parts = [shapely.Polygon(ring) for ring in world.fences]
        if world.bounds is not None:
            parts.append(shapely.box(*world.bounds))
        free = shapely.intersection_all(np.array(parts, object)) if parts else None
        names = tuple(obstacle.name for obstacle in (*world.obstacles, *unseen))
        frame = {(True, False): "bounds", (False, True): "fence"}.get(
            (world.bounds is not None, bool(world.fences)), "bounds and fences"
        )
        return cls(shapes_of(world.obstacles), shapes_of(unseen), names, free, required, frame)

    @property
    def corners(self) -> Floats:
        """Corners of the boxes of all obstacles and of the free area [m], shape (n, 2)."""
        shapes = [*self.known, *self.unseen] + ([] if self.free is None else [self.free])
        boxes = shapely.bounds(np.array(shapes, object)).reshape(-1, 4)
        corners: Floats = boxes[np.isfinite(boxes).all(1)].reshape(-1, 2)
        return corners

    @property
    def box(self) -> Box | None:
        """The box around bounds and fences [m]."""
        if self.free is None or self.free.is_empty:
            return None
        x0, y0, x1, y1 = self.free.bounds
        return x0, y0, x1, y1

    def draw(self, axes: Axes, pixels_per_metre: float, *, reveal: bool = True) -> list[Artist]:
        """Draw it below everything else.

        Args:
            axes: Its limits say what can be seen.
            pixels_per_metre: The scale; a clearance of less than a pixel is not drawn.
            reveal: Whether to draw the unseen obstacles.

        Returns:
            What belongs in a legend.
        """
        (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
        view: Box = (x0, y0, x1, y1)
        artists: list[Artist] = []
        if self.free is not None:
            artists += _draw_outside(axes, view, self.free, self.frame)
        known, unseen = _within(self.known, view), _within(self.unseen, view)
        if not reveal:
            unseen = unseen[:0]
        if known.size:
            artists.append(_draw_known(axes, known, pixels_per_metre))
        if unseen.size:
            artists.append(_draw_unseen(axes, unseen))
        if self.required * pixels_per_metre >= 1.0:
            ring = self._ring(np.concatenate([known, unseen]), view)
            if not ring.is_empty:
                patch = PathPatch(
                    outline(ring), facecolor="none", edgecolor=style.RING, linewidth=0.6,
                    linestyle=(0, (4, 2)), zorder=3, label="required distance of the path",
                )  # fmt: skip
                axes.add_artist(patch)
                artists.append(patch)
        return artists

    def _ring(self, shapes: NDArray[np.object_], view: Box) -> BaseGeometry:
        """Where the path may not be, as far as its edge can be seen."""
        if self.required <= 0:
            return shapely.Polygon()
        segments = 16 if len(shapes) < 400 else 4
        ring = shapely.union_all(shapely.buffer(shapes, self.required, quad_segs=segments))
        if self.free is not None:
            outside = shapely.box(*_grown(view, 2 * self.required)).difference(
                self.free.buffer(-self.required)
            )
            ring = ring.union(outside)
        return ring

    def name(self, labels: Labels) -> None:
        """Ask for the names of the obstacles, if they are few."""
        named = [
            (name, shape)
            for name, shape in zip(self.names, [*self.known, *self.unseen], strict=True)
            if name is not None
        ]
        for name, shape in named if len(named) <= NAMED else []:
            middle = shape.representative_point() if not _centred(shape) else shape.centroid
            width = shape.bounds[2] - shape.bounds[0]
            labels.add(
                style.short(name), (middle.x, middle.y), rank=7, colour=style.OBSTACLE_EDGE,
                inside=0.95 * width,
            )  # fmt: skip

    def nearest_to(self, point: tuple[float, ...]) -> tuple[float, float] | None:
        """The nearest point of any obstacle or of the edge of the free area [m]."""
        here = shapely.Point(point[:2])
        shapes = [*self.known, *self.unseen]
        if self.free is not None:
            shapes.append(shapely.boundary(self.free))
        if not shapes:
            return None
        distances = shapely.distance(np.array(shapes, object), here)
        nearest = shapes[int(np.argmin(distances))]
        line = shapely.shortest_line(nearest, here)
        x, y = shapely.get_coordinates(line)[0]
        return float(x), float(y)


def _centred(shape: BaseGeometry) -> bool:
    return bool(shape.contains(shape.centroid))


def _grown(view: Box, by: float) -> Box:
    return view[0] - by, view[1] - by, view[2] + by, view[3] + by


def _within(shapes: NDArray[np.object_], view: Box) -> NDArray[np.object_]:
    seen: NDArray[np.object_] = shapes[shapely.intersects(shapes, shapely.box(*view))]
    return seen


def _draw_outside(axes: Axes, view: Box, free: BaseGeometry, name: str) -> list[Artist]:
    outside = shapely.box(*_grown(view, 0.05 * (view[2] - view[0]))).difference(free)
    axes.add_artist(
        PathPatch(outline(outside), facecolor=style.OUTSIDE, edgecolor="none", zorder=0)
    )
    edge = PathPatch(
        outline(free), facecolor="none", edgecolor=style.INK, linewidth=1.0, zorder=2,
        label=name,
    )  # fmt: skip
    axes.add_artist(edge)
    return [edge]


def _draw_known(axes: Axes, shapes: NDArray[np.object_], scale: float) -> Artist:
    sizes = np.sqrt(shapely.area(shapes)) * scale
    width = 0.8 if np.median(sizes) > 8 else 0.3
    axes.add_collection(
        PathCollection(
            [outline(shape) for shape in shapes], facecolors=style.OBSTACLE,
            edgecolors=style.OBSTACLE_EDGE, linewidths=width, zorder=2.5,
        ),
        autolim=False,
    )  # fmt: skip
    return Rectangle(
        (0, 0), 1, 1, facecolor=style.OBSTACLE, edgecolor=style.OBSTACLE_EDGE, linewidth=0.8,
        label="obstacle",
    )  # fmt: skip


def _draw_unseen(axes: Axes, shapes: NDArray[np.object_]) -> Artist:
    look = {"facecolor": style.UNSEEN_FILL, "edgecolor": style.UNSEEN, "hatch": "////"}
    axes.add_collection(
        PathCollection(
            [outline(shape) for shape in shapes], facecolors=look["facecolor"],
            edgecolors=look["edgecolor"], hatch=look["hatch"], linewidths=0.9, zorder=2.6,
        ),
        autolim=False,
    )  # fmt: skip
    return Rectangle(
        (0, 0), 1, 1, facecolor=look["facecolor"], edgecolor=look["edgecolor"],
        hatch=look["hatch"], linewidth=0.9, label="obstacle that was not on the map",
    )  # fmt: skip
