"""What a machine's own limits ask of the time law."""

from __future__ import annotations

import math
from dataclasses import replace

from viaspline.machine.machine import is_driven
from viaspline.mission.robot_parts import RobotSpec
from viaspline.trajectory.limits import REACTION_S, Limits

STRAIGHT = 0.8
"""Part of a wheel's speed that is used at most on the straight; the rest is for turning."""
GRIP = 5.0
"""Acceleration across the path that tyres stand [m/s²], for machines without a limit of it."""


def limits_of(robot: RobotSpec, reaction: float = REACTION_S) -> Limits:
    """The limits of a mission's robot, with what its machine and its sensor allow.

    The time between two looks of the sensor is longer by the delay and the lag of the drive: so
    much later it brakes. The outer wheel turns at v (1 + |curvature| track/2): a limit v of the
    speed and one of the yaw rate share what it can. Steered wheels turn no faster than they can.

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
        return _gripping(Limits.of(robot, reaction))
    limits = _gripping(Limits.of(robot, reaction + drive.delay_s + drive.lag_s))
    steered = drive.ackermann
    if steered is not None and steered.max_steer_rate_degps is not None:
        rate = math.radians(steered.max_steer_rate_degps)
        return replace(limits, max_steer_rate=rate, wheelbase=steered.wheelbase_m)
    sides = drive.differential or drive.skid_steer
    if sides is None or sides.max_wheel_speed_mps is None:
        return limits
    wheel, grip = sides.max_wheel_speed_mps, 1.0
    if drive.skid_steer is not None:
        grip -= drive.skid_steer.slip
    speed = min(limits.max_speed, STRAIGHT * wheel)
    rate = 2.0 * grip * (wheel - speed) / sides.track_m
    return replace(limits, max_speed=speed, max_yaw_rate=min(rate, limits.max_yaw_rate or rate))


def _gripping(limits: Limits) -> Limits:
    """With an end of what can be asked across the path: so corners are places to stop at."""
    return replace(limits, max_lateral_accel=limits.max_lateral_accel or GRIP)
