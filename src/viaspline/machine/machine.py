"""The machine of a mission's robot: its kind, its limits, its faults, the gains of its control."""

from __future__ import annotations

import math

from viaspline.kernels.tracking.drive_model import (
    ACKERMANN,
    DIFFERENTIAL,
    POINT,
    SKID_STEER,
    Machine,
)
from viaspline.mission.robot_parts import RobotSpec

PERIOD = 0.05
"""Time between two commands, if nothing else is said [s]."""

RESERVE = 1.25
"""What control may ask of the yaw rate beyond what the time law plans with."""
STAIRS = 2.0
"""The same of the acceleration: a command that is held for a period makes stairs of a slope."""

SPOT = 1.0  # yaw rate of a turn on the spot, if the drive has no limit of its own [rad/s]
AIM_TIME = 0.6  # of a sweep over examples, lags and noise, see benchmarks/README.md [s]
AIM = 0.3  # [m]
LAGS = 4.0  # a control loop is so many times slower than its lag: then it is damped well
GAIN = 1.0  # of the error along the path [1/s]
TURN_GAIN = 2.0  # of the heading on the spot [1/s]
ROOM, ROOM_TIME = 0.05, 0.15  # how far it may lag behind [m], [s]


def is_driven(robot: RobotSpec) -> bool:
    """Whether a robot moves by a machine's laws, or doesn't know where it is exactly."""
    return robot.drive is not None or robot.localization is not None


def machine_of(robot: RobotSpec, period: float = PERIOD) -> Machine:
    """What the kernels have to know of a robot's drive.

    Args:
        robot: Of the mission; without a drive it moves as it is commanded.
        period: Time between two commands [s].

    Example:
        >>> robot = RobotSpec(drive={"differential": {"track_m": 0.5}, "delay_s": 0.1})
        >>> machine_of(robot).delay
        0.1
    """
    drive, place = robot.drive, robot.localization
    lag = 0.0 if drive is None else drive.lag_s
    slow = 1.0 / (LAGS * (lag + 0.5 * period))
    noise = 0.0 if place is None else place.position_noise_m
    kind, length, grip, wheel = _wheels(robot)
    yaw = math.radians(robot.max_yaw_rate_degps or math.inf)
    yaw_accel = math.radians(robot.max_yaw_accel_degps2 or math.inf)
    turn, turn_rate = RESERVE * yaw, RESERVE * yaw_accel
    if drive is not None and drive.ackermann is not None:
        turn = math.radians(drive.ackermann.max_steer_deg)
        turn_rate = math.radians(drive.ackermann.max_steer_rate_degps or math.inf)
    return Machine(
        kind=kind,
        length=length,
        grip=grip,
        wheel=wheel,
        turn=turn,
        turn_rate=turn_rate,
        speed=robot.max_speed_mps,
        accel=STAIRS * max(robot.max_accel_mps2, robot.max_brake_mps2 or 0.0),
        delay=0.0 if drive is None else drive.delay_s,
        lag=lag,
        spot=min(SPOT, yaw, 2.0 * wheel * grip / length if length > 0.0 else math.inf),
        aim_time=max(AIM_TIME, LAGS * lag),
        aim=AIM,
        gain=min(GAIN, slow),
        turn_gain=min(TURN_GAIN, slow),
        room=ROOM + 3.0 * noise,
        room_time=ROOM_TIME,
        speed_noise=0.0 if drive is None else drive.speed_noise_mps,
        yaw_noise=0.0 if drive is None else math.radians(drive.yaw_rate_noise_degps),
    )


def _wheels(robot: RobotSpec) -> tuple[int, float, float, float]:
    """Kind, track or wheelbase [m], what slipping leaves of a turn, fastest wheel [m/s]."""
    drive = robot.drive
    if drive is None:
        return POINT, 0.0, 1.0, math.inf
    if drive.ackermann is not None:
        return ACKERMANN, drive.ackermann.wheelbase_m, 1.0, math.inf
    if drive.differential is not None:
        sides = drive.differential
        return DIFFERENTIAL, sides.track_m, 1.0, sides.max_wheel_speed_mps or math.inf
    assert drive.skid_steer is not None
    tracks = drive.skid_steer
    return SKID_STEER, tracks.track_m, 1.0 - tracks.slip, tracks.max_wheel_speed_mps or math.inf
