"""The drive of a mission's robot: which kind it is, and how far from perfect."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Final, get_args

from pydantic import Field, model_validator

from viaspline.mission.drives.ackermann import Ackermann
from viaspline.mission.drives.differential import Differential
from viaspline.mission.drives.drive_kind import DriveKind
from viaspline.mission.drives.omnidirectional import Omnidirectional
from viaspline.mission.drives.skid_steer import SkidSteer
from viaspline.mission.fields import NotNegative, Value, one_of

LONGEST_DELAY_S: Final = 60.0
"""The longest delay and the slowest lag of a drive [s]."""


class Drive(Value):
    """What moves the robot, and how far from perfect that is in the simulator.

    Attributes:
        differential: Two driven wheels.
        ackermann: Steered front wheels.
        skid_steer: Two slipping sides.
        omnidirectional: Mecanum, omni or swerve wheels.
        delay_s: Time from a command to its effect [s].
        lag_s: Time constant with which speed and turn follow a command [s].
        speed_noise_mps: Standard deviation of the speed that is driven [m/s].
        yaw_rate_noise_degps: Standard deviation of the yaw rate that is driven [deg/s].
    """

    differential: Differential | None = None
    ackermann: Ackermann | None = None
    skid_steer: SkidSteer | None = None
    omnidirectional: Omnidirectional | None = None
    delay_s: Annotated[NotNegative, Field(le=LONGEST_DELAY_S)] = 0.0
    lag_s: Annotated[NotNegative, Field(le=LONGEST_DELAY_S)] = 0.0
    speed_noise_mps: NotNegative = 0.0
    yaw_rate_noise_degps: NotNegative = 0.0

    @model_validator(mode="after")
    def _one_kind(self) -> Drive:
        return one_of(self, *DRIVE_KINDS)

    @property
    def kind(self) -> DriveKind:
        """The one that is given.

        >>> Drive(differential={"track_m": 0.5}, delay_s=0.1).kind
        Differential(track_m=0.5, max_wheel_speed_mps=None)
        """
        given = (getattr(self, key) for key in DRIVE_KINDS)
        kind: DriveKind = next(kind for kind in given if kind is not None)
        return kind


def _kinds() -> dict[str, type[DriveKind]]:
    classes = {key: get_args(field.annotation) for key, field in Drive.model_fields.items()}
    return {
        key: choices[0]
        for key, choices in classes.items()
        if choices and isinstance(choices[0], type) and issubclass(choices[0], DriveKind)
    }


DRIVE_KINDS: Final[Mapping[str, type[DriveKind]]] = _kinds()
"""Every kind of drive by its key in a mission, in the order in which messages name them."""
