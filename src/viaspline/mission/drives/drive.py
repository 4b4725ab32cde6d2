"""The drive of a mission's robot: which kind it is, and how far from perfect."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Final, TypeAlias, get_args

from pydantic import Field

from viaspline.mission.drives.ackermann import Ackermann
from viaspline.mission.drives.differential import Differential
from viaspline.mission.drives.drive_kind import DriveKind
from viaspline.mission.drives.omnidirectional import Omnidirectional
from viaspline.mission.drives.skid_steer import SkidSteer
from viaspline.mission.fields import AngularSpeedNoise, Duration, SpeedNoise
from viaspline.mission.value import OneOf

MAX_DELAY_S: Final = 60.0
"""The longest delay and the slowest lag of a drive."""

ShortDuration: TypeAlias = Annotated[Duration, Field(le=MAX_DELAY_S)]


class Drive(
    OneOf,
    expected="a mapping such as {ackermann: {wheelbase_m: 2.5, max_steer_deg: 35}, delay_s: 0.1}",
    exactly_one=("differential", "ackermann", "skid_steer", "omnidirectional"),
    examples=(
        {
            "ackermann": {"wheelbase_m": 1.7, "max_steer_deg": 32},
            "delay_s": 0.1,
            "lag_s": 0.2,
            "speed_noise_mps": 0.02,
            "yaw_rate_noise_degps": 0.5,
        },
        {"differential": {"track_m": 0.5}},
        {"skid_steer": {"track_m": 0.8, "slip": 0.2}},
        {"omnidirectional": {"max_speed_along_mps": 1, "max_speed_across_mps": 0.7}},
    ),
):
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
    delay_s: ShortDuration = 0.0
    lag_s: ShortDuration = 0.0
    speed_noise_mps: SpeedNoise = 0.0
    yaw_rate_noise_degps: AngularSpeedNoise = 0.0

    @property
    def kind(self) -> DriveKind:
        """The one that is given.

        >>> Drive(differential={"track_m": 0.5}, delay_s=0.1).kind
        Differential(track_m=0.5)
        """
        given = (getattr(self, key) for key in DRIVE_KINDS)
        kind: DriveKind = next(kind for kind in given if kind is not None)
        return kind


DRIVE_KINDS: Final[Mapping[str, type[DriveKind]]] = {
    key: get_args(Drive.model_fields[key].annotation)[0] for key in Drive.key_rules["exactly_one"]
}
"""Every kind of drive by its key in a mission, in the order in which messages name them."""
