"""Wheels that let a body go any way without turning: mecanum, omni or swerve."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.mission.drives.drive_kind import Contradiction, DriveKind, FormField
from viaspline.mission.drives.drive_limits import DriveLimits
from viaspline.mission.fields import Heading, Speed


class Omnidirectional(
    DriveKind,
    expected="a mapping such as {max_speed_along_mps: 1, max_speed_across_mps: 0.7}",
    examples=({"max_speed_along_mps": 1, "max_speed_across_mps": 0.7, "hold_heading_deg": 0},),
):
    """Mecanum, omni or swerve wheels: the body goes any way, whichever way it looks.

    A lidar looks with the body: one that doesn't see all round may be blind where a robot goes that
    holds its heading, and then the robot waits there.

    Attributes:
        max_speed_along_mps: The greatest speed along the body, ROS's ``max_vel_x`` [m/s].
        max_speed_across_mps: The greatest speed across the body, ROS's ``max_vel_y`` [m/s]; it
            counts where the heading is held.
        hold_heading_deg: The heading that the body keeps wherever it goes [deg, anticlockwise from
            x]. None: it looks the way that it goes.
    """

    label: ClassVar = "mecanum or swerve"
    example: ClassVar = {"max_speed_along_mps": 1, "max_speed_across_mps": 0.7}
    cannot: ClassVar = "it can't hold its heading with a footprint: that takes a disc"

    max_speed_along_mps: Annotated[Speed, FormField("Speed along")]
    max_speed_across_mps: Annotated[Speed, FormField("Speed across")]
    hold_heading_deg: Annotated[Heading | None, FormField("Keeps heading", "the way it goes")] = (
        None
    )

    @property
    def held_heading(self) -> float | None:
        """The heading that the body keeps [rad]; None: it looks the way that it goes.

        >>> speeds = {"max_speed_along_mps": 1.0, "max_speed_across_mps": 0.5}
        >>> Omnidirectional(**speeds, hold_heading_deg=180).held_heading == math.pi
        True
        """
        return None if self.hold_heading_deg is None else math.radians(self.hold_heading_deg)

    def actuators(self) -> Actuators:
        """Speeds along and across; one that looks the way that it goes goes along only."""
        if self.held_heading is None:
            return Actuators(max_wheel_speed=self.max_speed_along_mps)
        return Actuators(
            max_along=self.max_speed_along_mps,
            max_across=self.max_speed_across_mps,
            held_heading=self.held_heading,
        )

    def limits(self, max_speed: float, max_accel: float) -> DriveLimits:
        """Speeds along and across the body; the same motors turn its velocity and change it."""
        if self.held_heading is None:
            return DriveLimits(max_speed=self.max_speed_along_mps)
        return DriveLimits(
            max_speed=math.hypot(self.max_speed_along_mps, self.max_speed_across_mps),
            max_lateral_accel=max_accel,
            body_speed=(self.max_speed_along_mps, self.max_speed_across_mps),
        )

    def contradictions(self, *, has_footprint: bool) -> tuple[Contradiction, ...]:
        """A polygon is proven clear along the path's headings, not for one that is held."""
        if self.held_heading is None or not has_footprint:
            return ()
        problem = "a held heading doesn't go with a footprint, which is proven clear along the path"
        remedy = "leave it out, or give radius_m, of a disc that contains the body, for footprint"
        return (Contradiction("hold_heading_deg", problem, remedy),)
