"""The parts of a mission: frozen, validated types in the words of the mission file.

Lengths are metres, angles in files are degrees (the key says so), the frame is ENU: x east,
y north, headings anticlockwise from x. What one part means to another is held in ``model``.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Final, Literal

from pydantic import BeforeValidator, Field

from viaspline.maps.grid import LARGEST_CELL_M
from viaspline.maps.reading import Unknown
from viaspline.mission.fields import (
    FAR,
    Coordinate,
    Name,
    NotNegative,
    Number,
    Point,
    Positive,
    Ring,
    Value,
    as_text,
    plain,
)
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.shapes.obstacle import Obstacle, Side

Tangents = Literal["cardinal", "continuous"]

MOST_LAPS: Final = 1000
"""The most laps of a closed route."""


class MapSpec(Value):
    """Obstacles that have a file of their own, as a mission asks for them.

    Attributes:
        map: The file, relative to the mission's: a map of squares (ROS's map_server YAML,
            MovingAI's ``.map``) becomes one obstacle, and if ``bounds`` aren't given, the robot
            stays inside of it; each polygon of a drawing (``.svg``) or of GeoJSON becomes one.
        unknown: What to make of squares that nobody has seen. None: they are blocked.
        resolution_m: Side of a square of a MovingAI map, or length of a unit of a drawing [m].
            None: 1 m.
        name: What it is called in reports and errors; several polygons are numbered.
        pass_on: Go past each of its polygons on this side only.
        never_pass_on: The side that is forbidden.
    """

    map: Annotated[Name, BeforeValidator(as_text)]
    unknown: Unknown | None = None
    resolution_m: Annotated[Positive, Field(le=LARGEST_CELL_M)] | None = None
    name: Name | None = None
    pass_on: Side | None = None
    never_pass_on: Side | None = None


class SpeedZone(Value):
    """An area in which the robot drives more slowly.

    Attributes:
        polygon: Its corners ``[[x, y], ...]`` [m].
        max_speed_mps: The greatest speed of the reference point inside of it [m/s].
        name: What it is called in reports and errors.
    """

    polygon: Ring
    max_speed_mps: Positive
    name: Name | None = None


class WorldSpec(Value):
    """The known map, and what is there but not on the map.

    Attributes:
        bounds: ``x_min, y_min, x_max, y_max`` [m]; the robot stays inside. None: no bounds, or
            the edge of the maps of squares that are known.
        fences: Polygons that the robot stays inside of, every one (inclusion fences).
        known: Obstacles on the map.
        unseen: Obstacles that only the sensor finds.
        speed_zones: Areas with a lower speed.
    """

    bounds: (
        Annotated[tuple[Coordinate, Coordinate, Coordinate, Coordinate], BeforeValidator(plain)]
        | None
    ) = None
    fences: tuple[Ring, ...] = ()
    known: tuple[Obstacle, ...] = ()
    unseen: tuple[Obstacle, ...] = ()
    speed_zones: tuple[SpeedZone, ...] = ()


def _as_mapping(value: Any) -> Any:
    """The short form ``[x, y]`` of ``{at: [x, y]}``."""
    value = plain(value)
    return {"at": value} if isinstance(value, list | tuple) else value


class ViaPoint(Value):
    """A place that the path runs through, exactly; a station if it has a dwell.

    Attributes:
        at: The place, ``[x, y]`` or ``[x, y, z]`` [m].
        name: What it is called in reports and errors.
        dwell_s: How long the robot stands there [s].
    """

    at: Point
    name: Name | None = None
    dwell_s: NotNegative = 0.0


class EndPoint(ViaPoint):
    """The start or the goal.

    Attributes:
        heading_deg: The heading of the path there [deg, anticlockwise from x]. None: free.
    """

    heading_deg: Number | None = None


Via = Annotated[ViaPoint, BeforeValidator(_as_mapping, json_schema_input_type=Point | ViaPoint)]
End = Annotated[EndPoint, BeforeValidator(_as_mapping, json_schema_input_type=Point | EndPoint)]


CorridorRow = Annotated[
    tuple[Coordinate, Coordinate, NotNegative, NotNegative], BeforeValidator(plain)
]


class Corridor(Value):
    """A strip that the path stays inside of: a lane, a race track, the strip along a pipeline.

    Widths alone are a bound: the path is laid through the route's points as ever. Along a line of
    its own the path is laid for least curvature, from the start through the via points to the goal
    or round again. An open strip goes straight on beyond its ends, by its larger width there;
    where a strip comes back to itself, the bound is what any part of it covers.

    Attributes:
        left_m: How far it reaches to the left of the polyline through the route's points [m].
        right_m: How far it reaches to the right of it [m].
        line: In place of both, the middle line with its widths: ``[[x, y, right, left], ...]``
            [m], in the direction of driving. Along a closed route it is closed.
        csv: In place of ``line``, a file with its rows, relative to the mission's. When the mission
            is read, ``line`` gets the rows and this becomes the file's absolute path.
    """

    left_m: Annotated[Positive, Field(le=FAR)] | None = None
    right_m: Annotated[Positive, Field(le=FAR)] | None = None
    line: Annotated[tuple[CorridorRow, ...], Field(min_length=2), BeforeValidator(plain)] | None = (
        None
    )
    csv: Annotated[Name, BeforeValidator(as_text)] | None = None


class Route(Value):
    """Start, via points in order, goal.

    Attributes:
        start: Where the robot stands at first.
        via: The places that the path runs through, in this order unless ``order`` says otherwise.
        goal: Where it ends. None: at the last via point, or at the start if the route is closed.
        closed: Whether the path comes back to its start; then there is no goal.
        order: ``given``, or ``shortest``: the via points are served in the order that makes the
            round short.
        laps: How often a closed route is driven, without a halt between laps. The path is that of
            the whole drive, and every lap visits every point.
        corridor: A strip that the path stays inside of.
    """

    start: End
    via: tuple[Via, ...] = ()
    goal: End | None = None
    closed: Annotated[bool, Field(strict=True)] = False
    order: Literal["given", "shortest"] = "given"
    laps: Annotated[int, Field(strict=True, ge=1, le=MOST_LAPS)] = 1
    corridor: Corridor | None = None

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
            each span between the points of the route, or ``auto`` for what is advised.
        slack: The same by its other name, s = (1 - t) / 2. Give one of the two.
        knots: How far apart the points are in parameter: equally, by the root of their distance,
            by their distance.
        tangents: ``cardinal``, or ``continuous`` for continuous curvature. None: continuous if the
            robot has a drive, a turning circle or a footprint, else cardinal.
    """

    tension: (
        Number | Annotated[tuple[Number, ...], BeforeValidator(plain)] | Literal["auto"] | None
    ) = None
    slack: Number | Annotated[tuple[Number, ...], BeforeValidator(plain)] | None = None
    knots: Literal["uniform", "centripetal", "chordal"] = "chordal"
    tangents: Tangents | None = None


class MissionParts(Value):
    """All parts of a mission, each sound by itself.

    Attributes:
        world: The known map, and what is there but not on the map.
        robot: The robot's body, limits and sensor.
        route: The points that the path runs through.
        spline: The curve's shape.
    """

    world: WorldSpec = WorldSpec()
    robot: RobotSpec = RobotSpec()
    route: Route
    spline: SplineSpec = SplineSpec()

    @property
    def tangents(self) -> Tangents:
        """Those of the spline, as it says or as the robot asks for."""
        if self.spline.tangents is not None:
            return self.spline.tangents
        robot = self.robot
        steers = robot.drive is not None or robot.turn_radius is not None
        return "continuous" if steers or robot.footprint is not None else "cardinal"
