import numpy as np
import pytest

from viaspline.kernels.curve.cardinal_tangents import (
    cardinal_spans,
    continuous_spans,
    knot_spacing,
    slopes_of,
)

ZIGZAG = np.array([(0.0, 0.0), (3.0, 4.0), (3.0, 4.0), (3.0, 5.0), (12.0, 5.0)])
NOWHERE = np.zeros(2)
PIECES = {cardinal_spans: 1, continuous_spans: 3}
FAMILY = pytest.mark.parametrize("kernel", [cardinal_spans, continuous_spans])


@pytest.mark.parametrize(
    ("alpha", "expected"),
    [
        (0.0, [1, 1, 1, 1, 1]),
        (0.5, [5**0.5, 0, 1, 3, 13**0.5]),
        (1.0, [5, 0, 1, 9, 13]),
        (0.25, [5**0.25, 0, 1, 3**0.5, 13**0.25]),
    ],
)
def test_knots_are_a_power_of_the_chord_apart(alpha, expected):
    assert knot_spacing(ZIGZAG, alpha, True) == pytest.approx(expected)
    assert knot_spacing(ZIGZAG, alpha, False) == pytest.approx(expected[:4])


def test_slopes_leave_out_spans_without_length():
    kept, h, slopes = slopes_of(ZIGZAG, knot_spacing(ZIGZAG, 1.0, False))
    assert np.array_equal(kept, [0, 2, 3])
    assert np.array_equal(h, [5, 1, 9])
    assert slopes == pytest.approx(np.array([(0.6, 0.8), (0, 1), (1, 0)]))


@FAMILY
@pytest.mark.parametrize("alpha", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("count", [2, 3, 5])
def test_spans_run_from_point_to_point_and_are_smooth(kernel, alpha, closed, count):
    points = np.random.default_rng(count).normal(size=(count, 3))
    spans = count if closed else count - 1
    nowhere = np.zeros(3)
    polygons = kernel(points, alpha, np.full(spans, 0.4), nowhere, nowhere, False, False, closed)
    pieces = PIECES[kernel]
    assert polygons.shape == (pieces * spans, 4, 3)
    assert np.array_equal(polygons[::pieces, 0], points[:spans])
    assert np.array_equal(polygons[pieces - 1 :: pieces, 3], np.roll(points, -1, axis=0)[:spans])
    spacing = np.repeat(knot_spacing(points, alpha, closed), pieces)[:, None]
    leaving = (polygons[:, 1] - polygons[:, 0]) / spacing
    arriving = (polygons[:, 3] - polygons[:, 2]) / spacing
    for k in range(0 if closed else 1, pieces * spans):
        assert leaving[k] == pytest.approx(arriving[k - 1])


@FAMILY
def test_directions_count_only_when_they_are_given(kernel):
    slack = np.full(4, 0.5)
    east = np.array([1.0, 0.0])
    north = np.array([0.0, 1.0])
    free = kernel(ZIGZAG, 1.0, slack, east, north, False, False, False)
    start = kernel(ZIGZAG, 1.0, slack, east, north, True, False, False)
    both = kernel(ZIGZAG, 1.0, slack, east, north, True, True, False)
    assert free[0, 1, 1] > 0.0
    assert start[0, 1] == pytest.approx([5 / 3 / PIECES[kernel], 0])
    assert both[-1, 2] == pytest.approx([12, 5 - 9 / 3 / PIECES[kernel]])
    assert start[-1, 2, 0] < 12.0


@FAMILY
def test_points_all_the_same_give_empty_spans(kernel):
    points = np.full((3, 2), 7.0)
    polygons = kernel(points, 1.0, np.full(2, 0.5), NOWHERE, NOWHERE, True, True, False)
    assert np.array_equal(polygons, np.full((2 * PIECES[kernel], 4, 2), 7.0))
