"""What every kind of drive says of itself; each is one file beside this one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.mission.drives.drive_limits import DriveLimits
from viaspline.mission.value import Value


class FormField(NamedTuple):
    """How a form shows a key of a drive; its unit and its limits are the field's.

    Attributes:
        label: Its name.
        placeholder: What is shown where it is left out; empty if it has to be given.
    """

    label: str
    placeholder: str = ""


class Contradiction(NamedTuple):
    """A key of a drive that doesn't go with something else of the robot.

    Attributes:
        key: Of the drive.
        problem: What is wrong with it.
        remedy: What would be right.
    """

    key: str
    problem: str
    remedy: str


class DriveKind(Value):
    """A kind of drive: its parameters, what it can do, and what it can't.

    A new one is a file with a class like those beside this one, and a line in ``Drive``. What is
    said here holds for one that can turn on the spot and looks the way that it goes.

    Attributes:
        label: Its name in a form.
        example: The mapping that a form begins with, and that messages show.
        cannot: What it can't do, in words.
    """

    label: ClassVar[str]
    example: ClassVar[Mapping[str, Any]]
    cannot: ClassVar[str]

    @property
    def turn_radius(self) -> float | None:
        """The radius of the tightest circle of the reference point [m]; None if it has no limit."""
        return None

    @property
    def can_turn_on_spot(self) -> bool:
        """Whether it may stand and turn."""
        return self.turn_radius is None

    @property
    def held_heading(self) -> float | None:
        """The heading that the body keeps wherever it goes [rad]; None: it looks that way."""
        return None

    def actuators(self) -> Actuators:
        """What kernels have to know of it."""
        return Actuators()

    def limits(self, max_speed: float, max_accel: float) -> DriveLimits:
        """What it asks of the time law.

        Args:
            max_speed: Of the robot, with what its sensor allows [m/s].
            max_accel: Of the robot [m/s²].
        """
        del max_speed, max_accel
        return DriveLimits()

    def actuator_values(self, speed: float, turn: float) -> dict[str, float]:
        """What its actuators are to be given, by names with their units.

        Args:
            speed: Along the body [m/s].
            turn: The steering angle where wheels steer [rad], else the yaw rate [rad/s].
        """
        del speed, turn
        return {}

    def contradictions(self, *, has_footprint: bool) -> tuple[Contradiction, ...]:
        """What of it doesn't go with the robot.

        Args:
            has_footprint: Whether the body is a polygon.
        """
        del has_footprint
        return ()
