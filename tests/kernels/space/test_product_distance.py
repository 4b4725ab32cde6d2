import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from viaspline.kernels.jit import kernel
from viaspline.kernels.space.near_first import cell_at, step_of
from viaspline.kernels.space.product_distance import chord_product

seeds = st.integers(0, 100_000)


@kernel
def chord_distance_of(numbers: np.ndarray, limit: float) -> float:
    c = numbers
    return chord_product(
        c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], c[9], c[10], c[11], c[12], limit
    )


@kernel
def orders() -> np.ndarray:
    """Cells by step, and steps by cell, for each nearest cell."""
    found = np.empty((4, 4, 2), np.int64)
    for nearest in range(4):
        for k in range(4):
            found[nearest, k, 0] = cell_at(nearest, k)
            found[nearest, k, 1] = step_of(nearest, cell_at(nearest, k))
    return found


def at(numbers: np.ndarray, t: float) -> float:
    x, y, z = numbers[:3] + t * numbers[3:6]
    x0, y0, x1, y1, low, high, radius = numbers[6:]
    level = math.hypot(max(x0 - x, x - x1, 0.0), max(y0 - y, y - y1, 0.0)) - radius
    return math.hypot(max(level, 0.0), max(low - z, z - high, 0.0))


def random_numbers(rng: np.random.Generator) -> np.ndarray:
    first, step = rng.uniform(-9, 9, 3), rng.normal(0, 1, 3) * 10.0 ** rng.uniform(-3, 2)
    step[rng.random(3) < 0.15] = 0.0
    x0, y0, low = rng.uniform(-3, 3, 3)
    wide, deep, tall = rng.choice([0.0, 1.0, 4.0], 3)
    high = low + tall if rng.random() < 0.8 else math.inf
    box = [x0, y0, x0 + wide, y0 + deep, low, high, rng.choice([0.0, 0.5, 3.0])]
    return np.concatenate((first, step, box))


@given(seeds)
def test_the_bound_is_below_the_least_of_all_places_by_a_nanometre(seed: int) -> None:
    numbers = random_numbers(np.random.default_rng(seed))
    found = chord_distance_of(numbers, math.inf)
    t = np.linspace(0, 1, 101)
    k = int(np.argmin([at(numbers, one) for one in t]))
    bracket = (t[max(k - 1, 0)], t[min(k + 1, 100)])
    options = {"xatol": 1e-13, "maxiter": 500}
    best = minimize_scalar(lambda one: at(numbers, one), bounds=bracket, options=options)
    least = min(best.fun, at(numbers, 0.0), at(numbers, 1.0))
    assert found <= least + 1e-11 * (1.0 + np.abs(numbers[:6]).max())
    assert found >= least - 1e-7


@given(seeds, st.floats(0, 12))
def test_a_limit_is_answered_where_nothing_is_nearer(seed: int, limit: float) -> None:
    numbers = random_numbers(np.random.default_rng(seed))
    found = chord_distance_of(numbers, math.inf)
    within = chord_distance_of(numbers, limit)
    assert within == pytest.approx(min(found, limit), abs=2e-9)
    assert within <= limit


def test_four_cells_come_from_the_nearest_on() -> None:
    found = orders()
    assert found[:, :, 0].tolist() == [[0, 1, 2, 3], [1, 0, 2, 3], [2, 3, 1, 0], [3, 2, 1, 0]]
    assert (found[:, :, 1] == np.arange(4)).all()
