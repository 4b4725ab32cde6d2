"""Heights along a curve on the ground: exact at via points, monotone between, without a jump."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.heights import with_heights


def straight(places: Floats) -> Floats:
    """One straight span after the other [m], (m, 4, 2)."""
    shares = np.array([0.0, 1.0, 2.0, 3.0])[:, None] / 3.0
    return np.array([(1.0 - shares) * a + shares * b for a, b in pairwise(places)])


@given(seed=st.integers(0, 10_000))
def test_heights_are_met_and_monotone_between_and_their_bend_does_not_jump(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 7))
    places = np.column_stack((np.cumsum(rng.uniform(0.5, 30, count)), np.zeros(count)))
    heights = rng.choice([rng.uniform(0, 40, count), rng.integers(0, 2, count) * 20.0])[:, None]
    joints = np.arange(count, dtype=np.int64)
    spans, begins = with_heights(straight(places), joints, heights, closed=False)
    curve = PiecewiseCubic(spans)
    at = np.asarray(curve.evaluate(begins.astype(float)))
    assert np.allclose(at, np.column_stack((places, heights)), atol=1e-9)
    for (a, b), (low, high) in zip(pairwise(begins.tolist()), pairwise(heights[:, 0]), strict=True):
        z = np.asarray(curve.evaluate(np.linspace(a, b, 300)))[:, 2]
        assert (np.diff(z) * np.sign(high - low) >= -1e-9).all()
    bend = np.abs(np.diff(heights[:, 0]) / np.diff(places[:, 0]) ** 2).max()
    assert max(Path(spans, []).curvature_jumps(), default=0.0) <= 1e-6 * (1.0 + bend)


def test_a_leg_that_stays_level_is_not_cut() -> None:
    places = np.array([[0.0, 0], [50, 0], [50, 40], [90, 40]])
    heights = np.array([[5.0], [5.0], [25.0], [25.0]])
    spans, begins = with_heights(straight(places), np.arange(4), heights, closed=False)
    assert begins.tolist() == [0, 1, 4, 5]
    assert np.allclose(spans[0, :, 2], 5.0)
    assert np.allclose(spans[4, :, 2], 25.0)


def test_where_a_round_closes_it_goes_on_as_steeply_as_it_comes() -> None:
    places = np.array([[0.0, 0], [50, 0], [50, 40], [0, 40], [0, 0]])
    heights = np.array([[5.0], [20.0], [25.0], [0.0], [5.0]])
    spans, _ = with_heights(straight(places), np.arange(5), heights, closed=True)
    leaves, comes = spans[0, 1] - spans[0, 0], spans[-1, 3] - spans[-1, 2]
    out, back = (way[2] / np.linalg.norm(way[:2]) for way in (leaves, comes))
    assert out == pytest.approx(back)
    assert out > 0.0
