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
    to = wanted(commands, limits)
    return lagged_response(to, lag_share(step, lag), limits.slope * step, float(first))


def wanted(commands: Floats, limits: ChannelLimits) -> Floats:
    """What commands ask for that can be reached."""
    return np.clip(limits.share * commands, -limits.most, limits.most)


def lag_share(step: float, lag: float) -> float:
    """Of what is missing, that comes within a step."""
    return 1.0 if lag <= 0.0 else 1.0 - math.exp(-step / lag)


def summed(values: Floats, step: float) -> Floats:
    """The integral of even values from the first on, shape (n,)."""
    middles = 0.5 * (values[1:] + values[:-1])
    return np.concatenate(([0.0], np.cumsum(middles) * step))
