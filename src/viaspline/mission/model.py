"""What the user asks for: frozen, validated types in the words of the mission file.

``Mission.model_validate(data)`` takes exactly what the YAML holds. Lengths are metres, angles in
files are degrees (the key says so), the frame is ENU: x east, y north, headings anticlockwise
from x.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[Number, Field(gt=0)]
NotNegative = Annotated[Number, Field(ge=0)]
Name = Annotated[str, Field(strict=True, min_length=1)]
Side = Literal["left", "right"]


def _plain(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) else value


Point2 = Annotated[tuple[Number, Number], BeforeValidator(_plain)]
Point = Annotated[tuple[Number, Number] | tuple[Number, Number, Number], BeforeValidator(_plain)]
Ring = Annotated[tuple[Point2, ...], BeforeValidator(_plain), Field(min_length=3)]


class Value(BaseModel):
    """A frozen value that refuses keys it does not know."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Circle(Value):
    """A disc: ``center`` [m] and ``radius`` [m]."""

    center: Point2
    radius: Positive


class Obstacle(Value):
    """Something to keep clear of: a circle, or a polygon that may have holes.

    Attributes:
        circle: The disc, if it is one.
        polygon: The outer ring, in either direction, not closed by repeating its first point.
        holes: Free areas inside the polygon.
        name: What it is called in reports and errors.
        pass_on: Go past it on this side only, as seen by the robot along the leg: ``left`` leaves
            the obstacle on the robot's right. It counts wherever the obstacle is in the way.
        never_pass_on: The side that is forbidden; forbidding one is forcing the other.
    """

    circle: Circle | None = None
    polygon: Ring | None = None
    holes: tuple[Ring, ...] = ()
    name: Name | None = None
    pass_on: Side | None = None
    never_pass_on: Side | None = None

    @property
    def forced_side(self) -> Side | None:
        """The only side on which it may be passed, from either key."""
        if self.pass_on is not None:
            return self.pass_on
        if self.never_pass_on is not None:
            return "right" if self.never_pass_on == "left" else "left"
        return None


class WorldSpec(Value):
    """The known map, and what is there but not on the map.

    Attributes:
        bounds: ``x_min, y_min, x_max, y_max`` [m]; the robot stays inside. None: no bounds.
        fences: Polygons that the robot stays inside of, every one (inclusion fences).
        known: Obstacles on the map.
        unseen: Obstacles that only the sensor finds.
    """

    bounds: Annotated[tuple[Number, Number, Number, Number], BeforeValidator(_plain)] | None = None
    fences: tuple[Ring, ...] = ()
    known: tuple[Obstacle, ...] = ()
    unseen: tuple[Obstacle, ...] = ()


class Sensor(Value):
    """A range sensor that sees every obstacle of which a part is within ``range_m``."""

    range_m: Positive


class RobotSpec(Value):
    """A disc robot, its limits and its sensor."""

    radius_m: NotNegative = 0.5
    clearance_m: NotNegative = 0.5
    max_speed_mps: Positive = 2.0
    max_accel_mps2: Positive = 1.0
    max_lateral_accel_mps2: Positive | None = None
    sensor: Sensor | None = None


def _as_mapping(value: Any) -> Any:
    value = _plain(value)
    return {"at": value} if isinstance(value, list | tuple) else value


class ViaPoint(Value):
    """A place that the path runs through, exactly; a station if it has a dwell."""

    at: Point
    name: Name | None = None
    dwell_s: NotNegative = 0.0


class EndPoint(ViaPoint):
    """The start or the goal; the path can be given a heading there [deg, anticlockwise from x]."""

    heading_deg: Number | None = None


Via = Annotated[ViaPoint, BeforeValidator(_as_mapping)]
End = Annotated[EndPoint, BeforeValidator(_as_mapping)]


class Route(Value):
    """Start, via points in order, goal. A closed route comes back to its start (no goal)."""

    start: End
    via: tuple[Via, ...] = ()
    goal: End | None = None
    closed: Annotated[bool, Field(strict=True)] = False

    def points(self) -> Iterator[tuple[str, ViaPoint]]:
        """Every point of the route in order, with its key in the mission file."""
        yield "route.start", self.start
        for i, via in enumerate(self.via):
            yield f"route.via[{i}]", via
        if self.goal is not None:
            yield "route.goal", self.goal


class SplineSpec(Value):
    """The curve's shape.

    Attributes:
        tension: Eq. (7)'s t: 1 is the polyline, 0 Catmull-Rom, -1 loose. One number, or one for
            each span between the points of the route.
        slack: The same by its other name, s = (1 - t) / 2. Give one of the two.
        knots: How far apart the points are in parameter: equally, by the root of their distance,
            by their distance.
        tangents: ``cardinal``, or ``continuous`` for continuous curvature (Nielson's nu-spline).
    """

    tension: Number | Annotated[tuple[Number, ...], BeforeValidator(_plain)] | None = None
    slack: Number | Annotated[tuple[Number, ...], BeforeValidator(_plain)] | None = None
    knots: Literal["uniform", "centripetal", "chordal"] = "chordal"
    tangents: Literal["cardinal", "continuous"] = "cardinal"


class Mission(Value):
    """A world, a robot, a route and how smooth its curve is."""

    world: WorldSpec = WorldSpec()
    robot: RobotSpec = RobotSpec()
    route: Route
    spline: SplineSpec = SplineSpec()
