"""Wheels or tracks on either side that slip when the robot turns."""

from __future__ import annotations

from typing import Annotated, ClassVar, Final

from pydantic import Field

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.mission.drives.drive_kind import DriveKind, FormField
from viaspline.mission.drives.drive_limits import DriveLimits, limits_of_sides
from viaspline.mission.fields import Length, NotNegative, Speed

MAX_SLIP: Final = 0.99
"""The part of its speed that a side can lose at most."""


class SkidSteer(
    DriveKind,
    expected="a mapping such as {track_m: 0.8, slip: 0.2}",
    examples=({"track_m": 0.8, "slip": 0.2, "max_wheel_speed_mps": 2},),
):
    """Wheels or tracks on either side that slip when the robot turns.

    Attributes:
        track_m: Distance between the sides [m].
        slip: Part of the yaw rate that is lost to slipping.
        max_wheel_speed_mps: The greatest speed of either side [m/s]. None: no limit.
    """

    label: ClassVar = "skid steer"
    example: ClassVar = {"track_m": 0.5}
    cannot: ClassVar = "it can't move sideways, nor turn without slipping"

    track_m: Annotated[Length, FormField("Track")]
    slip: Annotated[NotNegative, Field(le=MAX_SLIP), FormField("Slip", "0")] = 0.0
    max_wheel_speed_mps: Annotated[Speed | None, FormField("Wheel speed", "no limit")] = None

    def actuators(self) -> Actuators:
        """A distance between sides, how fast they are, and what slipping leaves of a turn."""
        fastest = Actuators().max_wheel_speed
        return Actuators(
            track=self.track_m,
            grip=1.0 - self.slip,
            max_wheel_speed=self.max_wheel_speed_mps or fastest,
        )

    def limits(self, max_speed: float, max_accel: float) -> DriveLimits:
        """What the outer side asks, with what slipping takes."""
        return limits_of_sides(max_speed, self.track_m, 1.0 - self.slip, self.max_wheel_speed_mps)

    def actuator_values(self, speed: float, turn: float) -> dict[str, float]:
        """The speeds of both sides, with what slipping takes.

        >>> SkidSteer(track_m=0.5, slip=0.5).actuator_values(1.0, 0.4)
        {'left_wheel_mps': 0.8, 'right_wheel_mps': 1.2}
        """
        apart = 0.5 * turn * self.track_m / (1.0 - self.slip)
        return {"left_wheel_mps": speed - apart, "right_wheel_mps": speed + apart}
