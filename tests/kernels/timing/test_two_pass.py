"""The fastest profile below caps against a linear programme."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog

from viaspline.kernels.timing.two_pass import two_pass_profile

seeds = st.integers(0, 2**32 - 1)


def random_line(seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 12))
    distances = np.concatenate(([0.0], np.cumsum(rng.exponential(2.0, n - 1) + 1e-3)))
    rests = rng.random(n) < 0.15
    rests[[0, -1]] = False
    return distances, rng.uniform(0.05, 9.0, n - 1), rests


@given(seeds)
@settings(deadline=None, max_examples=40)
def test_no_feasible_profile_is_faster_than_the_kernels(seed: int) -> None:
    distances, caps, rests = random_line(seed)
    accel = 0.7
    points, squares, _, missed = two_pass_profile(distances, caps, rests, accel, accel, 0.0, 0.0)
    assert np.isnan(missed)
    # the pointwise largest v² as a linear programme over all the break points
    n = len(points)
    middles = 0.5 * (points[1:] + points[:-1])
    cap = caps[np.searchsorted(distances, middles) - 1]
    upper = np.minimum(np.append(cap, np.inf), np.insert(cap, 0, np.inf))
    upper[np.isin(points, distances[rests])] = 0.0
    upper[[0, -1]] = 0.0
    change = np.eye(n)[1:] - np.eye(n)[:-1]
    rows = np.concatenate((change, -change))
    limit = np.tile(2 * accel * np.diff(points), 2)
    best = linprog(-np.ones(n), A_ub=rows, b_ub=limit, bounds=np.stack((0 * upper, upper), axis=1))
    assert best.status == 0
    assert squares == pytest.approx(best.x, abs=1e-7)


@given(seeds)
@settings(deadline=None, max_examples=40)
def test_between_the_break_points_every_limit_is_kept(seed: int) -> None:
    distances, caps, rests = random_line(seed)
    points, squares, over, _ = two_pass_profile(distances, caps, rests, 0.7, 0.7, 0.0, 0.0)
    assert over == distances[0]
    assert np.all(np.diff(points) > 0)
    slopes = np.diff(squares) / np.diff(points)
    assert np.all(np.abs(np.diff(squares)) <= 2 * 0.7 * np.diff(points) + 1e-9), slopes
    for i, cap in enumerate(caps):
        inside = (points >= distances[i]) & (points <= distances[i + 1])
        assert np.all(squares[inside] <= cap + 1e-9)


def test_a_start_above_the_caps_brakes_until_it_is_below_them() -> None:
    points, squares, over, missed = two_pass_profile(
        np.array([0.0, 10.0]), np.array([1.0]), np.array([False, False]), 1.0, 1.0, 9.0, 0.0
    )
    assert over == pytest.approx(4.0)
    assert np.isnan(missed)
    assert points == pytest.approx([0.0, 4.0, 9.5, 10.0])
    assert squares == pytest.approx([9.0, 1.0, 1.0, 0.0])


def test_a_start_too_fast_to_come_to_rest_names_the_place() -> None:
    *_, missed = two_pass_profile(
        np.array([0.0, 4.0, 9.0]), np.array([4.0, 4.0]), np.array([False, True, False]),
        1.0, 1.0, 9.0, 0.0,
    )  # fmt: skip
    assert missed == 4.0


@given(seeds)
@example(200)
@settings(deadline=None, max_examples=40)
def test_no_slope_is_steeper_where_caps_are_reached_just_at_ends_of_stretches(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ramps = rng.uniform(0.05, 9.0, int(rng.integers(1, 6)))
    steps = np.concatenate((ramps, ramps[::-1])) / 1.4  # up for one ramp after the other, and down
    distances = rng.uniform(0.0, 300.0) + np.concatenate(([0.0], np.cumsum(steps)))
    reached = np.cumsum(ramps)
    caps = np.concatenate((reached, reached[::-1]))
    rests = np.zeros(len(distances), np.bool_)
    points, squares, _, _ = two_pass_profile(distances, caps, rests, 0.7, 0.7, 0.0, 0.0)
    slopes = np.diff(squares) / np.diff(points)
    assert np.abs(slopes).max() <= 1.4 * (1.0 + 1e-6)
    assert squares.max() >= reached[-1] - 1e-4
