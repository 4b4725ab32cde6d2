"""How a robot with a drive comes to stand once its law rests: it is told to brake, not to stand.

Told to stand, one with a lag rolls on ever more slowly; told to go back for one period, it stands
at the end of that.
"""

from __future__ import annotations

import math
from typing import Final

from viaspline.kernels.tracking.drive_model import DriveModel

STILL_MPS: Final = 1e-3
"""A robot that is slower stands [m/s]."""


def stilling_command(model: DriveModel, speed: float, period: float) -> float:
    r"""The speed that a drive is told to have so that it stands when a period is over [m/s].

    After it the speed is :math:`c + (v - c) e^{-T / lag}` by a command c: none for the one below.

    Args:
        model: The drive.
        speed: When the command takes effect, along the body or across it [m/s].
        period: Until the next one does [s].

    Example:
        >>> from viaspline.machine.robot_model import drive_model_of
        >>> from viaspline.mission.robot_parts import RobotSpec
        >>> drive = {"differential": {"track_m": 0.5}, "lag_s": 0.1}
        >>> round(stilling_command(drive_model_of(RobotSpec(drive=drive)), 0.1, 0.05), 3)
        -0.154
    """
    if abs(speed) < STILL_MPS or model.lag <= 0.0 or period <= 0.0:
        return 0.0
    gone = -math.expm1(-period / model.lag)
    return -speed * (1.0 - gone) / gone


def settling_time(model: DriveModel, speed: float, period: float) -> float:
    """For how long a robot that is to stand still moves, from when it is told so [s].

    It has been told something else for up to a period, and the next one stills it, if its drive can
    brake by so much in that time.

    Args:
        model: Its drive.
        speed: The most it has then [m/s].
        period: From one command to the next [s].

    Example:
        >>> from viaspline.machine.robot_model import drive_model_of
        >>> from viaspline.mission.robot_parts import RobotSpec
        >>> round(settling_time(drive_model_of(RobotSpec()), 0.05, 0.05), 3)
        0.1
    """
    return period + max(speed / model.max_accel, period)


def settled_after_law(model: DriveModel, brake: float, period: float) -> float:
    """For how long a robot may still move after its law has braked to a rest [s].

    Until then it is no faster than its law was one lag and one period before, and what brings it up
    that is behind.

    Args:
        model: Its drive.
        brake: With which the law comes to its rest [m/s²].
        period: From one command to the next [s].
    """
    speed = brake * (model.lag + period) + model.along_gain * model.slack
    return settling_time(model, min(speed, model.max_speed), period)
