import copy

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.interpolate import BPoly

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError

LINE = [[0, 0], [1, 0], [2, 0], [3, 0]]


def curve(dimension=2, spans=6, closed=False, seed=2):
    points = np.random.default_rng(seed).uniform(-5, 5, (spans + (not closed), dimension))
    return CardinalSpline(points, knots="chordal", closed=closed)


@pytest.mark.parametrize("dimension", [1, 2, 3, 5])
@pytest.mark.parametrize("derivative", [0, 1, 2, 3])
def test_values_and_derivatives_are_those_of_scipys_bernstein_polynomials(dimension, derivative):
    ours = curve(dimension)
    peer = BPoly(np.swapaxes(ours.spans, 0, 1), np.arange(7.0))
    u = np.random.default_rng(0).uniform(0, 6, 200)
    expected = peer(u, nu=derivative) if derivative else peer(u)
    assert np.abs(ours.evaluate(u, derivative) - expected).max() < 1e-9


@pytest.mark.parametrize("derivative", [1, 2, 3])
def test_derivatives_are_finite_differences_of_the_ones_below(derivative):
    ours = curve(3)
    u = np.array([0.3, 1.7, 5.5])
    step = 1e-5
    above = ours.evaluate(u + step, derivative - 1)
    below = ours.evaluate(u - step, derivative - 1)
    assert ours.evaluate(u, derivative) == pytest.approx((above - below) / (2 * step), abs=1e-5)


def test_the_answer_has_the_shape_of_the_question():
    ours = curve()
    assert ours.evaluate(1.5).shape == (2,)
    assert ours.evaluate([1.5]).shape == (1, 2)
    assert ours.evaluate(np.zeros((3, 4))).shape == (3, 4, 2)
    assert ours.evaluate([]).shape == (0, 2)
    assert isinstance(ours.curvature(1.5), float)
    assert isinstance(ours.heading(1.5), float)
    assert isinstance(ours.distance(1.5), float)
    assert ours.curvature(np.zeros((3, 4))).shape == (3, 4)
    assert ours.heading(np.zeros((3, 4))).shape == (3, 4)
    assert ours.tangent(np.zeros((3, 4))).shape == (3, 4, 2)


def test_strided_read_only_and_whole_number_parameters_are_taken():
    ours = curve()
    u = np.arange(12.0)[::2] / 2
    frozen = u.copy()
    frozen.flags.writeable = False
    assert np.array_equal(ours.evaluate(u), ours.evaluate(frozen))
    assert np.array_equal(ours.evaluate(np.arange(6)), ours.spans[:, 0])


def test_at_a_joint_the_span_on_the_right_counts_and_at_the_end_the_last():
    ours = curve()
    assert np.array_equal(ours.evaluate(2.0, 1), 3 * (ours.spans[2, 1] - ours.spans[2, 0]))
    assert np.array_equal(ours.evaluate(6.0), ours.spans[-1, 3])
    assert np.array_equal(ours.evaluate(6.0, 1), 3 * (ours.spans[-1, 3] - ours.spans[-1, 2]))


def test_every_order_of_parameters_gives_the_same_points():
    ours = curve(2, 40)
    rng = np.random.default_rng(0)
    u = np.sort(rng.uniform(0, 40, 2000))
    mixed = rng.permutation(2000)
    assert np.array_equal(ours.evaluate(u)[mixed], ours.evaluate(u[mixed]))
    assert ours.evaluate(-0.0) == pytest.approx(ours.spans[0, 0])
    jumping = rng.integers(0, 40, 500) + np.linspace(0, 1, 500)
    one_by_one = [ours.evaluate(u) for u in jumping]
    assert np.array_equal(ours.evaluate(jumping), one_by_one)


@pytest.mark.parametrize("value", [-1e-9, 6.000001, np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("verb", ["evaluate", "tangent", "heading", "curvature", "distance"])
def test_a_parameter_outside_an_open_curve_is_named_with_the_domain(value, verb):
    with pytest.raises(GeometryError, match=r"u = .* is outside \[0.0, 6.0\]"):
        getattr(curve(), verb)([0.5, value])


@pytest.mark.parametrize("verb", ["evaluate", "tangent", "heading", "curvature", "distance"])
@pytest.mark.parametrize("dimension", [2, 3])
def test_a_closed_curve_wraps(verb, dimension):
    ours = curve(dimension, closed=True)
    call = getattr(ours, verb)
    assert call([6.25, -5.75, 120.25]) == pytest.approx(np.array([call(0.25)] * 3))
    with pytest.raises(GeometryError, match="outside"):
        call(np.nan)
    with pytest.raises(GeometryError, match="outside"):
        call(np.inf)


@pytest.mark.parametrize("derivative", [-1, 4, "first"])
def test_a_derivative_that_there_is_not_is_refused(derivative):
    with pytest.raises(GeometryError, match="derivative has to be 0, 1, 2 or 3"):
        curve().evaluate(0.5, derivative)


def test_parameters_that_are_not_numbers_are_refused():
    with pytest.raises(GeometryError, match="expected numbers"):
        curve().evaluate("half")


def test_curvature_is_that_of_the_derivatives():
    u = np.linspace(0.01, 5.99, 77)
    flat = curve(2)
    (x1, y1), (x2, y2) = flat.evaluate(u, 1).T, flat.evaluate(u, 2).T
    assert flat.curvature(u) == pytest.approx((x1 * y2 - y1 * x2) / np.hypot(x1, y1) ** 3)
    space = curve(3)
    first, second = space.evaluate(u, 1), space.evaluate(u, 2)
    expected = np.linalg.norm(np.cross(first, second), axis=1)
    assert space.curvature(u) == pytest.approx(expected / np.linalg.norm(first, axis=1) ** 3)
    assert np.array_equal(curve(1).curvature(u), np.zeros(77))


def test_a_plane_curve_in_space_has_the_curvature_of_the_plane_without_sign():
    flat = curve(2)
    for dimension in (3, 4):
        spans = np.zeros((6, 4, dimension))
        spans[:, :, :2] = flat.spans
        u = np.linspace(0, 6, 50)
        assert PiecewiseCubic(spans).curvature(u) == pytest.approx(np.abs(flat.curvature(u)))


def test_a_left_turn_has_positive_curvature_and_a_circle_its_own():
    k = 4 / 3 * np.tan(np.pi / 8)
    quarter = PiecewiseCubic([[[2, 0], [2, 2 * k], [2 * k, 2], [0, 2]]])
    assert quarter.curvature(0.5) == pytest.approx(0.5, rel=1e-2)
    assert quarter.heading(0.5) == pytest.approx(3 * np.pi / 4)


def test_a_polyline_has_directions_and_no_curvature_at_its_corners():
    polyline = CardinalSpline([(0, 0), (2, 0), (2, 2)], 1.0)
    assert polyline.heading([0, 0.5, 1, 1.5, 2]) == pytest.approx([0, 0] + [np.pi / 2] * 3)
    near = [0, 1e-12, 0.3, 1 - 1e-12, 1, 1 + 1e-15, 1.7, 2 - 1e-13, 2]
    assert np.array_equal(polyline.curvature(near), np.zeros(9))
    tilted = CardinalSpline([(0.1, 0.3), (2.7, 1.9), (2, 7.7)], 1.0)
    assert np.array_equal(tilted.curvature(near), np.zeros(9))
    assert np.array_equal(
        CardinalSpline([(0, 0, 0), (1, 2, 3)], 1.0).curvature([0, 0.5, 1]), [0] * 3
    )


def test_a_cusp_has_infinite_curvature_and_the_direction_that_it_leaves_in():
    cusp = PiecewiseCubic([[[0, 0], [0, 0], [1, 0], [2, 1]]])
    assert cusp.curvature(0.0) == np.inf
    assert cusp.tangent(0.0) == pytest.approx([1, 0])
    mirrored = PiecewiseCubic([[[0, 0], [0, 0], [1, 0], [2, -1]]])
    assert mirrored.curvature(0.0) == -np.inf
    back = PiecewiseCubic([[[2, 1], [1, 0], [0, 0], [0, 0]]])
    assert back.tangent(1.0) == pytest.approx([-1, 0])
    space = PiecewiseCubic([[[0, 0, 0], [0, 0, 0], [1, 0, 0], [2, 1, 0]]])
    assert space.curvature(0.0) == np.inf


def test_a_span_that_is_a_point_takes_the_tangent_of_its_neighbour():
    point = [[3, 0]] * 4
    assert PiecewiseCubic([point, np.add(LINE, [3, 0])]).tangent(0.5) == pytest.approx([1, 0])
    assert PiecewiseCubic([LINE, point]).tangent([1.5, 2.0]) == pytest.approx(
        np.array([[1, 0]] * 2)
    )
    third = PiecewiseCubic([[[0, 0], [0, 0], [0, 0], [0, 2]]])
    assert third.tangent([0, 1]) == pytest.approx(np.array([[0, 1]] * 2))


def test_a_curve_of_one_dimension_has_no_heading():
    with pytest.raises(GeometryError, match="no heading"):
        curve(1).heading(0.5)


@settings(deadline=None)
@given(u0=st.floats(0, 6), u1=st.floats(0, 6), closed=st.booleans())
@example(u0=1.0, u1=4.0, closed=False)
@example(u0=1.25, u1=1.75, closed=False)
@example(u0=5.5, u1=0.5, closed=True)
@example(u0=6.0, u1=2.5, closed=True)
@example(u0=2.5, u1=0.0, closed=True)
def test_a_section_is_the_same_curve_between_its_ends(u0, u1, closed):
    whole = curve(3, closed=closed)
    if abs(u0 - u1) < 1e-9 or (not closed and u1 < u0) or (u0 == 6.0 and u1 == 0.0):
        return
    part = whole.section(u0, u1)
    assert part.evaluate(0.0) == pytest.approx(whole.evaluate(u0), abs=1e-12)
    assert part.evaluate(part.domain[1]) == pytest.approx(whole.evaluate(u1), abs=1e-12)
    expected = whole.distance(u1) - whole.distance(u0)
    expected += whole.length if u1 < u0 else 0.0
    assert part.length == pytest.approx(expected, rel=1e-8, abs=1e-9)
    assert not part.closed
    middle = part.at_distance(0.4 * part.length)
    assert whole.project(middle).distance < 1e-9
    assert part.knots[-1] >= part.knots[0]


def test_whole_spans_of_a_section_are_taken_over_bit_by_bit():
    whole = curve()
    assert np.array_equal(whole.section(1, 4).spans, whole.spans[1:4])
    assert np.array_equal(whole.section(0.5, 4.5).spans[1:4], whole.spans[1:4])
    assert whole.section(1.5, 3.25).knots == pytest.approx(
        np.interp([1.5, 2, 3, 3.25], np.arange(7), whole.knots)
    )


def test_splitting_and_joining_gives_the_curve_back():
    whole = curve()
    first, second = whole.split(2.5)
    assert len(first.spans) == 3
    assert len(second.spans) == 4
    again = first.joined(second)
    assert again.length == pytest.approx(whole.length)
    assert again.knots == pytest.approx(np.insert(whole.knots, 3, whole.knots[2:4].mean()))
    aligned = whole.section(0, 2).joined(whole.section(2, 6))
    assert np.array_equal(aligned.spans, whole.spans)


@pytest.mark.parametrize(
    ("u0", "u1", "message"),
    [
        (1, 1, "empty"),
        (3, 2, "empty"),
        (-1, 2, "outside"),
        (0, 7, "outside"),
        (0, np.nan, "outside"),
    ],
)
def test_a_section_that_is_not_one_is_refused(u0, u1, message):
    with pytest.raises(GeometryError, match=message):
        curve().section(u0, u1)


def test_curves_that_do_not_fit_are_not_joined():
    with pytest.raises(GeometryError, match="span 1 starts 3 m from where span 0 ends"):
        PiecewiseCubic([LINE]).joined(PiecewiseCubic([LINE]))
    with pytest.raises(GeometryError, match="closed"):
        curve(closed=True).joined(curve())
    with pytest.raises(GeometryError, match="dimension 3"):
        curve(2).joined(curve(3))


@pytest.mark.parametrize(
    ("spans", "message"),
    [
        (LINE, "shape"),
        (np.zeros((0, 4, 2)), "shape"),
        (np.zeros((1, 3, 2)), "shape"),
        ([[[0, 0], [1, 0], [2, np.nan], [3, 0]]], "span 0 .* not finite"),
        ([[[0, 0], [1, 0], [2, 1e101], [3, 0]]], "span 0 .* not finite"),
        ([LINE, np.add(LINE, [3.1, 0])], "span 1 starts 0.1 m from where span 0 ends"),
        ([[1, 2], [3]], "expected numbers"),
    ],
)
def test_spans_that_are_no_curve_are_refused(spans, message):
    with pytest.raises(GeometryError, match=message):
        PiecewiseCubic(spans)


def test_a_closed_curve_has_to_end_where_it_starts():
    with pytest.raises(GeometryError, match="span 0 starts 3 m from where span 0 ends"):
        PiecewiseCubic([LINE], closed=True)


def test_a_gap_that_is_rounding_is_closed():
    almost = np.add(LINE, [3 + 1e-12, 0])
    spans = PiecewiseCubic([LINE, almost]).spans
    assert np.array_equal(spans[0, 3], spans[1, 0])
    loop = np.array([[0, 0], [1, 2], [2, -2], [1e-12, 0]])
    spans = PiecewiseCubic([loop], closed=True).spans
    assert np.array_equal(spans[0, 3], spans[0, 0])


def test_knots_are_checked():
    assert np.array_equal(PiecewiseCubic([LINE]).knots, [0, 1])
    assert np.array_equal(PiecewiseCubic([LINE], knots=[2, 5]).knots, [2, 5])
    for knots in ([0], [1, 0], [0, np.nan]):
        with pytest.raises(GeometryError, match="knots have to be 2 numbers"):
            PiecewiseCubic([LINE], knots=knots)


def test_a_curve_is_immutable_and_its_copy_is_itself():
    ours = curve()
    assert copy.copy(ours) is ours
    assert copy.deepcopy(ours) is ours
    assert repr(ours) == "<CardinalSpline: 6 spans, d = 2>"
    with pytest.raises(AttributeError):
        ours.spans = np.zeros((1, 4, 2))
    with pytest.raises(AttributeError):
        ours.closed = True
