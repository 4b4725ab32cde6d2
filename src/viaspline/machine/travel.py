"""Which way a body went, and how fast: of one that looks that way, and of one that needn't."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.kernels.tracking.drive_motion import (
    ROW_ACROSS,
    ROW_ALONG,
    ROW_HEADING,
    ROW_TIME,
    ROW_YAW_RATE,
)

STANDING_MPS = 1e-6
"""A body that is slower goes no way of its own, but the next one [m/s]."""


class Travel(NamedTuple):
    """The motion of a body's reference point.

    Attributes:
        courses: Directions of travel, running on over whole turns [rad], shape (n,).
        speeds: Over the ground [m/s], shape (n,).
        turn_rates: Of the course [rad/s], shape (n,).
    """

    courses: Floats
    speeds: Floats
    turn_rates: Floats


def travel_of(model: DriveModel, rows: Floats) -> Travel:
    """The travel of a drive's true motion.

    Args:
        model: The drive.
        rows: As of the kernel ``move``, shape (n, ROW).

    Returns:
        For a drive that can't move across, its heading, speed and yaw rate.
    """
    if model.actuators.max_across <= 0.0:
        return Travel(rows[:, ROW_HEADING], rows[:, ROW_ALONG], rows[:, ROW_YAW_RATE])
    speeds = np.hypot(rows[:, ROW_ALONG], rows[:, ROW_ACROSS])
    ways = rows[:, ROW_HEADING] + np.arctan2(rows[:, ROW_ACROSS], rows[:, ROW_ALONG])
    moving = np.flatnonzero(speeds > STANDING_MPS)
    if not moving.size:
        return Travel(rows[:, ROW_HEADING], speeds, np.zeros(len(rows)))
    following = np.minimum(np.searchsorted(moving, np.arange(len(rows))), moving.size - 1)
    courses = np.unwrap(ways[moving[following]])
    steps = np.maximum(np.diff(rows[:, ROW_TIME], prepend=rows[0, ROW_TIME] - 1.0), 1e-9)
    return Travel(courses, speeds, np.diff(courses, prepend=courses[0]) / steps)
