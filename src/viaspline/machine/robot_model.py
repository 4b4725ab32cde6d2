"""The drive model of a mission's robot: actuators, limits, faults, and the gains of its control."""

from __future__ import annotations

import math

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spot_turning import (
    LAGS_PER_LOOP,
    PERIOD_S,
    actuators_of,
    heading_gain_of,
    lag_of,
    spot_rate_of,
)

YAW_RESERVE = 1.25
"""What control may ask of the yaw rate beyond what the time law plans with, as a factor."""

ACCEL_RESERVE = 2.0
"""What it may ask of the acceleration: a command that is held for a period makes stairs of a
slope."""

CONVERGENCE_TIME_S, CONVERGENCE_DISTANCE_M = 0.6, 0.3
"""Over what a deviation dies out: from sweeps over examples, lags and noise, see
benchmarks/README.md [s], [m]."""

PERIODS_PER_LOOP = 2.0
"""And over no less than so many times between two commands: a loop that corrects sooner than it
measures swings [periods]."""

STEERED_SWING_RAD = 0.2
"""By so much a heading may be off and steering still keeps up with what control asks of it, so that
it dies out: of 0.05 to 0.45 this is off least over slow steering and noise [rad]."""

ALONG_GAIN_PER_S = 1.0
"""Of an error along the path [1/s]."""

SLACK_M, SLACK_TIME_S = 0.05, 0.15
"""How far a robot may lag behind before its clock waits, at rest [m] and per speed [s]."""


def drive_model_of(robot: RobotSpec, period: float = PERIOD_S) -> DriveModel:
    """What the kernels have to know of a robot's drive.

    Args:
        robot: Of the mission; without a drive it moves as it is commanded.
        period: Time between two commands [s].

    Example:
        >>> robot = RobotSpec(drive={"differential": {"track_m": 0.5}, "delay_s": 0.1})
        >>> drive_model_of(robot).delay
        0.1
    """
    drive, place = robot.drive, robot.localization
    actuators, lag = actuators_of(robot), lag_of(robot)
    slow = 1.0 / (LAGS_PER_LOOP * (lag + 0.5 * period))
    noise = 0.0 if place is None else place.position_noise_m
    yaw = math.radians(robot.max_yaw_rate_degps or math.inf)
    yaw_accel = math.radians(robot.max_yaw_accel_degps2 or math.inf)
    turn, turn_rate = YAW_RESERVE * yaw, YAW_RESERVE * yaw_accel
    if actuators.wheelbase > 0.0:
        turn, turn_rate = actuators.max_steer, actuators.max_steer_rate
    speed = robot.max_speed_mps
    return DriveModel(
        actuators=actuators,
        max_turn=turn,
        max_turn_rate=turn_rate,
        max_speed=speed,
        max_accel=ACCEL_RESERVE * max(robot.max_accel_mps2, robot.max_brake_mps2 or 0.0),
        delay=0.0 if drive is None else drive.delay_s,
        lag=lag,
        spot_rate=spot_rate_of(robot),
        convergence_time=max(CONVERGENCE_TIME_S, LAGS_PER_LOOP * lag, PERIODS_PER_LOOP * period),
        convergence_distance=max(CONVERGENCE_DISTANCE_M, steered_distance(actuators, speed)),
        along_gain=min(ALONG_GAIN_PER_S, slow),
        heading_gain=heading_gain_of(robot, period),
        slack=SLACK_M + 3.0 * noise,
        slack_time=SLACK_TIME_S,
        speed_noise=0.0 if drive is None else drive.speed_noise_mps,
        yaw_noise=0.0 if drive is None else math.radians(drive.yaw_rate_noise_degps),
    )


def steered_distance(actuators: Actuators, speed: float) -> float:
    r"""The least distance over which steering of a limited rate lets a deviation die out [m].

    Over the distance L a heading that is off by h asks for the curvature 2 h / L, so for the
    steering angle 2 w h / L with the wheelbase w, and for that again and again within the time
    L / v. Steering that turns no faster than r keeps up with that while
    :math:`L^2 \ge 2 w h v / r`; on a shorter L it is late, and the robot swings ever farther.

    Args:
        actuators: Of the drive; its steering rate is infinite if it has no limit [rad/s].
        speed: Its greatest [m/s].
    """
    if actuators.wheelbase <= 0.0:
        return 0.0
    asked = 2.0 * actuators.wheelbase * STEERED_SWING_RAD * speed
    return math.sqrt(asked / actuators.max_steer_rate)


def steers_slowly(robot: RobotSpec) -> bool:
    """Whether it is its steering that tells how soon a robot at full speed is back on its path."""
    steered = steered_distance(actuators_of(robot), robot.max_speed_mps)
    return steered > max(CONVERGENCE_DISTANCE_M, CONVERGENCE_TIME_S * robot.max_speed_mps)
