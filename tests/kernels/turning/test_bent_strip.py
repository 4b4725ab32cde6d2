"""A strip between bounds beside scipy's bounded minimum of the same cost."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize

from viaspline.kernels.turning.bent_strip import SHARP_PRICE, bent_strip
from viaspline.kernels.turning.settled_strip import MOST_TURNED

Floats = NDArray[np.float64]
COUNT = 25


def costs(tension: float) -> Floats:
    """The matrix of the cost of a nearly flat strip, steps of 1 m, (n, n)."""
    bends, slopes = np.diff(np.eye(COUNT), 2, axis=0), np.diff(np.eye(COUNT), axis=0)
    found: Floats = bends.T @ bends + 0.5 * tension * slopes.T @ slopes
    return found


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("tension", [1e-3, 0.1])
def test_no_other_offsets_between_the_bounds_bend_less(seed: int, tension: float) -> None:
    random = np.random.default_rng(seed)
    places = np.column_stack((np.arange(COUNT, dtype=float), np.zeros(COUNT)))
    normals = np.tile([0.0, 1.0], (COUNT, 1))
    lower, upper = np.full(COUNT, -0.1), np.full(COUNT, 0.1)
    up, down = random.choice(np.arange(2, COUNT - 2), 2, replace=False)
    lower[up], upper[down] = 0.01, -0.01
    fixed = np.zeros(COUNT, np.bool_)
    fixed[[0, -1]] = True
    moved, prices, turned = bent_strip(places, normals, lower, upper, fixed, False, tension, np.inf)
    bounds = np.column_stack((lower, upper))
    bounds[fixed] = 0.0
    matrix = costs(tension)
    best = minimize(
        lambda heights: heights @ matrix @ heights,
        x0=np.clip(np.zeros(COUNT), *bounds.T),
        jac=lambda heights: 2.0 * matrix @ heights,
        bounds=bounds,
        method="L-BFGS-B",
        options={"maxiter": 20_000, "maxfun": 10**6, "ftol": 1e-15, "gtol": 1e-10},
    )
    assert (moved >= lower).all()
    assert (moved <= upper).all()
    assert moved[[0, -1]].tolist() == [0.0, 0.0]
    assert moved @ matrix @ moved <= best.fun * (1.0 + 1e-3)
    assert prices[up] > 0.0 > prices[down]
    assert turned == pytest.approx(np.abs(np.diff(moved)).max())


@pytest.mark.parametrize("seed", range(4))
def test_a_round_bends_least_whichever_of_its_places_is_its_first(seed: int) -> None:
    """The best offsets of a ring between bounds, one place held: by the seam or across it."""
    random = np.random.default_rng((2, seed))
    around = np.arange(COUNT) * 2.0 * np.pi / COUNT
    ring = np.column_stack((np.cos(around), np.sin(around))) * random.uniform(9.0, 11.0, (COUNT, 1))
    lower, upper = -random.uniform(0.1, 0.5, COUNT), random.uniform(0.1, 0.5, COUNT)
    held = int(random.integers(3, COUNT - 3))

    def moved(first: int) -> Floats:
        order = (np.arange(COUNT + 1) + first) % COUNT
        places = ring[order]
        fixed = np.isin(order, (held, 0))
        normals = -places / np.hypot(*places.T)[:, None]
        found, _, _ = bent_strip(
            places, normals, lower[order], upper[order], fixed, True, 0.01, np.inf
        )
        back: Floats = np.empty(COUNT)
        back[order] = found
        return back

    np.testing.assert_allclose(moved(0), moved(held), atol=2e-3)
    assert np.abs(moved(0)).max() > 0.05


def sharp_cost(heights: Floats, sharp: float) -> float:
    """The cost of a nearly flat strip, steps of 1 m, where bending beyond a curvature is dearer."""
    bends = np.diff(heights, 2) ** 2
    over = np.maximum(bends - sharp**2, 0.0) ** 2 / (2.0 * sharp**2)
    stretch = 0.5 * 1e-3 * np.diff(heights) ** 2
    return float((bends + SHARP_PRICE * over).sum() + stretch.sum())


@pytest.mark.parametrize("seed", range(4))
def test_a_strip_that_is_moved_on_and_on_bends_least_where_sharp_bends_are_dear(seed: int) -> None:
    """Each move is by the second order in offsets alone; the last has nothing left to move."""
    random = np.random.default_rng((3, seed))
    fixed = np.zeros(COUNT, np.bool_)
    fixed[[0, -1]] = True
    lower, upper = np.full(COUNT, -1.0), np.full(COUNT, 1.0)
    lower[int(random.integers(6, COUNT - 6))] = 0.1
    bounds = np.column_stack((lower, upper))
    bounds[fixed] = 0.0
    start = np.where(fixed, 0.0, np.clip(0.12 * np.sin(np.pi * np.arange(COUNT) / 24.0), *bounds.T))
    blunt, plain = (_moved_to_rest(start, lower, upper, fixed, sharp) for sharp in (1e-3, np.inf))
    best = minimize(
        sharp_cost, x0=blunt, args=(1e-3,), bounds=bounds, method="L-BFGS-B",
        options={"maxiter": 20_000, "maxfun": 10**6, "ftol": 1e-15, "gtol": 1e-12},
    )  # fmt: skip
    assert sharp_cost(blunt, 1e-3) <= best.fun * (1.0 + 1e-3)
    assert np.abs(np.diff(blunt, 2)).max() < 0.9 * np.abs(np.diff(plain, 2)).max()


def _moved_to_rest(
    heights: Floats, lower: Floats, upper: Floats, fixed: NDArray[np.bool_], sharp: float
) -> Floats:
    normals = np.tile([0.0, 1.0], (COUNT, 1))
    for _ in range(30):
        places = np.column_stack((np.arange(COUNT, dtype=float), heights))
        moved, _, _ = bent_strip(
            places, normals, lower - heights, upper - heights, fixed, False, 1e-3, sharp
        )
        heights = heights + moved
    return heights


@pytest.mark.parametrize("seed", range(4))
def test_places_that_are_moved_no_more_than_is_told_keep_their_order(seed: int) -> None:
    """On the inside of a bend they come together: beyond its middle they would lie in disorder."""
    random = np.random.default_rng((4, seed))
    radius, half = random.uniform(0.5, 1.5), random.uniform(0.9, 1.9)
    around = np.arange(-half, half, 0.2)
    arc = radius * np.column_stack((np.sin(around), np.cos(around)))
    legs = 2.0 * np.arange(1, 9)[:, None] * (np.cos(half), -np.sin(half))
    places = np.concatenate(((arc[0] + legs * (-1, 1))[::-1], arc, arc[-1] + legs))
    along = np.gradient(places, axis=0)
    normals = np.column_stack((-along[:, 1], along[:, 0])) / np.hypot(*along.T)[:, None]
    fixed, far = np.zeros(len(places), np.bool_), np.full(len(places), 20.0)
    fixed[[0, -1]] = True
    moved, _, told = bent_strip(places, normals, -far, far, fixed, False, 0.16, np.inf)
    moved *= MOST_TURNED / told
    steps, now = np.diff(places, axis=0), np.diff(places + moved[:, None] * normals, axis=0)
    kept = (steps * now).sum(axis=1) / (steps * steps).sum(axis=1)
    assert np.abs(moved).max() > 0.3 * radius
    assert kept.min() >= 0.5 - 1e-9
