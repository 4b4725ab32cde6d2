"""Newton's method for the fastest v² with a limit of the jerk.

The second derivative of the barrier is a narrow band, so a step takes as long as its stretches.

Tested through ``kernels/timing/test_speed_barrier``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.timing.speed_barrier import BarrierTerms, derivatives, time_of, value_of

LEAST_DROP = 1e-8  # of the barrier in a step that is worth it, as a part of 1 + its value
LEAST_PART = 1e-8  # of a step
KEPT_DROP = 0.1  # part of what a step promises that it has to keep
REGULAR = 1e-14  # part of every entry of a matrix's diagonal that is added to it


@inner
def _solved(bands: Floats, count: int, n: int, right: Floats) -> bool:
    """Solve for a right-hand side in place, by Cholesky; False if the matrix isn't definite."""
    for j in range(n):
        if not bands[j] > 0.0:
            return False
        bands[j] = math.sqrt(bands[j])
        last = min(count - 1, n - 1 - j)
        for k in range(1, last + 1):
            bands[k * n + j] /= bands[j]
        for k in range(1, last + 1):
            for i in range(k, last + 1):
                bands[(i - k) * n + j + k] -= bands[i * n + j] * bands[k * n + j]
    for j in range(n):
        for k in range(1, min(count - 1, j) + 1):
            right[j] -= bands[k * n + j - k] * right[j - k]
        right[j] /= bands[j]
    for j in range(n - 1, -1, -1):
        for k in range(1, min(count - 1, n - 1 - j) + 1):
            right[j] -= bands[k * n + j] * right[j + k]
        right[j] /= bands[j]
    return True


@inner
def least_from(terms: BarrierTerms, m: Floats, sharpness: float, rounds: int) -> Floats:
    """The least of the barrier, from coefficients on that keep every limit strictly."""
    n = m.shape[0]
    m, new = m.copy(), np.empty(n)
    gradient, right, step = np.empty(n), np.empty(n), np.empty(n)
    bands = np.empty(terms.bands * n + 1)
    value = value_of(terms, m, sharpness)
    for _ in range(rounds):
        derivatives(terms, m, sharpness, gradient, bands)
        for i in range(n):
            right[terms.order[i]] = gradient[i]
            bands[i] += REGULAR * bands[i]  # beside a cusp they are 1e20 times those elsewhere
        if not _solved(bands, terms.bands, n, right):
            break
        drop = 0.0
        for i in range(n):
            step[i] = -right[terms.order[i]]
            drop += gradient[i] * step[i]
        if not drop <= -LEAST_DROP * (1.0 + abs(value)):
            break
        part, least = 1.0, np.inf
        while part > LEAST_PART:
            for i in range(n):
                new[i] = m[i] + part * step[i]
            least = value_of(terms, new, sharpness)
            if least <= value + KEPT_DROP * part * drop:
                break
            part *= 0.5
        if part <= LEAST_PART:
            break
        m, new, value = new, m, least
    return m


@kernel
def barrier_least(terms: BarrierTerms, m: Floats, sharpness: float, rounds: int) -> Floats:
    """The least of the barrier, from coefficients on that keep every limit strictly.

    Args:
        terms: What is asked.
        m: Coefficients to begin with [m²/s²], shape (n,).
        sharpness: Of the barrier.
        rounds: Newton's steps, at most.

    Returns:
        The coefficients, (n,).
    """
    return least_from(terms, m, sharpness, rounds)


@kernel
def barrier_limit(
    terms: BarrierTerms, m: Floats, first: float, growth: float, gap: float, rounds: int
) -> Floats:
    """Coefficients of the fastest motion, from some on that keep every limit strictly.

    Args:
        terms: What is asked.
        m: Coefficients to begin with [m²/s²], shape (n,).
        first: How sharp the barrier is at first, times what is asked over the time,
        growth: and by what it gets sharper,
        gap: until it keeps no more than this part of the time.
        rounds: Newton's steps each time, at most.

    Returns:
        The coefficients, (n,).
    """
    asked = 6.0 * m.shape[0] + terms.limits.shape[0]  # of the jerk at three places, either way
    sharpness = first * asked / time_of(terms, m)
    while True:
        m = least_from(terms, m, sharpness, rounds)
        if not asked >= gap * sharpness * time_of(terms, m):
            return m
        sharpness *= growth
