"""What a robot's drive asks of the time law, beside what the robot asks."""

from __future__ import annotations

import math
from dataclasses import replace

from viaspline.mission.drives.drive_limits import DriveLimits
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spot_turning import is_driven
from viaspline.trajectory.limits import REACTION_S, Limits

TURN_RADPS = 3.0
"""Yaw rate of a body that turns, for robots without a limit of it [rad/s]."""

TYRE_ACCEL_MPS2 = 5.0
"""Acceleration across the path that tyres stand [m/s²], for robots without a limit of it."""


def limits_of(robot: RobotSpec, reaction: float = REACTION_S) -> Limits:
    """The limits of a mission's robot, with what its drive and its sensor allow.

    The time between two looks of the sensor is longer by the delay and the lag of the drive: so
    much later it brakes. A body that keeps its heading doesn't turn, whatever the path does.

    Args:
        robot: The robot of the mission.
        reaction: Time that can pass between two looks of the sensor [s].

    Raises:
        GeometryError: If the sensor sees no farther than the robot's own body.

    Example:
        >>> wheels = {"track_m": 0.5, "max_wheel_speed_mps": 1.0}
        >>> limits = limits_of(RobotSpec(drive={"differential": wheels}))
        >>> limits.max_speed, round(limits.max_yaw_rate, 9)
        (0.8, 0.8)
    """
    if not is_driven(robot):
        return Limits.of(robot, reaction)
    drive = robot.drive
    if drive is None:
        return _with_turns(_with_tyres(Limits.of(robot, reaction)))
    limits = _with_tyres(Limits.of(robot, reaction + drive.delay_s + drive.lag_s))
    kind = drive.kind
    limits = _with_drive(limits, kind.limits(limits.max_speed, limits.max_accel))
    if kind.turn_radius is not None:
        return limits
    if kind.held_heading is None:
        return _with_turns(limits)
    return replace(limits, max_yaw_rate=None, max_yaw_accel=None, axis_heading=kind.held_heading)


def _with_tyres(limits: Limits) -> Limits:
    """With an end of what can be asked across the path: so corners are places to stop at."""
    return replace(limits, max_lateral_accel=limits.max_lateral_accel or TYRE_ACCEL_MPS2)


def _with_turns(limits: Limits) -> Limits:
    """With an end of what can be asked of its turns: in a cusp any speed would ask for more."""
    return replace(limits, max_yaw_rate=limits.max_yaw_rate or TURN_RADPS)


def _with_drive(limits: Limits, asked: DriveLimits) -> Limits:
    """With what a drive asks where that is less."""
    return replace(
        limits,
        max_speed=min(limits.max_speed, _or_inf(asked.max_speed)),
        max_lateral_accel=_least(limits.max_lateral_accel, asked.max_lateral_accel),
        max_yaw_rate=_least(limits.max_yaw_rate, asked.max_yaw_rate),
        max_steer_rate=asked.max_steer_rate,
        wheelbase=asked.wheelbase,
        axis_speed=asked.body_speed,
    )


def _least(one: float | None, other: float | None) -> float | None:
    least = min(_or_inf(one), _or_inf(other))
    return least if math.isfinite(least) else None


def _or_inf(limit: float | None) -> float:
    return math.inf if limit is None else limit
