"""The sharpest bend is that of a parabola, which is known in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.checking.sharpest_bend import HAIRPIN_1PM, sharpest_bend


def parabola(depth: float, across: float, angle: float) -> PiecewiseCubic:
    """A curve that goes ahead, stands but for its speed across in the middle, and comes back.

    Its derivative is (depth (1 - 2 w), across), so that its sharpest bend is 2 depth / across².
    """
    knots = np.array([[0, 0], [depth / 3, across / 3], [depth / 3, 2 * across / 3], [0, across]])
    turned = [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
    before = [[-3.0, 0.0], [-2.0, 0.0], [-1.0, 0.0], [0.0, 0.0]]
    return PiecewiseCubic([before, (knots @ np.transpose(turned)).tolist()])


@given(st.floats(0.1, 20.0), st.floats(-4.0, 0.0), st.floats(0.0, math.tau))
def test_a_parabola_bends_most_where_it_turns_back(depth: float, size: float, angle: float) -> None:
    across = depth * 10.0**size
    found = sharpest_bend(parabola(depth, across, angle), 1.0, 2.0)
    assert found == pytest.approx(2.0 * depth / across**2, rel=1e-6)


def test_only_the_part_that_is_asked_for_counts() -> None:
    path = parabola(5.0, 1e-3, 0.3)
    assert sharpest_bend(path, 0.2, 0.9) < HAIRPIN_1PM
    assert sharpest_bend(path, 0.2, 1.1) > HAIRPIN_1PM
    assert sharpest_bend(path, 0.5, 0.5) < HAIRPIN_1PM
