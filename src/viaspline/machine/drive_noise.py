"""What is random about a drive: seeded noise of the drive and of the localisation."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec

MAX_DEVIATIONS = 3.0
"""No error of a measured state is greater than so many standard deviations."""


class DriveNoise:
    """Streams of noise; what they give depends on the seed and on how much was drawn, only.

    The measured position and heading are off by Gaussian noise, cut off at three standard
    deviations, anew at every measurement. The speed and the yaw rate that are driven are off by
    noise that keeps for about half a second (an Ornstein–Uhlenbeck process; see the kernels): a
    wheel that slips goes on slipping for a while, and that is harder on a controller than noise
    that averages out within its period.

    Args:
        robot: Its drive and localisation.
        seed: Of both streams.

    Example:
        >>> noise = DriveNoise(RobotSpec(localization={"position_noise_m": 0.1}), seed=1)
        >>> noise.measured(2).shape, noise.driven(4).shape
        ((2, 3), (4, 2))
    """

    def __init__(self, robot: RobotSpec, seed: int) -> None:
        place = robot.localization
        position = 0.0 if place is None else place.position_noise_m
        heading = 0.0 if place is None else math.radians(place.heading_noise_deg)
        self._sizes = np.array([position, position, heading])
        self._localization = np.random.default_rng((abs(seed), 1))
        self._drive = np.random.default_rng((abs(seed), 2))

    def measured(self, count: int) -> Floats:
        """The next errors of the measured x, y [m] and heading [rad], shape (count, 3)."""
        noise = self._localization.standard_normal((count, 3))
        return self._sizes * np.clip(noise, -MAX_DEVIATIONS, MAX_DEVIATIONS)

    def driven(self, count: int) -> Floats:
        """The next standard normal numbers for speed and yaw rate, shape (count, 2)."""
        return self._drive.standard_normal((count, 2))
