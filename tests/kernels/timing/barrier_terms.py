"""Random stretches with what is asked of them, and the barrier's value by numpy."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from viaspline.kernels.timing.speed_barrier import BarrierTerms

seeds = st.integers(0, 2**32 - 1)


def random_terms(seed: int) -> tuple[BarrierTerms, np.ndarray]:
    """Stretches in a row, between two rests, and coefficients that keep every limit."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 7))
    near = np.stack((np.arange(-1, n - 1), np.arange(n), np.arange(1, n + 1)), axis=1)
    near[0, 0], near[-1, 2] = n, n + 1
    shares = rng.uniform(0.05, 0.9, (n, 5, 3))
    first = np.concatenate(([0], np.cumsum(rng.integers(1, 5, n))))
    rows = rng.normal(0.0, 1.0, (first[-1], 3))
    limits = rng.uniform(20.0, 40.0, first[-1])
    rows[first[:-1]], limits[first[:-1]] = (0.0, -1.0, 0.0), 0.0  # no coefficient is below 0
    apart = near[:, :, None] - near[:, None, :]
    inside = (near[:, :, None] < n) & (near[:, None, :] < n) & (apart >= 0)
    places = np.where(inside, apart * n + np.where(near < n, near, 0)[:, None, :], 3 * n)
    terms = BarrierTerms(
        rng.uniform(0.2, 2.0, n), near, float(rng.uniform(0.5, 2.0)), rng.uniform(3.0, 9.0, n),
        shares[:, :3].copy(), rng.normal(0.0, 0.1, (n, 3)), rows, limits, first,
        shares[:, 3:].copy(), np.array([[0.0, 1.5], [n - 1.0, 0.7]]), places, np.arange(n), 3,
    )  # fmt: skip
    m = rng.uniform(0.5, 2.0, n)
    while not numpy_value(terms, m, 1.0) < np.inf:
        m = 0.5 * m
        terms = terms._replace(before=0.5 * terms.before)
    return terms, m


def numpy_value(terms: BarrierTerms, m: np.ndarray, sharpness: float) -> float:
    known = np.append(m, (terms.before, 0.0))[terms.near]
    each = known.repeat(np.diff(terms.first), axis=0)
    linear = terms.limits - np.einsum("rc,rc->r", terms.rows, each)
    squares = np.einsum("nkc,nc->nk", terms.squares, known)
    if (m <= 0.0).any() or (squares < 0.0).any():
        return np.inf
    used = np.einsum("nc,nc->n", terms.change, known)[:, None] * np.sqrt(squares)
    jerk = np.concatenate((terms.jerk[:, None] - used, terms.jerk[:, None] + used))
    if (linear <= 0.0).any() or (jerk <= 0.0).any():
        return np.inf
    at = np.einsum("nkc,nc->nk", terms.gauss, known)
    if (at <= 0.0).any():
        return np.inf
    time = 0.5 * (terms.widths[:, None] / np.sqrt(at)).sum()
    time += (terms.rests[:, 1] / np.sqrt(m[terms.rests[:, 0].astype(int)])).sum()
    return float(sharpness * time - np.log(linear).sum() - np.log(jerk).sum())
