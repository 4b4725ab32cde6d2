"""The barrier of the fastest v² against numpy's sums and scipy's minimum."""

from __future__ import annotations

import numpy as np
import pytest
from barrier_terms import numpy_value, random_terms, seeds
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from viaspline.kernels.timing.barrier_newton import barrier_least, barrier_limit
from viaspline.kernels.timing.speed_barrier import barrier_value, motion_time


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
