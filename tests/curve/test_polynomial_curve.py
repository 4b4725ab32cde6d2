import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import make_interp_spline

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.curve.polynomial_curve import PolynomialCurve, curve_from, polynomial_from


@given(seed=st.integers(0, 10_000), degree=st.sampled_from([1, 3, 5]))
@settings(max_examples=40, deadline=None)
def test_a_spline_of_scipy_is_evaluated_as_scipy_does(seed: int, degree: int) -> None:
    rng = np.random.default_rng(seed)
    x = np.cumsum(rng.uniform(0.2, 2.0, degree + 4))
    spline = make_interp_spline(x, rng.normal(size=(len(x), 2)), k=degree)
    curve = polynomial_from(spline)
    assert curve is not None
    assert curve.domain == (x[0], x[-1])
    u = rng.uniform(x[0], x[-1], 50)
    for derivative in range(3):
        if derivative < degree:
            assert curve.evaluate(u, derivative) == pytest.approx(spline(u, derivative), abs=1e-8)


def test_cubics_are_taken_as_piecewise_cubics_and_others_as_they_are() -> None:
    points = [(0, 0), (1, 2), (3, 2), (4, 0), (5, 5), (6, 0)]
    cubic = make_interp_spline(range(6), points, k=3)
    quintic = make_interp_spline(range(6), points, k=5)
    assert isinstance(curve_from(cubic), PiecewiseCubic)
    assert isinstance(curve_from(quintic), PolynomialCurve)
    ours = CardinalSpline(points)
    assert curve_from(ours) is ours
    assert polynomial_from("x") is None
