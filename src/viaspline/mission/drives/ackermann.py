"""Steered front wheels, as a car has them."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Final

from pydantic import Field

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.mission.drives.drive_kind import DriveKind, FormField
from viaspline.mission.drives.drive_limits import DriveLimits
from viaspline.mission.fields import DEGREES, AngularSpeed, Length, Number

MAX_WHEELBASE_M: Final = 100.0
"""The longest wheelbase."""
MIN_STEER_DEG: Final = 0.5
"""The least that a steered wheel turns."""


class Ackermann(
    DriveKind,
    expected="a mapping such as {wheelbase_m: 2.5, max_steer_deg: 35}",
    examples=({"wheelbase_m": 1.7, "max_steer_deg": 32, "max_steer_rate_degps": 30},),
):
    """Steered front wheels, as a bicycle; the reference point is the middle of the rear axle.

    Attributes:
        wheelbase_m: From the rear axle to the front axle [m].
        max_steer_deg: The greatest angle of the front wheels [deg].
        max_steer_rate_degps: How fast they turn [deg/s]. None: no limit.
    """

    label: ClassVar = "steered"
    example: ClassVar = {"wheelbase_m": 1, "max_steer_deg": 30}
    cannot: ClassVar = (
        "it can't move sideways, nor turn tighter than its turning circle or on the spot"
    )

    wheelbase_m: Annotated[Length, Field(le=MAX_WHEELBASE_M), FormField("Wheelbase")]
    max_steer_deg: Annotated[Number, DEGREES, Field(ge=MIN_STEER_DEG, lt=90), FormField("Steering")]
    max_steer_rate_degps: Annotated[AngularSpeed | None, FormField("Steering rate", "no limit")] = (
        None
    )

    @property
    def turn_radius(self) -> float:
        """The radius of the tightest circle of the reference point [m].

        >>> round(Ackermann(wheelbase_m=2.0, max_steer_deg=45).turn_radius, 9)
        2.0
        """
        return self.wheelbase_m / math.tan(math.radians(self.max_steer_deg))

    def actuators(self) -> Actuators:
        """A wheelbase, and how far and how fast the wheels turn."""
        return Actuators(
            wheelbase=self.wheelbase_m,
            max_steer=math.radians(self.max_steer_deg),
            max_steer_rate=math.radians(self.max_steer_rate_degps or math.inf),
        )

    def limits(self, max_speed: float, max_accel: float) -> DriveLimits:
        """Steered wheels turn no faster than they can."""
        if self.max_steer_rate_degps is None:
            return DriveLimits()
        return DriveLimits(
            max_steer_rate=math.radians(self.max_steer_rate_degps), wheelbase=self.wheelbase_m
        )

    def actuator_values(self, speed: float, turn: float) -> dict[str, float]:
        """The speed of the rear axle and the angle of the front wheels, left is positive.

        >>> Ackermann(wheelbase_m=2.0, max_steer_deg=45).actuator_values(1.0, 0.3)
        {'speed_mps': 1.0, 'steer_rad': 0.3}
        """
        return {"speed_mps": speed, "steer_rad": turn}
