"""The route of a mission: the points that its path runs through, in order.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal, TypeAlias

from pydantic import (
    BeforeValidator,
    Field,
    SerializerFunctionWrapHandler,
    model_serializer,
    model_validator,
)

from viaspline.mission import others_words
from viaspline.mission.annotations import Expects
from viaspline.mission.corridor_spec import Corridor
from viaspline.mission.fields import Coordinate, Duration, Heading, Name, Point, Point3, plain
from viaspline.mission.space.gate_spec import GateSpec
from viaspline.mission.space.takeoff_spec import AnyLanding, Takeoff
from viaspline.mission.space.yaw_spec import Yaw
from viaspline.mission.value import Value, two_of

if TYPE_CHECKING:
    from typing import Self

    from pydantic import GetJsonSchemaHandler

Optimise: TypeAlias = Literal["time", "length"]
Detours: TypeAlias = Literal["local", "short"]

MAX_LAPS: Final = 1000
"""How often a closed route can be driven at most."""
MAX_VIAS: Final = 20_000
"""How many via points a route can have at most."""
MAX_POINTS_DRIVEN: Final = 50_000
"""How many points a drive of several laps can come to at most."""


def as_point(value: Any) -> Any:
    """What may stand for a point of the route as the mapping that it is short for.

    ``[x, y]`` is ``{at: [x, y]}``, and a gate is where its middle is.
    """
    value = plain(value)
    if isinstance(value, list | tuple):
        return {"at": value}
    if isinstance(value, Mapping) and value.get("gate") is not None and "at" not in value:
        gate = value["gate"]
        at = plain(gate.get("at")) if isinstance(gate, Mapping) else getattr(gate, "at", None)
        # What is wrong with a gate's place is a fault of the gate, not of the point as well.
        return {**value, "at": at if _is_place(at) else (0.0, 0.0, 0.0)}
    return value


def _is_place(value: Any) -> bool:
    return isinstance(value, list | tuple) and len(value) == 3


class ViaPoint(
    Value,
    foreign=others_words.POINT,
    expected="[x, y] or {at: [x, y], name: ..., dwell_s: ...}",
    examples=(
        {"at": [20, 8], "name": "pump", "dwell_s": 10},
        {"at": [20, 8], "agl_m": 12, "look_at": [25, 8, 2]},
        {"gate": {"at": [20, 0, 5], "facing_deg": 0, "width_m": 3, "height_m": 3}},
    ),
):
    """A place that the path runs through, exactly; a station if it has a dwell.

    Attributes:
        at: The place, ``[x, y]`` or ``[x, y, z]`` [m]; of a gate its middle.
        name: What it is called in reports and errors.
        dwell_s: How long the robot stands there [s].
        agl_m: In place of z, the height above the ground there [m].
        look_at: In space, what the robot looks at when it is there, ``[x, y, z]`` [m].
        gate: In place of ``at``, an opening that the path goes through.
    """

    at: Point
    name: Name | None = None
    dwell_s: Duration = 0.0
    agl_m: Coordinate | None = None
    look_at: Point3 | None = None
    gate: GateSpec | None = None

    @model_validator(mode="after")
    def _one_place(self) -> Self:
        if self.gate is not None and self.at != self.gate.at:
            raise two_of("at", "gate")
        return self

    @model_serializer(mode="wrap")
    def _place_once(self, serialized: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Without the place that a gate has, so that it can be read again."""
        data: dict[str, Any] = serialized(self)
        if self.gate is not None:
            data.pop("at", None)
        return data

    @classmethod
    def __get_pydantic_json_schema__(
        cls, core_schema: Any, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """The schema, in which a gate stands for the place."""
        schema = super().__get_pydantic_json_schema__(core_schema, handler)
        own = handler.resolve_ref_schema(schema)
        own["required"] = [key for key in own["required"] if key != "at"]
        own["oneOf"] = [{"required": ["at"]}, {"required": ["gate"]}]
        return schema

    @property
    def is_spatial(self) -> bool:
        """Whether it has a key that means something in space only."""
        return self.agl_m is not None or self.look_at is not None or self.gate is not None


class EndPoint(
    ViaPoint,
    examples=(
        {"at": [0, 0], "name": "dock", "dwell_s": 5, "heading_deg": 90},
        {"at": [0, 0], "agl_m": 10, "look_at": [5, 0, 2]},
    ),
):
    """The start or the goal.

    Attributes:
        heading_deg: The heading of the path there [deg, anticlockwise from x]; a closed route
            comes back with it as well. None: free.
    """

    heading_deg: Heading | None = None


Via: TypeAlias = Annotated[
    ViaPoint, BeforeValidator(as_point, json_schema_input_type=Point | ViaPoint)
]
End: TypeAlias = Annotated[
    EndPoint, BeforeValidator(as_point, json_schema_input_type=Point | EndPoint)
]
Vias: TypeAlias = Annotated[
    tuple[Via, ...],
    Field(max_length=MAX_VIAS),
    Expects("a list of points such as [[10, 20], {at: [30, 40], dwell_s: 5}]"),
]


class Route(
    Value,
    foreign=others_words.ROUTE,
    examples=(
        {
            "start": [0, 0],
            "via": [[20, 8], {"at": [30, 4], "dwell_s": 10}],
            "goal": {"at": [40, 0], "heading_deg": 90},
            "order": "shortest",
            "corridor": {"left_m": 2, "right_m": 2},
            "optimise": "length",
            "detours": "short",
            "depart_s": 5,
            "hold_s": 2,
        },
        {"start": [0, 0], "via": [[20, 8], [20, -8]], "closed": True, "laps": 3},
        {
            "start": [0, 0],
            "takeoff": {"to_agl_m": 10},
            "via": [{"at": [20, 8], "agl_m": 15}],
            "land": [40, 0],
            "yaw": "along",
        },
    ),
):
    """Start, via points in order, goal.

    Attributes:
        start: Where the robot stands at first.
        via: The places that the path runs through, in this order unless ``order`` says otherwise.
        goal: Where it ends. None: at the last via point, or at the start if the route is closed.
        closed: Whether the path comes back to its start; then there is no goal.
        order: ``given``, or ``shortest``: the via points are served in the order that makes the
            round short; soon where ``optimise`` is ``time``, if there are no more than 16.
        laps: How often a closed route is driven, without a halt between laps. The path is that of
            the whole drive, and every lap visits every point. In a fleet a closed route that
            doesn't say its laps is a patrol that never ends.
        corridor: A strip that the path stays inside of.
        optimise: What sides and shapes are chosen by: the ``time`` in which the path is driven
            within the robot's limits, or its ``length``, the paper's rule.
        detours: ``local``: round what stands between two via points, the path leaves the straight
            line between them late and is back on it early, so that a lane stays a lane; ``short``:
            on the shortest way. None: local where the line is more than ten times as long as what
            stands in it, the shortest way is off it for more than four widths of that, and
            ``optimise`` is ``time``.
        depart_s: When the robot may set out [s]; what moves does so by the same clock.
        hold_s: How long the goal has to stay free of what moves once the robot is there [s].
        takeoff: In space, how high the robot climbs straight up before anything else.
        land: In space, where it comes straight down at the end; then there is no goal.
        yaw: In space, where it looks: ``along`` its path, at a place, or in a direction. At a via
            point with ``look_at`` it looks there. None: along.
    """

    start: End
    via: Vias = ()
    goal: End | None = None
    closed: Annotated[bool, Field(strict=True)] = False
    order: Literal["given", "shortest"] = "given"
    laps: Annotated[int, Field(strict=True, ge=1, le=MAX_LAPS)] = 1
    corridor: Corridor | None = None
    optimise: Optimise = "time"
    detours: Detours | None = None
    depart_s: Duration = 0.0
    hold_s: Duration = 0.0
    takeoff: Takeoff | None = None
    land: AnyLanding | None = None
    yaw: Yaw | None = None

    @property
    def is_spatial(self) -> bool:
        """Whether it has a key that means something in space only."""
        given = (self.takeoff, self.land, self.yaw)
        return any(key is not None for key in given) or any(
            point.is_spatial for _, point in self.points()
        )

    @property
    def is_patrol(self) -> bool:
        """Whether it is closed and doesn't say how often it is driven: in a fleet it never ends.

        >>> round_trip = {"start": [0, 0], "via": [[9, 0], [9, 9]], "closed": True}
        >>> [Route.model_validate({**round_trip, **laps}).is_patrol for laps in ({}, {"laps": 1})]
        [True, False]
        """
        return self.closed and "laps" not in self.model_fields_set

    def points(self) -> Iterator[tuple[str, ViaPoint]]:
        """Every point of the route in order, with its key in the mission file."""
        yield "route.start", self.start
        for i, via in enumerate(self.via):
            yield f"route.via[{i}]", via
        if self.goal is not None:
            yield "route.goal", self.goal
