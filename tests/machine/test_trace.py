"""The curve of a true motion, and the bound of its distance from it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.kernels.tracking.drive_model import moved
from viaspline.machine.trace import TRACE_TOLERANCE_M, trace


def motion(speeds: np.ndarray, rates: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Places and headings after every step, and in between on the arcs."""
    poses = [(0.0, 0.0, 0.0)]
    for v, w in zip(speeds, rates, strict=True):
        poses.append(moved(*poses[-1], float(v), 0.0, float(w), step))
    array = np.array(poses)
    return array[:, :2], array[:, 2]


@given(st.integers(0, 2**32 - 1), st.floats(0.1, 3.0), st.floats(0.0, 3.0))
@settings(deadline=None, max_examples=30)
def test_no_point_of_the_motion_is_farther_from_the_curve_than_the_bound(
    seed: int, speed: float, turn: float
) -> None:
    rng = np.random.default_rng(seed)
    n = 400
    speeds = np.clip(speed + 0.1 * np.cumsum(rng.standard_normal(n)) * 0.1, 0.0, 4.0)
    rates = turn * np.sin(np.linspace(0, 9, n)) + 0.2 * rng.standard_normal(n)
    places, headings = motion(speeds, rates, 0.01)
    curve, bound, u = trace(places, headings)
    assert bound <= max(TRACE_TOLERANCE_M, 2e-3)
    fine = np.asarray(curve.evaluate(np.linspace(*curve.domain, 40 * len(curve.spans) + 1)))
    for i in range(0, n, 7):
        part = moved(*places[i], headings[i], float(speeds[i]), 0.0, float(rates[i]), 0.0037)
        gap = np.hypot(*(fine - part[:2]).T).min()
        spacing = np.hypot(*np.diff(fine, axis=0).T).max()
        assert gap <= bound + spacing
    assert np.abs(curve.evaluate(u) - places).max() <= bound + 1e-9
    assert len(curve.spans) < n / 3 or turn > 1.0 or speed < 0.3


def test_a_robot_that_never_moved_has_a_curve_of_one_place() -> None:
    curve, bound, u = trace(np.ones((5, 2)), np.linspace(0, 1, 5))
    assert curve.length == 0.0
    assert bound < 1e-9
    assert u.tolist() == [0.0] * 5


def test_a_turn_on_the_spot_is_a_corner() -> None:
    places = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (1.0, 1.0)])
    headings = np.array([0.0, 0.0, np.pi / 2, np.pi / 2])
    curve, bound, _ = trace(places, headings)
    assert curve.length == pytest.approx(2.0)
    assert bound < 1e-9


@given(st.integers(0, 2**32 - 1))
@settings(deadline=None, max_examples=30)
def test_a_body_that_rolls_back_as_it_stands_is_never_turned_round(seed: int) -> None:
    rng = np.random.default_rng(seed)
    speeds = np.clip(np.abs(np.linspace(-1.0, 1.0, 400)) - 0.2, 0.0, 1.0)  # it stands for a second
    noise = np.repeat(0.05 * rng.standard_normal(8), 50)
    places, headings = motion(speeds + noise, np.repeat(0.05 * rng.standard_normal(8), 50), 0.01)
    curve, bound, u = trace(places, headings, 2.0)
    assert np.linalg.norm(curve.evaluate(u) - places, axis=1).max() <= bound + 1e-9
    assert bound < 0.3
    if not curve.length:
        return
    fine = np.linspace(*curve.domain, 40 * len(curve.spans) + 1)
    off = curve.heading(fine) - np.interp(fine, u, headings)
    assert np.abs(np.remainder(off + np.pi, 2.0 * np.pi) - np.pi).max() < 0.7


def test_a_disc_keeps_the_places_at_which_it_rolled_back() -> None:
    places, headings = motion(np.repeat([1.0, -0.1, 1.0], 20), np.zeros(60), 0.01)
    curve, bound, u = trace(places, headings)
    assert np.linalg.norm(curve.evaluate(u) - places, axis=1).max() <= bound < 2e-3
