"""A drive whose poses and commands were recorded each by its own times, as one log."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from viaspline.errors import GeometryError
from viaspline.identify.drive_log import DriveLog

SAME_S = 1e-6  # instants that are nearer to each other are one


def merged_log(
    times: ArrayLike, poses: ArrayLike, command_times: ArrayLike, commands: ArrayLike
) -> DriveLog:
    """One log of poses and commands: a row for each of their instants.

    Where a command came between two poses, the robot is taken to have been between them as well:
    by moving the command to a pose its delay would be off by half a period.

    Args:
        times: Of the poses, increasing [s], shape (n,).
        poses: x, y [m] and heading [rad], shape (n, 3).
        command_times: Never decreasing [s], shape (m,).
        commands: Along the body [m/s] and the yaw rate [rad/s], shape (m, 2).

    Raises:
        GeometryError: There are no poses or no commands, or they make no log.

    >>> t = np.arange(0.0, 10.0, 0.1)
    >>> poses = np.column_stack((t, 0 * t, 0 * t))
    >>> log = merged_log(t, poses, [0.05, 5.05], [[1.0, 0.0], [0.5, 0.0]])
    >>> log.times[:3].tolist(), log.x[:2].tolist(), log.speeds[[0, 1, -1]].tolist()
    ([0.0, 0.05, 0.1], [0.0, 0.05], [0.0, 1.0, 0.5])
    """
    t, p = np.asarray(times, np.float64), np.asarray(poses, np.float64)
    given, told = np.asarray(command_times, np.float64), np.asarray(commands, np.float64)
    if not len(t) or not len(given):
        raise GeometryError("a log needs poses and commands; record odometry and cmd_vel")
    within = given[(given > t[0]) & (given < t[-1])]
    rows = np.union1d(t, within)
    rows = rows[np.concatenate(([True], np.diff(rows) > SAME_S))]
    turned = np.unwrap(p[:, 2])
    x, y, heading = (np.interp(rows, t, column) for column in (p[:, 0], p[:, 1], turned))
    last = np.searchsorted(given, rows + SAME_S, side="right") - 1
    held = np.where(last[:, None] >= 0, told[np.maximum(last, 0)], 0.0)  # nothing: it stands
    return DriveLog(rows, x, y, heading, held[:, 0], held[:, 1])
