import numpy as np
import pytest
from scipy.integrate import quad

from viaspline.kernels.curve import arclength, cubic


def rows_of(spans):
    return cubic.prepare(np.array(spans, float), False)[0]


BENT = [[0, 0], [4, 1], [-2, 3], [1, 1]]


def test_a_span_is_as_long_as_the_integral_of_its_speed():
    rows = rows_of([BENT])
    expected = quad(lambda w: arclength.speed(rows, 0, w), 0, 1, epsabs=1e-13, limit=200)[0]
    assert arclength.span_length(rows, 0) == pytest.approx(expected, rel=1e-9)


def test_a_kink_of_the_speed_between_the_nodes_is_seen():
    """P' = (w - 0.999)(w + 2): back on itself in the last thousandth."""
    turn = 0.999
    rows = np.zeros((2, 4, 1))
    rows[0, 1:, 0] = -2 * turn, (2 - turn) / 2, 1 / 3
    value = np.polynomial.Polynomial(rows[0, :, 0])
    expected = abs(value(turn) - value(0)) + abs(value(1) - value(turn))
    assert arclength.span_length(rows, 0) == pytest.approx(expected, rel=1e-9)


def test_the_table_holds_every_joint_and_grows_as_needed():
    rng = np.random.default_rng(0)
    spans = rng.normal(size=(40, 4, 2))
    spans[1:, 0] = spans[:-1, 3]
    at, along = arclength.length_table(rows_of(spans))
    assert np.isin(np.arange(41.0), at).all()
    assert np.all(np.diff(at) > 0)
    assert np.all(np.diff(along) >= 0)
    assert len(at) > 4 * 40 + 64


def test_distances_and_parameters_undo_each_other():
    rows = rows_of([BENT, [[1, 1], [1, 1], [3, 3], [3, 3]]])
    at, along = arclength.length_table(rows)
    s = np.linspace(0, along[-1], 60)
    u, again = np.empty(60), np.empty(60)
    assert arclength.parameters(rows, at, along, s, False, u) == -1
    assert arclength.distances(rows, at, along, u, False, again) == -1
    assert again == pytest.approx(s, abs=1e-13)
    assert arclength.parameters(rows, at, along, np.array([1.0, 1e3]), False, u) == 1
    assert arclength.distances(rows, at, along, np.array([-1.0]), False, u) == 0
    wrapped = np.array([1.0 + along[-1], 1.0])
    assert arclength.parameters(rows, at, along, wrapped, True, u) == -1
    assert u[0] == pytest.approx(u[1])


def test_a_curve_of_no_length_has_only_its_start():
    rows = rows_of(np.ones((1, 4, 2)))
    at, along = arclength.length_table(rows)
    out = np.empty(1)
    assert along[-1] == 0.0
    assert arclength.parameters(rows, at, along, np.zeros(1), False, out) == -1
    assert arclength.parameters(rows, at, along, np.ones(1), True, out) == 0
