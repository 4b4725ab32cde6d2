"""A drive that shows what there is to know of a robot: steps of speed and of yaw rate, up and down.

The robot drives this without any feedback, on free and even ground.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.errors import GeometryError
from viaspline.handed_in import time_from
from viaspline.identify.drive_log import DriveLog
from viaspline.kernels.arrays import Floats

PIECES = (
    (1.0, 0.0, 0.0), (2.0, 0.3, 0.0), (3.0, 1.0, 0.0), (1.6, 0.0, 0.0),
    (1.5, 0.5, 0.8), (1.5, 0.5, -0.8), (0.7, 0.8, 0.5), (1.3, 0.8, -0.5), (0.9, 0.3, 1.0),
    (1.4, 0.6, 0.0), (2.6, 0.5, 1.0), (0.6, 1.0, 0.4), (0.6, 0.4, -0.4), (0.6, 1.0, 0.3),
    (1.5, 0.0, 0.0), (2.2, 1.0, 0.0), (1.1, 0.4, 1.0), (1.1, 0.4, -1.0), (2.6, 0.5, 1.0),
    (0.4, 0.9, 0.0), (0.4, 0.5, 0.6), (0.8, 0.9, -0.6), (0.4, 0.5, 0.6), (1.5, 0.0, 0.0),
    (2.0, 1.0, 0.3), (2.0, 0.7, -0.5), (2.6, 0.5, 1.0), (3.0, 1.0, 0.0), (2.0, 0.0, 0.0),
)  # fmt: skip
"""For how long [s], and the speed and the yaw rate as shares of the greatest."""

SHORTEST_PERIOD_S = 1e-3
LONGEST_PERIOD_S = 0.2  # each piece has two commands at least


def standard_commands(
    max_speed: float, max_yaw_rate: float, period: float, turn_radius: float = 0.0
) -> Floats:
    """When to give which command: time [s], speed [m/s] and yaw rate [rad/s], shape (n, 3).

    Args:
        max_speed: The greatest speed [m/s].
        max_yaw_rate: The greatest yaw rate [rad/s].
        period: From command to command [s].
        turn_radius: Of the tightest circle of a robot that steers [m]; 0: it turns on the spot.

    Raises:
        GeometryError: When one of them is not above 0, or the period not from 1 ms to 0.2 s.

    Example:
        >>> commands = standard_commands(1.0, 0.8, 0.05)
        >>> commands.shape, round(float(commands[-1, 0]), 2)
        ((858, 3), 42.85)
    """
    speed, rate = time_from("max_speed", max_speed), time_from("max_yaw_rate", max_yaw_rate)
    period = time_from("period", period)
    if not SHORTEST_PERIOD_S <= period <= LONGEST_PERIOD_S:
        raise GeometryError(
            f"period is {period:g} s; give {SHORTEST_PERIOD_S:g} to {LONGEST_PERIOD_S:g} s, "
            "so that every piece of the drive has its commands"
        )
    ends = np.cumsum([seconds for seconds, _, _ in PIECES])
    times = period * np.arange(math.floor(float(ends[-1]) / period + 1e-9))
    which = np.searchsorted(ends, times + 1e-9, side="right")
    shares = np.array([(a, b) for _, a, b in PIECES])[np.minimum(which, len(PIECES) - 1)]
    speeds = speed * shares[:, 0]
    greatest = np.minimum(rate, speeds / turn_radius) if turn_radius > 0.0 else rate
    return np.column_stack((times, speeds, greatest * shares[:, 1]))


def room_of(commands: Floats) -> tuple[float, float, float, float]:
    """The ground that commands take by themselves: ahead, behind, left and right of the start [m].

    Args:
        commands: Time, speed and yaw rate, shape (n, 3).
    """
    steps = np.diff(commands[:, 0], append=2.0 * commands[-1, 0] - commands[-2, 0])
    heading = np.cumsum(commands[:, 2] * steps)
    x = np.cumsum(commands[:, 1] * steps * np.cos(heading))
    y = np.cumsum(commands[:, 1] * steps * np.sin(heading))
    ahead, behind, left, right = (float(far) for far in (x.max(), -x.min(), y.max(), -y.min()))
    return max(0.0, ahead), max(0.0, behind), max(0.0, left), max(0.0, right)  # and no -0.0


def commands_csv(commands: Floats) -> str:
    """Commands as the text of a CSV file, with the names that a log has for them."""
    lines = ["time_s,speed_command_mps,yaw_rate_command_radps"]
    lines += [f"{t:.3f},{v:.4f},{w:.4f}" for t, v, w in commands.tolist()]
    return "\n".join(lines) + "\n"


def as_log(commands: Floats, places: Floats, headings: Floats) -> DriveLog:
    """A log of commands, and where they brought a robot.

    Args:
        commands: Time, speed and yaw rate, shape (n, 3).
        places: When each was given [m], shape (n, 2).
        headings: Then [rad], shape (n,).
    """
    return DriveLog(
        commands[:, 0], places[:, 0], places[:, 1], headings, commands[:, 1], commands[:, 2]
    )
