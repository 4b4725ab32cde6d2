"""What two driven wheels, each with a motor of its own, make of commands.

Tested through ``identify/test_fit_drive``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.identify.drive_response import ChannelLimits, lag_share, wanted
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.lagged_response import lagged_response


@dataclass(frozen=True)
class WheelLimits:
    """What holds for two driven wheels, each with a motor of its own.

    Attributes:
        arm: How far from the middle each acts [m]; a body that is hard to turn has a shorter one.
        slope: The greatest change of a wheel's speed per second [m/s²].
    """

    arm: float
    slope: float


def wheel_response(
    commands: tuple[Floats, Floats],
    step: float,
    lag: float,
    limits: tuple[ChannelLimits, ChannelLimits],
    wheels: WheelLimits,
    first: tuple[float, float],
) -> tuple[Floats, Floats]:
    """The speed and the yaw rate that follow commands of both, by two wheels, without delay.

    While both motors give what they can to drive off, nothing is left to turn with: the robot turns
    when its inner wheel has got to its speed.

    Args:
        commands: Speeds and yaw rates at even moments, each of shape (n,).
        step: Between them [s].
        lag: Time constant [s].
        limits: What holds for each, but for the slopes.
        wheels: What holds for the wheels.
        first: What both are at first.

    Returns:
        Both at the same moments.

    Example:
        >>> import numpy as np
        >>> told, wheels = (np.ones(101), np.ones(101)), WheelLimits(arm=0.25, slope=1.0)
        >>> either = (ChannelLimits(), ChannelLimits())
        >>> speeds, rates = wheel_response(told, 0.01, 0.0, either, wheels, (0.0, 0.0))
        >>> round(float(rates[74]), 6), round(float(rates[100]), 2)
        (0.0, 0.5)
    """
    share, most = lag_share(step, lag), wheels.slope * step
    speed, turn = (wanted(told, one) for told, one in zip(commands, limits, strict=True))
    left, right = (
        lagged_response(speed + arm * turn, share, most, float(first[0] + arm * first[1]))
        for arm in (-wheels.arm, wheels.arm)
    )
    return 0.5 * (left + right), (right - left) / (2.0 * wheels.arm)
