"""The filter is as certain as it is right."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.tracks.motion_estimate import MotionEstimate

speeds = st.floats(-3, 3)


def followed(rng: np.random.Generator, wander: float, error: float, steps: int
             ) -> tuple[MotionEstimate, np.ndarray]:  # fmt: skip
    """An estimate of something whose velocity wanders, and its true state."""
    step = 0.1
    state = np.array((0.0, 0.0, *rng.normal(0.0, 1.0, 2)))
    estimate = None
    for k in range(steps):
        if k:
            kicks = rng.normal(0.0, wander * np.sqrt(step / 50), (50, 2))
            for kick in kicks:
                state[:2] += state[2:] * step / 50
                state[2:] += kick
        place = state[:2] + rng.normal(0.0, error, 2)
        if estimate is None:
            estimate = MotionEstimate.at_first_sight(0.0, tuple(place.tolist()), error, 1.0)
        else:
            estimate = estimate.foreseen(k * step, wander).with_place(place, error)
    assert estimate is not None
    return estimate, state


@pytest.mark.parametrize("wander", [0.1, 0.8])
@pytest.mark.parametrize("steps", [2, 30])
def test_errors_are_those_that_it_reckons_with(wander: float, steps: int) -> None:
    """Squared Mahalanobis distances of 4 coordinates have the mean 4 (a chi squared)."""
    rng = np.random.default_rng(5)
    squares = []
    for _ in range(300):
        estimate, state = followed(rng, wander, 0.05, steps)
        off = estimate.mean - state
        one = estimate.axis
        spread = np.kron([[one.place, one.both], [one.both, one.velocity]], np.eye(2))
        squares.append(off @ np.linalg.solve(spread, off))
    assert 3.4 < np.mean(squares) < 4.6


def by_matrices(
    mean: np.ndarray, spread: np.ndarray, shown: np.ndarray, seen: np.ndarray, noise: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """A Kalman filter's correction as textbooks write it: mean and covariance."""
    gain = spread @ shown.T @ np.linalg.inv(shown @ spread @ shown.T + noise)
    return mean + gain @ (seen - shown @ mean), spread - gain @ shown @ spread


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("seed", range(5))
def test_it_is_the_filter_of_textbooks(d: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    mean = rng.normal(size=2 * d)
    estimate = MotionEstimate.measured(0.0, mean, 0.1, 0.5)
    spread = np.diag([0.1**2] * d + [0.5**2] * d)
    for _ in range(6):
        late, wander, error = rng.uniform(0.05, 1.0, 3)
        estimate = estimate.foreseen(estimate.time + late, wander)
        on = np.eye(2 * d) + late * np.eye(2 * d, k=d)
        drift = [[late**3 / 3, late**2 / 2], [late**2 / 2, late]]
        mean, spread = on @ mean, on @ spread @ on.T + wander**2 * np.kron(drift, np.eye(d))
        seen = rng.normal(size=2 * d)
        if rng.random() < 0.5:
            estimate = estimate.with_place(seen[:d], error)
            shown, noise, seen = np.eye(d, 2 * d), error**2 * np.eye(d), seen[:d]
        else:
            estimate = estimate.with_place_and_velocity(seen, error, 2.0 * error)
            shown, noise = np.eye(2 * d), np.diag([error**2] * d + [4.0 * error**2] * d)
        mean, spread = by_matrices(mean, spread, shown, seen, noise)
    one = estimate.axis
    assert estimate.mean == pytest.approx(mean, rel=1e-9, abs=1e-9)
    both = np.kron([[one.place, one.both], [one.both, one.velocity]], np.eye(d))
    assert both == pytest.approx(spread, rel=1e-7, abs=1e-9)


@given(speeds, speeds, st.floats(0.01, 1.0), st.floats(0.05, 2.0))
def test_what_goes_straight_is_foreseen_where_it_will_be(
    vx: float, vy: float, error: float, late: float
) -> None:
    estimate = MotionEstimate.at_first_sight(0.0, (1.0, 2.0), error, 1.0)
    for k in range(1, 400):
        t = 0.1 * k
        estimate = estimate.foreseen(t, 1e-6).with_place((1 + vx * t, 2 + vy * t), error)
    t += late
    there = estimate.foreseen(t, 1e-6)
    assert there.place == pytest.approx((1 + vx * t, 2 + vy * t), abs=0.05)
    assert there.place_error < error


@given(speeds, speeds, st.floats(0.01, 1.0))
def test_one_look_leaves_the_velocity_open(x: float, y: float, error: float) -> None:
    estimate = MotionEstimate.at_first_sight(3.0, (x, y), error, 2.0)
    assert estimate.velocity_error == pytest.approx(2.0)
    assert estimate.place_error == pytest.approx(error)
    assert estimate.significance == 0.0
    away, _ = estimate.distance_to(np.array((x + error, y)), 0.0)
    assert away == pytest.approx(1.0)
