"""An obstacle of a mission: one shape, a name, how it moves, and the side on which to pass it.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Annotated, Any, Final, Literal

from pydantic import BeforeValidator, InstanceOf
from pydantic.json_schema import SkipJsonSchema

from viaspline.maps.grid import Grid
from viaspline.maps.reading import Reading
from viaspline.mission.fields import Name, Ring, Rings
from viaspline.mission.motion_spec import Motion
from viaspline.mission.shapes.capsule import Capsule
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.polygon import Polygon
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.shape_protocol import Shape
from viaspline.mission.standalone import Standalone

Side = Literal["left", "right"]

KINDS: Final[Mapping[str, type[Shape]]] = {
    "circle": Circle,
    "capsule": Capsule,
    "polygon": Polygon,
}
"""The kinds that are rounded rings, by the keys that give them: each a file of its own here."""

SHAPES: Final = (*KINDS, "grid")
"""The keys that give an obstacle its shape."""


def _as_grid(value: Any) -> Any:
    """The grid that ``model_dump`` took apart."""
    if not isinstance(value, Mapping) or not hasattr(value.get("blocked"), "dtype"):
        return value
    reading = value["reading"]
    parts = {key: item for key, item in value.items() if key != "digest"}
    return Grid(**{**parts, "reading": None if reading is None else Reading(**reading)})


class Obstacle(
    Standalone,
    expected="an obstacle such as {circle: {center: [x, y], radius: 5}}",
    exactly_one=SHAPES,
    needing=(("holes", "polygon"),),
):
    """Something to keep clear of: a circle, a capsule, a polygon with holes, or a map's squares.

    Attributes:
        circle: The disc, if it is one.
        capsule: The line with a radius, if it is one.
        polygon: The outer ring ``[[x, y], ...]`` [m], in either direction. A last point that
            repeats the first is dropped.
        holes: Free areas inside the polygon, each a ring of its own.
        grid: The blocked squares of an occupancy grid. In a file, ``map`` asks for it.
        name: What it is called in reports and errors.
        pass_on: Go past it on this side only, as seen by the robot along the leg: ``left`` leaves
            the obstacle on the robot's right. The path of a leg then never crosses the line that
            goes from the obstacle, square to the straight line between the leg's via points, out
            to the other side. It counts on every leg whose straight line or path comes nearer to
            the obstacle than twice the robot's radius and clearance, or whose straight line passes
            it on this side anyway; in a corridor with a line, wherever it stands inside.
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
    name: Name | None = None
    pass_on: Side | None = None
    never_pass_on: Side | None = None
    motion: Motion | None = None

    def shapes(self) -> Iterator[tuple[str, Shape]]:
        """Its shape with the key that gives it; a sound obstacle has one at most, a grid none."""
        if self.circle is not None:
            yield "circle", self.circle
        if self.capsule is not None:
            yield "capsule", self.capsule
        if self.polygon is not None:
            yield "polygon", Polygon(self.polygon, self.holes)

    @cached_property
    def ring(self) -> RoundedRing | None:
        """Its shape as a rounded ring; None if it is a grid, or has no shape.

        Made once: a robot with a lidar packs what it has seen after every scan.
        """
        for _, shape in self.shapes():
            return shape.ring()
        return None

    @property
    def forced_side(self) -> Side | None:
        """The only side on which it may be passed, from either key."""
        if self.pass_on is not None:
            return self.pass_on
        if self.never_pass_on is not None:
            return "right" if self.never_pass_on == "left" else "left"
        return None
