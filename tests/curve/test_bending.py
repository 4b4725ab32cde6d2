"""Proven curvature, corners and loops, beside dense samples, scipy's view and shapely."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.bending import corner_angles, curvature_bound, self_loops
from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError

seeds = st.integers(0, 1_000_000)


@settings(max_examples=200)
@given(seeds, st.sampled_from([2, 2, 3]))
def test_no_place_bends_more_and_one_bends_as_much(seed: int, dimension: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.uniform(-50, 50, (rng.integers(3, 7), dimension)) + rng.choice([0, 1e5])
    slack = float(rng.choice([0.02, 0.2, 0.5, 1.0]))
    curve = CardinalSpline(points, slack=slack, closed=bool(rng.random() < 0.3))
    bound, u = curvature_bound(curve)
    dense = np.abs(curve.curvature(np.linspace(*curve.domain, 30_001)))
    assert dense.max() <= bound * (1 + 1e-9)
    assert curve.max_curvature()[0] <= bound * (1 + 1e-9)
    sides = [u, np.clip(u - 1e-12, *curve.domain)]  # at a joint, the one before it
    assert np.abs(curve.curvature(sides)).max() == pytest.approx(bound, rel=2e-5)


@settings(max_examples=100)
@given(seeds)
def test_the_bound_is_a_millionth_above_the_largest_root(seed: int) -> None:
    spans = np.random.default_rng(seed).uniform(0, 10, (1, 4, 2))
    curve = PiecewiseCubic(spans)
    bound, _ = curvature_bound(curve)
    largest = curve.max_curvature()[0]
    assert largest * (1 - 1e-9) <= bound
    if largest < 1e5:
        assert bound <= largest * (1 + 2e-6)


@given(seeds, st.floats(0.01, 10.0))
def test_a_bound_that_needs_no_more_is_told_on_which_side_the_curve_is(
    seed: int, least: float
) -> None:
    points = np.random.default_rng(seed).uniform(-50, 50, (5, 2))
    curve = CardinalSpline(points, slack=0.2)
    bound, asked = curvature_bound(curve)[0], curvature_bound(curve, least)[0]
    assert asked == (least if bound < least else bound)


def test_a_needle_of_curvature_is_not_missed() -> None:
    needle = PiecewiseCubic([[[0, 0], [10, 1e-3], [-9, 1e-3], [1, 0]]])
    bound, at = curvature_bound(needle)
    fine = np.abs(needle.curvature(at + np.linspace(-1e-4, 1e-4, 20001)))
    assert fine.max() <= bound <= fine.max() * (1 + 1e-5)


def test_a_line_has_no_curvature_and_a_corner_no_bound() -> None:
    line = CardinalSpline([(0, 0), (3, 4), (6, 8)], tension=1.0)
    assert curvature_bound(line)[0] == 0.0
    bent = CardinalSpline([(0, 0), (3, 4), (6, 9)], tension=1.0)
    assert curvature_bound(bent) == (math.inf, 1.0)
    assert curvature_bound(PiecewiseCubic(np.ones((2, 4, 2))))[0] == 0.0


def test_cusps_have_no_bound() -> None:
    inside = PiecewiseCubic([[(0, 0), (10, 10), (0, 10), (10, 0)]])
    bound, at = curvature_bound(inside)
    assert bound == math.inf
    assert at == pytest.approx(0.5)
    at_end = PiecewiseCubic([[(0, 0), (0, 0), (1, 0), (2, 1)]])
    assert curvature_bound(at_end) == (math.inf, 0.0)
    back = PiecewiseCubic([[(0, 0), (1, 0), (2, 0), (3, 0)], [(3, 0), (2, 0), (1, 0), (0, 0)]])
    assert curvature_bound(back) == (math.inf, 1.0)


def test_the_seam_of_a_closed_curve_is_a_joint() -> None:
    ring = [(0, 0), (20, 0), (20, 20), (0, 20)]
    closed = CardinalSpline(ring, tension=1.0, closed=True)
    np.testing.assert_allclose(corner_angles(closed), np.full(5, math.pi / 2))
    once = PiecewiseCubic(closed.spans)
    np.testing.assert_allclose(corner_angles(once), [0, *np.full(3, math.pi / 2), 0])
    smooth = CardinalSpline(ring, closed=True)
    assert corner_angles(smooth).max() < 1e-12
    assert math.isfinite(curvature_bound(smooth)[0])


def test_a_single_point_between_two_spans_hides_no_corner() -> None:
    stop = [(3, 0)] * 4
    east, north = [(0, 0), (1, 0), (2, 0), (3, 0)], [(3, 0), (3, 1), (3, 2), (3, 3)]
    np.testing.assert_allclose(corner_angles(PiecewiseCubic([east, stop, north]))[2], math.pi / 2)


@settings(max_examples=200)
@given(seeds)
def test_spans_that_cross_themselves_are_those_that_shapely_finds(seed: int) -> None:
    rng = np.random.default_rng(seed)
    spans = rng.normal(0, 1, (40, 4, 2))
    w = np.linspace(0, 1, 2001)
    basis = np.array([(1 - w) ** 3, 3 * w * (1 - w) ** 2, 3 * w**2 * (1 - w), w**3])
    lines = np.einsum("kw,mkd->mwd", basis, spans)
    steps = np.diff(lines, axis=1)
    turns = np.arctan2(
        steps[:, :-1, 0] * steps[:, 1:, 1] - steps[:, :-1, 1] * steps[:, 1:, 0],
        (steps[:, :-1] * steps[:, 1:]).sum(axis=2),
    )
    heading = np.cumsum(turns, axis=1)
    spread = np.maximum(heading.max(axis=1), 0) - np.minimum(heading.min(axis=1), 0)
    expected = ~shapely.is_simple(shapely.linestrings(lines)) | (spread > math.pi)
    doubtful = (np.abs(spread - math.pi) < 0.05) | (np.abs(turns).max(axis=1) > 1.0)
    np.testing.assert_array_equal(self_loops(spans)[~doubtful], expected[~doubtful])


@pytest.mark.parametrize(
    ("span", "loops"),
    [
        ([(0, 0), (9, 9), (-6, 9), (3, 0)], True),
        ([(0, 0), (10, 10), (0, 10), (10, 0)], True),  # a cusp
        ([(0, 0), (10, 10), (0.5, 10), (10, 0)], False),  # nearly one
        ([(0, 0), (9, 0), (-6, 0), (3, 0)], True),  # back on a line
        ([(0, 0), (1, 2), (2, 4), (3, 6)], False),
        ([(0, 0), (0, 0), (3, 3), (3, 3)], False),
        ([(0, 0), (4 / 3, 0), (4 / 3, 2), (0, 2)], False),  # half a turn
        ([(0, 0), (3, -1), (3, 3), (0, 2)], True),  # more than half a turn
        ([(1, 1), (1, 1), (1, 1), (1, 1)], False),
    ],
)
def test_a_span_that_loops_back_is_told(span: list[tuple[float, float]], loops: bool) -> None:
    assert self_loops([span]).tolist() == [loops]
    turned = np.array(span)[::-1] @ np.array([(0.6, 0.8), (-0.8, 0.6)]) + (1e3, -7)
    if span[1] != (10, 10):  # a cusp is one to the last bit only
        assert self_loops([turned]).tolist() == [loops]


def test_spans_of_another_shape_are_refused() -> None:
    with pytest.raises(GeometryError, match="shape"):
        self_loops([[0, 1, 2, 3]])


@pytest.mark.parametrize("away", [(0.0, 0.0), (4.1e5, 5.4e6), (-7.0e6, 2.0e6)])
@pytest.mark.parametrize("size", [0.02, 1.0, 300.0])
def test_a_smooth_curve_has_no_corner_however_far_from_the_origin_it_lies(
    away: tuple[float, float], size: float
) -> None:
    angles = np.cumsum(np.tile([1.0, 1.7, 0.6], 16))
    ring = size * np.exp(2j * math.pi * angles / angles[-1]).view(float).reshape(-1, 2)
    near, there = (
        CardinalSpline(ring + at, knots="chordal", closed=True) for at in ((0.0, 0.0), away)
    )
    rounded = 100.0 * np.spacing(np.abs(away).max()) / (size / 100) ** 2  # of second differences
    expected = curvature_bound(near)[0]
    assert curvature_bound(there)[0] == pytest.approx(expected, rel=1e-5, abs=rounded)


def test_a_corner_is_one_however_far_from_the_origin_it_lies() -> None:
    utm = np.array([4.1e5, 5.4e6])
    for turn in (1e-4, 1e-2):
        lines = np.array([[[-3, 0], [-2, 0], [-1, 0], [0, 0]], [[0, 0], [1, turn], [2, 2 * turn],
                                                                [3, 3 * turn]]])  # fmt: skip
        assert curvature_bound(PiecewiseCubic(lines + utm))[0] == math.inf
    still = np.array([[0, 0]] * 4)[None]  # a span that is a point hides no corner
    parts = np.concatenate((lines[:1], still, lines[1:])) + utm
    assert curvature_bound(PiecewiseCubic(parts))[0] == math.inf
    for short in (1e-17, 1e-9, 0.0):  # the same where it turns back, and stands there all but still
        back = np.array([[[0, 0], [1, 0], [2 - short, 0], [2, 0]], [[2, 0], [2 - short, 0],
                                                                   [1, 0], [0, 0]]])  # fmt: skip
        for away in (0.0, utm):
            assert curvature_bound(PiecewiseCubic(back + away))[0] == math.inf
