"""Velocities as a sensor tells them: with noise that depends on the seed and the look alone.

Tested through ``robot/perception/moving/test_motion_sensor``.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.fields import SPEEDS_MPS

MAX_NOISE_SIGMAS: Final = 3.0
"""Noise is cut off at so many standard deviations."""

ROUNDING: Final = 1e-9
"""Part of a speed."""


def told_velocities(
    velocities: Floats, noise: float, seed: int, number: int
) -> list[tuple[float, ...]]:
    """Velocities with noise, never more than anything has.

    Args:
        velocities: As they are [m/s], (n, d).
        noise: Standard deviation of each of their coordinates [m/s].
        seed: For the noise.
        number: Of the look; looks with the same number have the same noise.
    """
    drawn = np.random.default_rng((seed, number)).standard_normal(velocities.shape)
    cut: Floats = np.clip(drawn, -MAX_NOISE_SIGMAS, MAX_NOISE_SIGMAS)
    return [_within_limits(row) for row in (velocities + noise * cut).tolist()]


def _within_limits(velocity: list[float]) -> tuple[float, ...]:
    """A velocity that is no faster than anything [m/s]."""
    too_fast = max(math.hypot(*velocity) / (SPEEDS_MPS[1] * (1.0 - ROUNDING)), 1.0)
    return tuple(each / too_fast for each in velocity)
