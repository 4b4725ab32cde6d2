"""An obstacle of a mission: one shape, a name, how it moves, and the side on which to pass it.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Annotated, Any, Final, Literal

from pydantic import BeforeValidator, InstanceOf
from pydantic.json_schema import SkipJsonSchema

from viaspline.errors import GeometryError
from viaspline.maps.grid import Grid
from viaspline.maps.reading import Reading
from viaspline.mission import others_words
from viaspline.mission.fields import Heights, Name, Ring, Rings
from viaspline.mission.motion_spec import Motion
from viaspline.mission.shapes.ball import Ball
from viaspline.mission.shapes.box import Box
from viaspline.mission.shapes.capsule import Capsule
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.polygon import Polygon
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.shape_protocol import Shape
from viaspline.mission.shapes.solids import GridPrism, Prism, Solid
from viaspline.mission.shapes.voxel_field import AnyVoxels
from viaspline.mission.standalone import Standalone

Side = Literal["left", "right"]
"""A side on which an obstacle in the plane is passed."""
SpatialSide = Literal["left", "right", "over", "under"]
"""A side on which an obstacle in space is passed."""

KINDS: Final[Mapping[str, type[Shape]]] = {
    "circle": Circle,
    "capsule": Capsule,
    "polygon": Polygon,
}
"""The kinds that are rounded rings, by the keys that give them: each a file of its own here."""

SOLID_KINDS: Final[Mapping[str, type[Shape]]] = {"ball": Ball, "box": Box}
"""The kinds that there are in space only."""

SHAPES: Final = (*KINDS, "grid", *SOLID_KINDS, "voxels")
"""The keys that give an obstacle its shape."""

HAVING_HEIGHTS: Final = (*SOLID_KINDS, "voxels")
"""The keys of shapes that have heights of their own."""


def _as_grid(value: Any) -> Any:
    """The grid that ``model_dump`` took apart."""
    if not isinstance(value, Mapping) or not hasattr(value.get("blocked"), "dtype"):
        return value
    reading = value["reading"]
    parts = {key: item for key, item in value.items() if key != "digest"}
    return Grid(**{**parts, "reading": None if reading is None else Reading(**reading)})


class Obstacle(
    Standalone,
    foreign=others_words.OBSTACLE,
    expected="an obstacle such as {circle: {center: [x, y], radius: 5}}",
    exactly_one=SHAPES,
    needing=(("holes", "polygon"),),
    examples=(
        {"circle": {"center": [20, 10], "radius": 3}, "name": "tank", "pass_on": "left"},
        {"capsule": {"from": [0, 5], "to": [30, 5], "radius": 0.2}, "never_pass_on": "right"},
        {
            "polygon": [[0, 0], [9, 0], [9, 9], [0, 9]],
            "holes": [[[3, 3], [6, 3], [6, 6]]],
            "height_m": [0, 12],
        },
        {"ball": {"center": [20, 10, 30], "radius": 4}},
        {"box": {"min": [0, 0, 0], "max": [4, 2, 9]}},
        {"voxels": {"file": "maps/plant.3dmap"}},
        {
            "circle": {"center": [0, 0], "radius": 1},
            "motion": {"from": [10, 3], "velocity_mps": [1, 0]},
        },
    ),
):
    """Something to keep clear of: a flat shape, a map's squares, or a solid.

    In space a flat shape reaches from ``height_m[0]`` up to ``height_m[1]``, and over all heights
    where that isn't given.

    Attributes:
        circle: The disc, if it is one.
        capsule: The line with a radius, if it is one; in space where its ends have heights.
        polygon: The outer ring ``[[x, y], ...]`` [m], in either direction. A last point that
            repeats the first is dropped.
        holes: Free areas inside the polygon, each a ring of its own.
        grid: The blocked squares of an occupancy grid. In a file, ``map`` asks for it.
        ball: The ball, if it is one.
        box: The box, if it is one.
        voxels: The blocked cubes of a file, or in Python of an array of truth values, shape
            (nx, ny, nz), or of a `Voxels`.
        height_m: Floor and roof of a flat shape in space, ``[low, high]`` [m]. None: every height.
        name: What it is called in reports and errors.
        pass_on: Go past it on this side only, as seen by the robot along the leg: ``left`` leaves
            the obstacle on the robot's right. The path of a leg then never crosses the line that
            goes from the obstacle, square to the straight line between the leg's via points, out
            to the other side. It counts on every leg whose straight line or path comes nearer to
            the obstacle than twice the robot's radius and clearance, or whose straight line passes
            it on this side anyway; in a corridor with a line, wherever it stands inside. In space
            also ``over`` or ``under``.
        never_pass_on: The side that is forbidden; forbidding one is forcing the other.
        motion: How it moves; its shape then stands in a frame of its own. None: it stands.

    Raises:
        MissionError: With every fault.

    >>> Obstacle(circle={"center": (1, 2), "radius": "wide"})
    Traceback (most recent call last):
    viaspline.errors.MissionError: <mission>: circle.radius: found the text "wide"; it should be ...
    """

    stands_at = ("world", "known", 0)

    circle: Circle | None = None
    capsule: Capsule | None = None
    polygon: Ring | None = None
    holes: Rings = ()
    grid: Annotated[SkipJsonSchema[InstanceOf[Grid] | None], BeforeValidator(_as_grid)] = None
    ball: Ball | None = None
    box: Box | None = None
    voxels: AnyVoxels | None = None
    height_m: Heights | None = None
    name: Name | None = None
    pass_on: SpatialSide | None = None
    never_pass_on: SpatialSide | None = None
    motion: Motion | None = None

    def shapes(self) -> Iterator[tuple[str, Shape]]:
        """Its shape with the key that gives it; a sound obstacle has one at most, a map none."""
        if self.circle is not None:
            yield "circle", self.circle
        if self.capsule is not None:
            yield "capsule", self.capsule
        if self.polygon is not None:
            yield "polygon", Polygon(self.polygon, self.holes)
        if self.ball is not None:
            yield "ball", self.ball
        if self.box is not None:
            yield "box", self.box

    @property
    def is_spatial(self) -> bool:
        """Whether it says something of heights."""
        return (
            self.height_m is not None
            or self.ball is not None
            or self.box is not None
            or self.voxels is not None
            or (self.capsule is not None and self.capsule.is_spatial)
            or self.pass_on in ("over", "under")
            or self.never_pass_on in ("over", "under")
            or (self.motion is not None and self.motion.has_heights)
        )

    def solid(self) -> Solid:
        """Its shape in space.

        Raises:
            GeometryError: It has no shape.

        >>> tower = Obstacle(circle={"center": (0, 0), "radius": 2}, height_m=(0, 35))
        >>> tower.solid().box
        (-2.0, -2.0, 0.0, 2.0, 2.0, 35.0)
        """
        if self.voxels is not None:
            return self.voxels
        if self.ball is not None:
            return self.ball.solid()
        if self.box is not None:
            return self.box.solid()
        if self.capsule is not None and self.capsule.is_spatial:
            return self.capsule.solid()
        low, high = (-math.inf, math.inf) if self.height_m is None else self.height_m
        if self.grid is not None:
            return GridPrism(self.grid, low, high)
        if self.ring is None:
            raise GeometryError(f"an obstacle has no shape: give it a {' or '.join(SHAPES)}")
        return Prism(self.ring, low, high)

    @cached_property
    def ring(self) -> RoundedRing | None:
        """Its shape as a rounded ring; None if it is a map or a solid, or has no shape.

        Made once: a robot with a lidar packs what it has seen after every scan.

        Raises:
            GeometryError: It has two shapes, of which one would be as if it weren't there.
        """
        given = [key for key in SHAPES if getattr(self, key) is not None]
        if len(given) > 1:
            raise GeometryError(
                f"an obstacle has two shapes, {given[0]} and {given[1]}: make it two obstacles"
            )
        for key, shape in self.shapes():
            if key in KINDS and not (self.capsule is not None and self.capsule.is_spatial):
                return shape.ring()
        return None

    @property
    def outline_in_plan(self) -> RoundedRing | None:
        """What is seen of it from above; None if it is a map, or has no shape."""
        return next((shape.ring() for _, shape in self.shapes()), None)

    def called(self, index: int) -> str:
        """What it is called in reports: by its name, its map's file or its number, from 1.

        >>> Obstacle(circle={"center": (0, 0), "radius": 1}).called(2)
        'obstacle 3'
        """
        if self.name is not None:
            return self.name
        if self.grid is not None and self.grid.source is not None:
            return f"map '{self.grid.source}'"
        return f"obstacle {index + 1}"

    @property
    def forced_side(self) -> Side | None:
        """The only side on which it may be passed in the plane, from either key."""
        if self.pass_on == "left" or self.pass_on == "right":
            return self.pass_on
        if self.pass_on is None and self.never_pass_on == "left":
            return "right"
        if self.pass_on is None and self.never_pass_on == "right":
            return "left"
        return None
