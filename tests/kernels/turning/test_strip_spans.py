"""Splines through places beside scipy's, for each kind of ends."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.turning.strip_spans import strip_spans

Floats = NDArray[np.float64]
PLACES = np.array([[0.0, 0.0], [2.0, 1.0], [3.0, -1.0], [7.0, 0.0], [8.0, 3.0]])
FREE = np.full((2, 2), np.nan)


def normals(places: Floats) -> Floats:
    along = np.gradient(places, axis=0)
    along /= np.hypot(*along.T)[:, None]
    return np.column_stack((-along[:, 1], along[:, 0]))


def middles(spans: Floats) -> Floats:
    found: Floats = (spans[:, 0] + 3.0 * spans[:, 1] + 3.0 * spans[:, 2] + spans[:, 3]) / 8.0
    return found


@pytest.mark.parametrize("closed", [False, True])
def test_spans_are_those_of_scipy(closed: bool) -> None:
    places = np.vstack((PLACES, PLACES[:1])) if closed else PLACES
    at = np.r_[0.0, np.cumsum(np.hypot(*np.diff(places, axis=0).T))]
    other = CubicSpline(at, places, bc_type="periodic" if closed else "natural")
    spans = strip_spans(places.copy(), normals(places), FREE, closed)
    np.testing.assert_allclose(middles(spans), other(0.5 * (at[1:] + at[:-1])), atol=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_given_ends_are_left_straight_in_their_directions(seed: int) -> None:
    random = np.random.default_rng((3, seed))
    turns = random.uniform(-0.4, 0.4, 12)
    steps = random.uniform(0.5, 1.5, (12, 1))
    headings = np.cumsum(turns)
    ways = np.column_stack((np.cos(headings), np.sin(headings)))
    places = np.vstack(((0.0, 0.0), np.cumsum(steps * ways, axis=0)))
    angles = headings[[0, -1]] + random.uniform(-0.3, 0.3, 2)
    ends = np.column_stack((np.cos(angles), np.sin(angles)))
    before = places.copy()
    spans = strip_spans(places, normals(places), ends, False)
    curve = PiecewiseCubic(spans)
    first, last = curve.domain
    np.testing.assert_allclose(curve.tangent(first), ends[0], atol=1e-12)
    np.testing.assert_allclose(curve.tangent(last), ends[1], atol=1e-12)
    assert max(abs(curve.curvature(first)), abs(curve.curvature(last))) < 1e-8
    assert curve.curvature_jumps().max() < 1e-8
    moved = np.hypot(*(places - before).T) > 0.0
    assert np.flatnonzero(moved).tolist() == [1, 11]
