"""B-splines on equal knots, beside scipy's splines."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.corridor.bspline import Knots


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("order", [0, 1, 2])
def test_matrices_are_scipys_interpolating_spline(closed: bool, order: int) -> None:
    rng = np.random.default_rng(3)
    count = 9
    points = rng.normal(size=(count if closed else count + 1, 2))
    knots = Knots(count, closed=closed)
    controls = knots.through(points)
    ring = np.vstack((points, points[:1])) if closed else points
    spline = CubicSpline(np.arange(count + 1), ring, bc_type="periodic" if closed else "natural")
    at = rng.uniform(0, count, 50)
    np.testing.assert_allclose(knots.matrix(at, order) @ controls, spline(at, order), atol=1e-10)


@pytest.mark.parametrize("closed", [True, False])
def test_spans_are_the_spline_with_two_continuous_derivatives(closed: bool) -> None:
    knots = Knots(7, closed=closed)
    controls = np.random.default_rng(5).normal(size=(knots.controls, 2))
    curve = PiecewiseCubic(knots.spans(controls), closed=closed)
    at = np.linspace(0, 7, 40)[:-1]
    np.testing.assert_allclose(curve.evaluate(at), knots.matrix(at) @ controls, atol=1e-12)
    assert curve.curvature_jumps().max() < 1e-9


def test_an_open_spline_starts_and_ends_at_its_control_points() -> None:
    knots = Knots(4, closed=False)
    controls = np.random.default_rng(6).normal(size=(knots.controls, 2))
    spans = knots.spans(controls)
    np.testing.assert_allclose(spans[0, 0], controls[0], atol=1e-14)
    np.testing.assert_allclose(spans[-1, 3], controls[-1], atol=1e-14)
