"""The robot of a mission: its body, its drive and its limits.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

from pydantic import Field, SerializerFunctionWrapHandler, model_serializer, model_validator

from viaspline.mission import others_words
from viaspline.mission.annotations import Expects
from viaspline.mission.drives.drive import Drive
from viaspline.mission.fields import (
    ACCELERATIONS_MPS2,
    DEGREES,
    Acceleration,
    AngularAcceleration,
    AngularSpeed,
    Distance,
    Jerk,
    Length,
    NotNegative,
    Ring,
    Speed,
    TimeLimit,
    TurnRadius,
)
from viaspline.mission.sensor_spec import Sensor
from viaspline.mission.value import Value, two_of


class Localization(
    Value,
    expected="a mapping such as {position_noise_m: 0.02, heading_noise_deg: 0.5}",
    examples=({"position_noise_m": 0.02, "heading_noise_deg": 0.5},),
):
    """How well the robot knows where it is, in the simulator.

    Attributes:
        position_noise_m: Standard deviation of each coordinate that is measured [m].
        heading_noise_deg: Standard deviation of the heading that is measured [deg].
    """

    position_noise_m: Distance = 0.0
    heading_noise_deg: Annotated[NotNegative, DEGREES, Field(le=180)] = 0.0


TurnOnSpot = Literal["never", "stations", "vias"]


class MovingThings(
    Value,
    expected="a mapping such as {max_speed_mps: 2, safety: passive}",
    examples=({"max_speed_mps": 2, "safety": "passive"},),
):
    """What the robot has to reckon with where it doesn't see.

    Attributes:
        max_speed_mps: The greatest speed of anything that may come [m/s].
        safety: ``passive``: it is always able to stand before anything touches it; ``none``: it
            relies on what it foresees.
    """

    max_speed_mps: Speed = 2.0
    safety: Literal["passive", "none"] = "passive"


class RobotSpec(
    Value,
    foreign=others_words.ROBOT,
    expected="a mapping such as {radius_m: 0.5, clearance_m: 0.5, max_speed_mps: 2}",
    excluding=(("radius_m", "footprint"), ("max_yaw_rate_degps", "max_yaw_rate_dps")),
    examples=(
        {
            "radius_m": 0.4,
            "clearance_m": 0.3,
            "prefer_clearance_m": 0.5,
            "min_turn_radius_m": 2.5,
            "turn_on_spot": "stations",
            "max_speed_mps": 1.5,
            "max_accel_mps2": 0.8,
            "max_brake_mps2": 1.2,
            "max_lateral_accel_mps2": 0.5,
            "max_yaw_rate_degps": 45,
            "max_yaw_accel_degps2": 90,
            "max_jerk_mps3": 2,
            "drive": {"differential": {"track_m": 0.5}},
            "localization": {"position_noise_m": 0.02},
            "tracking_error_m": 0.1,
            "sensor": {"range_m": 40},
            "moving": {"max_speed_mps": 2},
            "max_replan_s": 0.5,
        },
        {
            "footprint": [[-0.4, -0.6], [2.2, -0.6], [2.2, 0.6], [-0.4, 0.6]],
            "max_lateral_accel_mps2": "unlimited",
        },
        {
            "half_height_m": 0.2,
            "max_climb_mps": 3,
            "max_descent_mps": 2,
            "max_vertical_accel_mps2": 1.5,
            "max_yaw_rate_dps": 60,
        },
    ),
):
    """The robot's body, its drive, its limits and its sensor.

    Attributes:
        radius_m: The radius of the body if it is a disc [m]; 0 is a point.
        footprint: The body if it is a polygon: corners ``[[x, y], ...]`` about the reference
            point, x forward and y left [m].
        clearance_m: Free space kept between the body and every obstacle [m].
        prefer_clearance_m: Free space beyond that which a plan keeps where it costs little time
            [m]: of all of it, a half and a quarter the most with which the path is driven in at
            most 1 % more time, and 5 s. Gaps between obstacles stay open, and nothing is refused
            for it. Paths that are laid under way keep what is required.
        min_turn_radius_m: The radius of the tightest circle that the reference point can drive
            [m]. None: what the drive says; without a drive the path may turn as sharply as it
            likes.
        turn_on_spot: Where the robot may stand and turn: ``never``, at ``stations`` (via points
            with a dwell), or at all ``vias``. None: never with steered wheels, else at stations.
        max_speed_mps: The greatest speed [m/s].
        max_accel_mps2: The greatest acceleration along the path [m/s²].
        max_brake_mps2: The greatest deceleration along the path [m/s²]. None: as the acceleration.
        max_lateral_accel_mps2: The greatest acceleration across the path, v² times curvature
            [m/s²], or ``unlimited``. None: as the acceleration along the path.
        max_yaw_rate_degps: The greatest yaw rate [deg/s]. None: no limit.
        max_yaw_accel_degps2: The greatest change of the yaw rate [deg/s²]. None: no limit.
        max_jerk_mps3: The greatest change of the acceleration along the path [m/s³]. None: no
            limit.
        drive: What moves it. None: a point that follows its path exactly.
        localization: How well it knows where it is. None: exactly.
        tracking_error_m: How far beside its path the robot may get [m]; the path keeps that much
            more. None: as far as it gets on a trial drive; nothing if it follows exactly.
        sensor: What finds the obstacles that are not on the map.
        moving: What it has to reckon with where it doesn't see. None: nothing unseen moves, or as
            the mission's ``unseen`` says; then no safety is proven.
        half_height_m: In space, half the height of the body if it is an upright cylinder with
            ``radius_m`` about the reference point [m]. None: it is a ball.
        max_climb_mps: The greatest speed upwards [m/s]. None: ``max_speed_mps``.
        max_descent_mps: The greatest speed downwards [m/s]. None: as upwards.
        max_vertical_accel_mps2: The greatest acceleration up or down [m/s²]. None: what
            ``max_accel_mps2`` along the path and ``max_lateral_accel_mps2`` across it add up to.
        max_yaw_rate_dps: The greatest yaw rate [deg/s], as documents of drones call it: another
            name of ``max_yaw_rate_degps``, which it is stored as.
        max_replan_s: How long it may look for a new path under way, from when it sees what is in
            its way [s]; then it brakes, and goes on looking. None: until it has to brake.
    """

    radius_m: Distance = 0.5
    footprint: (
        Annotated[
            Ring, Expects("at least three corners [[x, y], ...] in metres, x forward and y left")
        ]
        | None
    ) = None
    clearance_m: Distance = 0.5
    prefer_clearance_m: Distance = 0.0
    min_turn_radius_m: TurnRadius | None = None
    turn_on_spot: TurnOnSpot | None = None
    max_speed_mps: Speed = 2.0
    max_accel_mps2: Acceleration = 1.0
    max_brake_mps2: Acceleration | None = None
    max_lateral_accel_mps2: (
        Annotated[
            Acceleration | Literal["unlimited"],
            Expects(
                f"a number from {ACCELERATIONS_MPS2[0]:g} to {ACCELERATIONS_MPS2[1]:.0f} in m/s², "
                "or unlimited"
            ),
        ]
        | None
    ) = None
    max_yaw_rate_degps: AngularSpeed | None = None
    max_yaw_accel_degps2: AngularAcceleration | None = None
    max_jerk_mps3: Jerk | None = None
    drive: Drive | None = None
    localization: Localization | None = None
    tracking_error_m: Distance | None = None
    sensor: Sensor | None = None
    moving: MovingThings | None = None
    half_height_m: Length | None = None
    max_climb_mps: Speed | None = None
    max_descent_mps: Speed | None = None
    max_vertical_accel_mps2: Acceleration | None = None
    max_yaw_rate_dps: AngularSpeed | None = None
    max_replan_s: TimeLimit | None = None

    @model_validator(mode="after")
    def _one_body(self) -> RobotSpec:
        if self.footprint is not None and "radius_m" in self.model_fields_set:
            raise two_of("radius_m", "footprint")
        return self

    @model_validator(mode="after")
    def _one_yaw_rate(self) -> RobotSpec:
        if self.max_yaw_rate_dps is None:
            return self
        if self.max_yaw_rate_degps is not None:
            raise two_of("max_yaw_rate_degps", "max_yaw_rate_dps")
        # One limit has one place: whoever asks for it, and whoever writes it, need not ask twice.
        self.__dict__.update(max_yaw_rate_degps=self.max_yaw_rate_dps, max_yaw_rate_dps=None)
        self.__pydantic_fields_set__.discard("max_yaw_rate_dps")
        self.__pydantic_fields_set__.add("max_yaw_rate_degps")
        return self

    @model_serializer(mode="wrap")
    def _as_read(self, serialized: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Without the radius that a polygon takes the place of, so that it can be read again."""
        data: dict[str, Any] = serialized(self)
        if self.footprint is not None:
            data.pop("radius_m", None)
        return data

    @property
    def is_spatial(self) -> bool:
        """Whether it says something of heights."""
        given = (self.half_height_m, self.max_climb_mps, self.max_descent_mps)
        return any(key is not None for key in (*given, self.max_vertical_accel_mps2))

    @property
    def climb_speed(self) -> float:
        """The greatest speed upwards [m/s]."""
        return self.max_speed_mps if self.max_climb_mps is None else self.max_climb_mps

    @property
    def descent_speed(self) -> float:
        """The greatest speed downwards [m/s]."""
        return self.climb_speed if self.max_descent_mps is None else self.max_descent_mps

    @property
    def inner_radius(self) -> float:
        """The radius of the largest disc about the reference point that the body contains [m].

        >>> RobotSpec(footprint=[(-1, -0.8), (3, -0.8), (3, 0.8), (-1, 0.8)]).inner_radius
        0.8
        """
        if self.footprint is None:
            return self.radius_m
        return min(
            _distance_to_edge(a, b)
            for a, b in zip(self.footprint, (*self.footprint[1:], self.footprint[0]), strict=True)
        )

    @property
    def is_passive(self) -> bool:
        """Whether it is to stand before anything touches it that may come unseen."""
        return self.moving is not None and self.moving.safety == "passive"

    @property
    def outer_radius(self) -> float:
        """The radius of the smallest disc about the reference point that contains the body [m]."""
        if self.footprint is None:
            return self.radius_m
        return max(math.hypot(x, y) for x, y in self.footprint)

    @property
    def lateral_accel(self) -> float | None:
        """The greatest acceleration across the path [m/s²]; None if it has no limit.

        >>> RobotSpec(max_accel_mps2=0.7).lateral_accel
        0.7
        >>> RobotSpec(max_lateral_accel_mps2="unlimited").lateral_accel is None
        True
        """
        if self.max_lateral_accel_mps2 == "unlimited":
            return None
        return self.max_lateral_accel_mps2 or self.max_accel_mps2

    @property
    def turn_radius(self) -> float | None:
        """The radius of the tightest circle that it can drive [m]; None if it has no limit."""
        of_drive = None if self.drive is None else self.drive.kind.turn_radius
        radii = [self.min_turn_radius_m, of_drive]
        return max((radius for radius in radii if radius is not None), default=None)

    @property
    def turns_on_spot(self) -> TurnOnSpot:
        """Where it may stand and turn."""
        if self.turn_on_spot is not None:
            return self.turn_on_spot
        can = self.drive is None or self.drive.kind.can_turn_on_spot
        return "stations" if can else "never"

    @property
    def held_heading(self) -> float | None:
        """The heading that its body keeps wherever it goes [rad]; None: it looks that way."""
        return None if self.drive is None else self.drive.kind.held_heading


def _distance_to_edge(a: tuple[float, float], b: tuple[float, float]) -> float:
    """The distance of the origin from a segment [m]."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = dx * dx + dy * dy
    w = 0.0 if length == 0.0 else min(max(-(a[0] * dx + a[1] * dy) / length, 0.0), 1.0)
    return math.hypot(a[0] + w * dx, a[1] + w * dy)
