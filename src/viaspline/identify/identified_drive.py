"""A drive as a log shows it: each figure with its spread; and as keys of a mission to paste.

Tested through ``identify/test_fit_drive`` and ``commands/test_identify_command``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from viaspline.machine.robot_model import ACCEL_RESERVE, YAW_RESERVE

LEAST_SHARE = 0.01
"""Of its spread that a figure is worth writing down."""


class Estimate(NamedTuple):
    """A figure and its standard deviation, in the same unit."""

    value: float
    spread: float

    @property
    def figure(self) -> str:
        """The value with three digits; what is next to nothing beside its spread is 0.

        >>> Estimate(0.12345, 0.01).figure, Estimate(3e-13, 0.02).figure
        ('0.123', '0')
        """
        return f"{self.value:.3g}" if abs(self.value) > LEAST_SHARE * self.spread else "0"

    def __str__(self) -> str:
        return f"{self.figure} ± {self.spread:.2g}"


class IdentifiedSteering(NamedTuple):
    """What a log shows of front wheels that steer.

    Attributes:
        wheelbase: As it was told [m].
        most: The greatest angle [rad]. None: the log doesn't show that there is one.
        widest: The greatest angle in the log [rad].
        rate: The greatest change of the angle [rad/s]. None: the log doesn't show that limit.
    """

    wheelbase: float
    most: Estimate | None
    widest: float
    rate: Estimate | None


@dataclass(frozen=True)
class IdentifiedDrive:
    """What a log shows of a drive. None: it doesn't show that limit.

    Attributes:
        delay: From a command to its effect [s].
        lag: Time constant with which speed and yaw rate follow [s].
        speed_share: Of the commanded speed, that is reached.
        yaw_share: Of the commanded yaw rate, that is reached; the rest slips.
        top_speed: The greatest speed [m/s].
        accel: The greatest change of the speed [m/s²].
        yaw_accel: The greatest change of the yaw rate [rad/s²].
        accels_are_shared: Both changes come from the motors of two wheels: while one is at its
            greatest there is nothing of the other.
        steering: That of a robot whose front wheels steer.
        speed_noise: Of the speed that is driven [m/s], standard deviation.
        yaw_noise: Of the yaw rate that is driven [rad/s].
        position_noise: Of a measured coordinate [m].
        heading_noise: Of a measured heading [rad].
        fastest: The greatest speed in the log [m/s].
        fastest_turn: The greatest yaw rate that it shows [rad/s].
        seconds: Length of the log [s].
    """

    delay: Estimate
    lag: Estimate
    speed_share: Estimate
    yaw_share: Estimate
    top_speed: Estimate | None
    accel: Estimate | None
    yaw_accel: Estimate | None
    accels_are_shared: bool
    steering: IdentifiedSteering | None
    speed_noise: Estimate
    yaw_noise: Estimate
    position_noise: Estimate
    heading_noise: Estimate
    fastest: float
    fastest_turn: float
    seconds: float


SLIPS_FROM = 0.03
"""A robot that loses less of its yaw rate doesn't slip."""


def drive_block(drive: IdentifiedDrive, track: float) -> str:
    """The ``robot:`` keys of a mission that say what a log has shown, as YAML to paste.

    Args:
        drive: What the log shows.
        track: Distance between the wheels of a robot that doesn't steer, which no log shows [m].
    """
    deg = math.degrees
    lines = ["robot:"]
    if drive.top_speed is not None:
        lines.append(_line("  max_speed_mps", drive.top_speed, "no command makes it faster"))
    else:
        lines.append(f"  # its greatest speed is no less than {drive.fastest:.3g} m/s")
    if drive.accel is not None:
        half = _scaled(drive.accel, 1.0 / ACCEL_RESERVE)
        words = f"{drive.accel} m/s² at most, of which control needs a half"
        lines.append(_line("  max_accel_mps2", half, words))
    if drive.steering is None:
        turn = deg(drive.fastest_turn) / YAW_RESERVE
        words = "no greater one was driven; with a fifth left for control"
        lines.append(f"  max_yaw_rate_degps: {turn:.3g}  # {words}")
    if drive.yaw_accel is not None:
        kept, words = YAW_RESERVE, "with a fifth left for control"
        if drive.accels_are_shared:
            kept, words = ACCEL_RESERVE, "a half: the other half of its wheels' is the speed's"
        most = _scaled(drive.yaw_accel, deg(1.0) / kept)
        lines.append(_line("  max_yaw_accel_degps2", most, words))
    lines += [
        "  drive:",
        *(_wheels(drive, track) if drive.steering is None else _steering(drive.steering)),
        _line("    delay_s", drive.delay),
        _line("    lag_s", drive.lag),
        _noise("    speed_noise_mps", drive.speed_noise),
        _noise("    yaw_rate_noise_degps", _scaled(drive.yaw_noise, deg(1.0))),
        "  localization:",
        _noise("    position_noise_m", drive.position_noise),
        _noise("    heading_noise_deg", _scaled(drive.heading_noise, deg(1.0))),
    ]
    for what, share in (("drives at", drive.speed_share), ("turns at", drive.yaw_share)):
        if abs(1.0 - share.value) > max(SLIPS_FROM, 2.0 * share.spread):
            more = f"give it {1.0 / share.value:.3g} times as much"
            lines.append(f"# it {what} {share} of what it is told: {more}")
    return "\n".join(lines) + "\n"


def _wheels(drive: IdentifiedDrive, track: float) -> list[str]:
    slip = 1.0 - drive.yaw_share.value
    kind = f"differential: {{track_m: {track:g}}}"
    if slip > max(SLIPS_FROM, 2.0 * drive.yaw_share.spread):
        kind = f"skid_steer: {{track_m: {track:g}, slip: {min(slip, 0.99):.3g}}}"
    return [f"    {kind}  # the distance between its wheels: measure it"]


def _steering(steering: IdentifiedSteering) -> list[str]:
    lines = [
        "    ackermann:",
        f"      wheelbase_m: {steering.wheelbase:g}  # from the rear axle to the front: measure it",
    ]
    if steering.most is None:
        words = "no greater one was driven"
        lines.append(f"      max_steer_deg: {math.degrees(steering.widest):.3g}  # {words}")
    else:
        most = _scaled(steering.most, math.degrees(1.0))
        lines.append(_line("      max_steer_deg", most, "no command makes it steer farther"))
    if steering.rate is not None:
        rate = _scaled(steering.rate, math.degrees(1.0))
        lines.append(_line("      max_steer_rate_degps", rate))
    return lines


def _line(key: str, figure: Estimate, words: str = "") -> str:
    note = f"± {figure.spread:.2g}" + (f"; {words}" if words else "")
    return f"{key}: {figure.figure}  # {note}"


def _noise(key: str, figure: Estimate) -> str:
    """A line with as much noise as there may be: too little would be kept for less."""
    return f"{key}: {sum(figure):.3g}  # {figure}, both added"


def _scaled(figure: Estimate, by: float) -> Estimate:
    return Estimate(figure.value * by, figure.spread * by)
