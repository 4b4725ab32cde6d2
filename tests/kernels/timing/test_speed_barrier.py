"""The barrier of the fastest v² against numpy's sums and scipy's minimum."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from viaspline.kernels.timing.speed_barrier import (
    BarrierTerms,
    barrier_least,
    barrier_limit,
    barrier_value,
    motion_time,
)

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


@given(seeds, st.floats(1e-2, 1e3))
@settings(deadline=None, max_examples=60)
def test_the_barriers_value_is_the_sum_of_its_terms(seed: int, sharpness: float) -> None:
    terms, m = random_terms(seed)
    expected = numpy_value(terms, m, sharpness)
    assert np.isclose(barrier_value(terms, m, sharpness), expected, rtol=1e-12, atol=1e-9)


@given(seeds)
@settings(deadline=None, max_examples=60)
def test_what_does_not_keep_its_limits_is_of_no_value(seed: int) -> None:
    terms, m = random_terms(seed)
    for wrong in (-m, 0.0 * m, 1e6 * m):
        assert barrier_value(terms, wrong, 1.0) == numpy_value(terms, wrong, 1.0) == np.inf


@pytest.mark.long_without_jit
@given(seeds, st.floats(0.1, 30.0))
@settings(deadline=None, max_examples=30)
def test_scipy_finds_nothing_lower_near_the_least_of_the_barrier(
    seed: int, sharpness: float
) -> None:
    terms, m = random_terms(seed)
    least = barrier_least(terms, m, sharpness, 200)
    value = numpy_value(terms, least, sharpness)
    assert value <= numpy_value(terms, m, sharpness) + 1e-9
    found = minimize(
        lambda x: min(numpy_value(terms, x, sharpness), 1e9), least, method="Nelder-Mead",
        options={"xatol": 1e-9, "fatol": 1e-10, "maxiter": 400},
    )  # fmt: skip
    assert found.fun >= value - 1e-5 * (1.0 + abs(value))


@given(seeds)
@settings(deadline=None, max_examples=30)
def test_a_sharper_barrier_keeps_less_of_the_time_and_no_limit_less(seed: int) -> None:
    terms, m = random_terms(seed)
    rough, fine = (barrier_limit(terms, m, 1.0, 8.0, gap, 60) for gap in (1e-2, 1e-5))
    assert numpy_value(terms, fine, 1.0) < np.inf
    times = [motion_time(terms, found) for found in (m, rough, fine)]
    assert times[0] * (1 + 1e-9) >= times[1] * (1 - 1e-9) >= times[2] * (1 - 2e-9)


@given(seeds)
@settings(deadline=None, max_examples=30)
def test_the_barriers_value_grows_with_its_sharpness_by_the_time(seed: int) -> None:
    terms, m = random_terms(seed)
    time = numpy_value(terms, m, 3.0) - numpy_value(terms, m, 2.0)
    assert np.isclose(motion_time(terms, m), time, rtol=1e-9, atol=1e-9)
