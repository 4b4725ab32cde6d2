import numpy as np
import pytest
from scipy.interpolate import BPoly, PPoly

from viaspline.kernels.curve import curvature_extrema, extrema


def found_roots(coefficients):
    out = np.empty(8 * len(coefficients))
    stack = np.empty((extrema.MAX_ROOT_DEPTH, len(coefficients) + 2))
    count = extrema.roots(np.array(coefficients, float), stack, out)
    return out[:count]


@pytest.mark.parametrize(
    "places", [[0.5], [0.25, 0.75], [0.1, 0.100001, 0.9], [1 / 3], [0.2, 0.4, 0.5, 0.7, 0.95]]
)
def test_every_root_inside_is_found(places):
    polynomial = np.polynomial.Polynomial.fromroots(places)
    power = polynomial.coef[::-1, None]
    bernstein = BPoly.from_power_basis(PPoly(power, [0, 1])).c[:, 0]
    roots = found_roots(bernstein)
    for place in places:
        assert np.abs(roots - place).min() < 1e-7
    for root in roots:
        assert np.abs(np.array(places) - root).min() < 1e-7


@pytest.mark.parametrize("coefficients", [[1, 2, 3], [0, 0, 0], [-1, -2, -1], [0, 1, 2]])
def test_where_signs_do_not_change_there_is_no_root(coefficients):
    assert len(found_roots(coefficients)) == 0


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_the_nearest_point_is_the_nearest_of_many(dimension):
    rng = np.random.default_rng(7)
    spans = rng.normal(size=(3, 4, dimension))
    spans[1:, 0] = spans[:-1, 3]
    w = np.linspace(0, 1, 300)[:, None, None]
    v = 1 - w
    dense = v**3 * spans[:, 0] + 3 * v * v * w * spans[:, 1]
    dense = dense + 3 * v * w * w * spans[:, 2] + w**3 * spans[:, 3]
    for point in rng.normal(size=(10, dimension)):
        u, distance = extrema.nearest_parameter(spans, point, 0.0, 3.0)
        brute = np.linalg.norm(dense - point, axis=2)
        assert distance <= brute.min() + 1e-12
        assert distance == pytest.approx(brute.min(), abs=0.05)
        low, high = extrema.nearest_parameter(spans, point, 0.5, 0.5)[0], 0.5
        assert low == high
        assert 0.0 <= u <= 3.0


def test_the_sharpest_place_of_a_symmetric_span_is_its_middle():
    arch = np.array([[[0.0, 0], [1, 2], [2, 2], [3, 0]]])
    value, span, w = curvature_extrema.sharpest(arch)
    assert (span, w) == (0, pytest.approx(0.5))
    assert value == pytest.approx(12 / 9)


def test_a_line_and_a_point_have_no_sharpest_place():
    line = np.array([[[0.0], [1], [2], [3]]])
    assert curvature_extrema.sharpest(line) == (0.0, 0, 0.0)
    assert curvature_extrema.sharpest(np.ones((2, 4, 2))) == (0.0, 0, 0.0)
