"""Two driven wheels on one axle."""

from __future__ import annotations

from typing import Annotated, ClassVar

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.mission.drives.drive_kind import DriveKind, FormField
from viaspline.mission.drives.drive_limits import DriveLimits, limits_of_sides
from viaspline.mission.fields import Length, Speed


class Differential(
    DriveKind,
    expected="a mapping such as {track_m: 0.5}",
    examples=({"track_m": 0.5, "max_wheel_speed_mps": 1.5},),
):
    """Two driven wheels on one axle.

    Attributes:
        track_m: Distance between the wheels [m].
        max_wheel_speed_mps: The greatest speed of either wheel [m/s]. None: no limit.
    """

    label: ClassVar = "two wheels"
    example: ClassVar = {"track_m": 0.5}
    cannot: ClassVar = "it can't move sideways"

    track_m: Annotated[Length, FormField("Track")]
    max_wheel_speed_mps: Annotated[Speed | None, FormField("Wheel speed", "no limit")] = None

    def actuators(self) -> Actuators:
        """A distance between wheels, and how fast they are."""
        fastest = Actuators().max_wheel_speed
        return Actuators(track=self.track_m, max_wheel_speed=self.max_wheel_speed_mps or fastest)

    def limits(self, max_speed: float, max_accel: float) -> DriveLimits:
        """What the outer wheel asks."""
        return limits_of_sides(max_speed, self.track_m, 1.0, self.max_wheel_speed_mps)

    def actuator_values(self, speed: float, turn: float) -> dict[str, float]:
        """The speeds of both wheels.

        >>> Differential(track_m=0.5).actuator_values(1.0, 0.4)
        {'left_wheel_mps': 0.9, 'right_wheel_mps': 1.1}
        """
        apart = 0.5 * turn * self.track_m
        return {"left_wheel_mps": speed - apart, "right_wheel_mps": speed + apart}
