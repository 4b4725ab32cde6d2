"""Steering angles and yaw rates of a robot whose front wheels steer, as a bicycle.

Tested through ``identify/test_fit_drive``.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats

LEAST_MPS: Final = 1e-3
"""A robot that is slower doesn't steer [m/s]."""


def angles_for(speeds: Floats, yaw_rates: Floats, wheelbase: float) -> Floats:
    """The steering angle that gives each yaw rate at its speed [rad]; 0 at rest.

    Args:
        speeds: [m/s], shape (n,).
        yaw_rates: [rad/s], shape (n,).
        wheelbase: [m].

    Example:
        >>> angles_for(np.array([1.0, 0.0]), np.array([0.5, 0.5]), wheelbase=2.0).round(3)
        array([0.785, 0.   ])
    """
    moves = np.abs(speeds) > LEAST_MPS
    steered = np.arctan(wheelbase * yaw_rates / np.where(moves, speeds, 1.0))
    angles: Floats = np.where(moves, steered, 0.0)
    return angles


def yaw_rates_of(speeds: Floats, angles: Floats, wheelbase: float) -> Floats:
    """The yaw rate that follows from each speed and steering angle [rad/s].

    Example:
        >>> yaw_rates_of(np.array([1.0]), np.array([0.7853981634]), wheelbase=2.0).round(6)
        array([0.5])
    """
    return speeds * np.tan(angles) / wheelbase
