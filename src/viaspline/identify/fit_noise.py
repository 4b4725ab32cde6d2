"""The noise of a drive and of what is measured, from what a fitted model leaves unexplained.

White noise of poses shows in differences over any time alike; noise of the drive, which keeps for
about half a second, adds up with it. So both are told apart by how differences grow with time.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.identify.identified_drive import Estimate
from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.tracking.drive_model import NOISE_TIME_S

HORIZONS_S = (0.0, 0.1, 0.2, 0.4, 0.8, 1.6)
"""Over which differences are taken [s]; the first is from row to row."""

BLOCKS, DRAWS = 20, 100
"""Of the bootstrap."""


SPREAD_MARGIN = 1.5
"""By which a spread is wider than the bootstrap's, which is too narrow of so few blocks."""


class FittedNoise(NamedTuple):
    """Standard deviations: of what is driven, per second, and of what is measured."""

    driven: Estimate
    measured: Estimate


def fit_noise(times: Floats, rest: Floats, moves: Flags, seed: int) -> FittedNoise:
    """The noise in what a model leaves unexplained.

    Args:
        times: [s], shape (n,).
        rest: Measured less modelled, which drifts: [m] or [rad], shape (n,).
        moves: Where the robot moves, shape (n,); the drive's noise acts only there.
        seed: Of the resamples.

    Example:
        >>> noise = np.random.default_rng(1).normal(0.0, 0.02, 2000)
        >>> times = 0.05 * np.arange(2000)
        >>> found = fit_noise(times, noise, np.ones(2000, bool), seed=0)
        >>> round(found.measured.value, 3), found.driven.value < 0.01
        (0.02, True)
    """
    step = float(np.median(np.diff(times)))
    rows, lags, squares, block = [], [], [], []
    for horizon in HORIZONS_S:
        k = max(round(horizon / step), 1)
        if k in lags or k >= len(times) // 4:
            continue
        lags.append(k)
        change = rest[k:] - rest[:-k]
        change = change - np.mean(change)
        use = moves[k:] & moves[:-k]
        where = np.flatnonzero(use)
        if not where.size:
            where = np.arange(len(change))
        seconds = k * step
        rows.append((2.0, driven_variance(seconds)))
        squares.append(change[where] ** 2)
        block.append((where * BLOCKS) // len(change))
    design = np.array(rows)
    chance = np.random.default_rng(seed)
    whole = _solved(design, np.array([one.mean() for one in squares]))
    drawn = []
    for _ in range(DRAWS):
        count = np.bincount(chance.integers(0, BLOCKS, BLOCKS), minlength=BLOCKS)
        means = [
            float(np.average(one, weights=count[b])) if count[b].any() else float(one.mean())
            for one, b in zip(squares, block, strict=True)
        ]
        drawn.append(_solved(design, np.array(means)))
    spread = SPREAD_MARGIN * np.std(np.sqrt(np.array(drawn)), axis=0)
    return FittedNoise(
        Estimate(math.sqrt(whole[1]), float(spread[1])),
        Estimate(math.sqrt(whole[0]), float(spread[0])),
    )


def driven_variance(seconds: float) -> float:
    """Variance of what noise of 1 adds to what is driven in a time [s²]; see ``DriveNoise``.

    >>> round(driven_variance(0.01), 6), round(driven_variance(100.0), 2)
    (9.9e-05, 99.5)
    """
    keep = NOISE_TIME_S
    return 2.0 * keep * (seconds - keep * (1.0 - math.exp(-seconds / keep)))


def _solved(design: Floats, variances: Floats) -> Floats:
    """Variances of what is measured and of what is driven, each horizon weighed alike."""
    from scipy.optimize import nnls

    scale = 1.0 / np.maximum(variances, 1e-15)
    found, _ = nnls(design * scale[:, None], variances * scale)
    return np.asarray(found, np.float64)
