"""What a drive makes of commands: a lag of first order with limits, as the model of a mission has.

Delay only shifts it in time, so that it can be looked up at any delay.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.identify.drive_log import DriveLog
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.lagged_response import lagged_response

FINE_S, MOST_STEPS = 0.01, 12_000
"""Steps of the response [s]; longer ones for logs that would need more."""


@dataclass(frozen=True)
class ChannelLimits:
    """What holds for one of the two: the speed, or the yaw rate.

    Attributes:
        share: Of what is commanded, that is reached.
        slope: The greatest change per second.
        most: The greatest value.
    """

    share: float = 1.0
    slope: float = math.inf
    most: float = math.inf


@dataclass(frozen=True)
class WheelLimits:
    """What holds for two driven wheels, each with a motor of its own.

    Attributes:
        arm: How far from the middle each acts [m]; a body that is hard to turn has a shorter one.
        slope: The greatest change of a wheel's speed per second [m/s²].
    """

    arm: float
    slope: float


def fine_times(log: DriveLog) -> Floats:
    """The moments at which a response is reckoned [s], even, over all of a log."""
    step = max(FINE_S, log.seconds / MOST_STEPS)
    even: Floats = log.times[0] + step * np.arange(math.ceil(log.seconds / step) + 1)
    return even


def held(log: DriveLog, commands: Floats, times: Floats) -> Floats:
    """Commands at some moments: each holds until the next one."""
    rows = np.searchsorted(log.times, times + 1e-9, side="right") - 1
    told: Floats = commands[np.maximum(rows, 0)]
    return told


def response(
    commands: Floats, step: float, lag: float, limits: ChannelLimits, first: float
) -> Floats:
    """What follows commands, step by step, without delay.

    Args:
        commands: At even moments, shape (n,).
        step: Between them [s].
        lag: Time constant [s].
        limits: What holds.
        first: What it is at first.

    Returns:
        At the same moments, shape (n,).

    Example:
        >>> told = np.ones(101)
        >>> round(float(response(told, 0.01, 0.5, ChannelLimits(), 0.0)[50]), 3)
        0.632
    """
    wanted = _wanted(commands, limits)
    return lagged_response(wanted, _lag_share(step, lag), limits.slope * step, float(first))


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
        >>> told, wheels = (np.ones(101), np.ones(101)), WheelLimits(arm=0.25, slope=1.0)
        >>> either = (ChannelLimits(), ChannelLimits())
        >>> speeds, rates = wheel_response(told, 0.01, 0.0, either, wheels, (0.0, 0.0))
        >>> round(float(rates[74]), 6), round(float(rates[100]), 2)
        (0.0, 0.5)
    """
    share, most = _lag_share(step, lag), wheels.slope * step
    speed, turn = (_wanted(told, one) for told, one in zip(commands, limits, strict=True))
    left, right = (
        lagged_response(speed + arm * turn, share, most, float(first[0] + arm * first[1]))
        for arm in (-wheels.arm, wheels.arm)
    )
    return 0.5 * (left + right), (right - left) / (2.0 * wheels.arm)


def _wanted(commands: Floats, limits: ChannelLimits) -> Floats:
    return np.clip(limits.share * commands, -limits.most, limits.most)


def _lag_share(step: float, lag: float) -> float:
    """Of what is missing, that comes within a step."""
    return 1.0 if lag <= 0.0 else 1.0 - math.exp(-step / lag)


def summed(values: Floats, step: float) -> Floats:
    """The integral of even values from the first on, shape (n,)."""
    middles = 0.5 * (values[1:] + values[:-1])
    return np.concatenate(([0.0], np.cumsum(middles) * step))
