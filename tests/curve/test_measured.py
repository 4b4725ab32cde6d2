from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError

FAMILIES = [
    {},
    {"tension": 1.0},
    {"tension": 0.97},
    {"tension": -1.0, "knots": "chordal"},
    {"knots": "centripetal", "closed": True},
    {"tangents": "continuous", "tension": 0.3},
]


def curve(dimension=2, count=8, seed=4, **family):
    points = np.random.default_rng(seed).uniform(-5, 5, (count, dimension))
    return CardinalSpline(points, **family)


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("family", FAMILIES)
def test_length_is_the_integral_of_the_speed(dimension, family):
    ours = curve(dimension, **family)

    def speed(u):
        return np.linalg.norm(ours.evaluate(u, 1))

    breaks = np.linspace(0, ours.domain[1], 20 * len(ours.spans) + 1)
    expected = sum(
        quad(speed, a, b, epsabs=1e-10, epsrel=1e-11, limit=500)[0] for a, b in pairwise(breaks)
    )
    assert ours.length == pytest.approx(expected, rel=1e-9)


def test_the_length_through_a_cusp_is_exact_enough():
    there_and_back = PiecewiseCubic([[[0.0], [2.0], [-1.0], [1.0]]])
    u = np.roots([3 * 10, -2 * 15, 6])
    high, low = np.sort(there_and_back.evaluate(u).ravel())[::-1]
    assert there_and_back.length == pytest.approx(2 * high - 2 * low + 1, rel=1e-9)


@pytest.mark.parametrize("family", FAMILIES)
def test_distance_and_parameter_are_inverse(family):
    ours = curve(**family)
    s = np.linspace(0, ours.length, 301)
    u = ours.parameter(s)
    assert np.all(np.diff(u) > 0)
    assert ours.distance(u) == pytest.approx(s, abs=1e-12 * ours.length)
    inside = np.linspace(0.01, ours.domain[1] - 0.01, 99)
    assert ours.parameter(ours.distance(inside)) == pytest.approx(inside, abs=1e-6)
    assert ours.at_distance(s) == pytest.approx(ours.evaluate(u))
    assert ours.distance(ours.domain[1]) == ours.length
    assert ours.parameter(ours.length) == ours.domain[1]


def test_distances_of_a_closed_curve_wrap():
    ours = curve(closed=True)
    assert ours.at_distance(ours.length + 1.0) == pytest.approx(ours.at_distance(1.0))
    assert ours.at_distance(-1.0) == pytest.approx(ours.at_distance(ours.length - 1.0))
    assert ours.parameter([-1.0]).shape == (1,)


@pytest.mark.parametrize("s", [-0.001, np.nan, np.inf, 1e9])
def test_a_distance_that_is_not_on_an_open_curve_is_named(s):
    with pytest.raises(GeometryError, match=r"s = .* is outside \[0.0, "):
        curve().parameter(s)
    with pytest.raises(GeometryError, match="outside"):
        curve().at_distance([0.0, s])


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("spacing", [0.01, 0.37, 1e9])
def test_samples_are_equally_spaced_and_reach_both_ends(family, spacing):
    ours = curve(**family)
    u, s, points = ours.sample(spacing)
    assert np.array_equal(points[0], ours.evaluate(0.0))
    assert np.array_equal(points[-1], ours.evaluate(ours.domain[1]))
    assert u[-1] == ours.domain[1]
    assert s[-1] == ours.length
    steps = np.diff(s)
    assert steps.max() <= spacing * (1 + 1e-9)
    assert steps == pytest.approx(np.full(len(steps), ours.length / len(steps)))
    assert np.linalg.norm(np.diff(points, axis=0), axis=1).max() <= steps.max() * (1 + 1e-9)


def test_a_length_that_the_spacing_divides_is_divided_so():
    line = PiecewiseCubic([[[0, 0], [1, 0], [2, 0], [3, 0]]])
    assert line.sample(0.1)[1] == pytest.approx(np.linspace(0, 3, 31))


@pytest.mark.parametrize("spacing", [0.0, -1.0, np.nan, 1e-12])
def test_a_spacing_that_makes_no_sense_is_refused(spacing):
    with pytest.raises(GeometryError, match="spacing"):
        curve().sample(spacing)


@settings(deadline=None)
@given(
    seed=st.integers(0, 1000),
    x=st.floats(-12, 12),
    y=st.floats(-12, 12),
    family=st.sampled_from(FAMILIES),
)
def test_the_projection_is_the_nearest_of_all_points(seed, x, y, family):
    ours = curve(seed=seed, **family)
    dense = ours.evaluate(np.linspace(0, ours.domain[1], 4001))
    found = ours.project((x, y))
    assert found.distance <= np.hypot(*(dense - (x, y)).T).min() + 1e-12
    assert found.distance >= shapely.LineString(dense).distance(shapely.Point(x, y)) - 1e-3
    assert np.array_equal(found.point, ours.evaluate(found.u))
    assert np.hypot(*(found.point - (x, y))) == pytest.approx(found.distance, abs=1e-9)


@pytest.mark.parametrize("dimension", [1, 2, 3, 4])
def test_a_point_of_the_curve_projects_onto_itself(dimension):
    ours = curve(dimension)
    for u in np.linspace(0, ours.domain[1], 50):
        found = ours.project(ours.evaluate(u))
        assert found.distance < 1e-12
        if dimension > 1:
            assert found.u == pytest.approx(u, abs=1e-7)


def test_of_several_nearest_points_the_first_is_taken():
    square = CardinalSpline([(1, 1), (-1, 1), (-1, -1), (1, -1)], closed=True)
    assert square.project((0, 0)).u == pytest.approx(square.project((0, 0.0)).u)
    assert square.project((0, 0)).u < 1.0


def test_a_projection_can_be_kept_to_a_part_of_the_curve():
    line = CardinalSpline([(0, 0), (4, 0), (4, 1), (0, 1)], 1.0)
    assert line.project((1, 0.1)).u < 1.0
    kept = line.project((1, 0.1), between=(1.5, 3.0))
    assert 2.0 < kept.u < 3.0
    assert kept.distance == pytest.approx(0.9)
    assert line.project((4, -3), between=(0.25, 0.5)).u == 0.5
    with pytest.raises(GeometryError, match="between"):
        line.project((1, 0), between=(2, 4))


@pytest.mark.parametrize("point", [(0,), (0, 0, 0), (np.nan, 0), "ab"])
def test_a_point_that_is_none_is_not_projected(point):
    with pytest.raises(GeometryError):
        curve().project(point)


@settings(deadline=None)
@given(seed=st.integers(0, 1000), dimension=st.integers(2, 4), family=st.sampled_from(FAMILIES))
def test_no_sample_bends_more_than_the_largest_curvature(seed, dimension, family):
    ours = curve(dimension, seed=seed, **family)
    u = np.linspace(0, ours.domain[1], 20001)
    value, at = ours.max_curvature()
    assert value >= np.abs(ours.curvature(u)).max() * (1 - 1e-9)
    near = np.clip(at + np.linspace(-1e-6, 1e-6, 41), 0, ours.domain[1])
    assert np.abs(ours.curvature(near)).max() == pytest.approx(value, rel=1e-2)


def test_the_largest_curvature_sees_both_sides_of_a_joint():
    straight = [[0, 0], [1, 0], [2, 0], [3, 0]]
    bend = [[3, 0], [4, 0], [4, 1], [4, 2]]
    for spans, u in (([straight, bend], 1.0), ([np.flip(bend, 0), np.flip(straight, 0)], 1.0)):
        ours = PiecewiseCubic(spans)
        assert ours.curvature_jumps() == pytest.approx([2 / 3])
        value, at = ours.max_curvature()
        assert value >= 2 / 3
        assert abs(at - u) < 0.5


def test_a_needle_of_curvature_is_not_missed():
    needle = PiecewiseCubic([[[0, 0], [10, 1e-3], [-9, 1e-3], [1, 0]]])
    value, at = needle.max_curvature()
    fine = np.abs(needle.curvature(at + np.linspace(-1e-4, 1e-4, 2001)))
    assert value >= fine.max() * (1 - 1e-12)
    assert value > 1e3


@settings(deadline=None, max_examples=200)
@given(
    at=st.floats(0.05, 0.95),
    ahead=st.floats(0.5, 3.0),
    change=st.floats(-0.4, 3.0),
    flat=st.floats(-8.0, 0.0).map(lambda power: 10.0**power),
    turned=st.floats(0.0, 6.3),
)
def test_a_reversal_on_a_nearly_straight_span_is_as_sharp_as_it_is(at, ahead, change, flat, turned):
    """P' = ((w - at) (ahead + change w), flat): so curvature about ``at`` is known to a digit."""
    along = (-at * ahead, 0.5 * (ahead - at * change) - at * ahead, (1 - at) * (ahead + change))
    steps = np.stack((along, np.full(3, flat)), axis=1) / 3
    places = np.vstack(([0.0, 0.0], np.cumsum(steps, axis=0)))
    c, s = np.cos(turned), np.sin(turned)
    value, u = PiecewiseCubic([places @ [[c, s], [-s, c]]]).max_curvature()
    away = np.concatenate((np.linspace(0.0, 1.0, 20001), np.geomspace(1e-14, 1.0, 20001)))
    away = np.concatenate((-away[away <= at], away[away <= 1 - at]))
    forwards = away * (ahead + change * (at + away))
    bend = ahead + change * (at + 2 * away)
    curvature = flat * np.abs(bend) / np.hypot(forwards, flat) ** 3
    rounding = 1e-15 / flat
    assert value >= curvature.max() * (1 - 1e-6 - rounding)
    assert value <= curvature.max() * (1 + 1e-4 + rounding)
    assert abs(u - at) < 2 * flat or flat > 1e-2


def test_a_straight_line_that_goes_back_on_the_way_has_a_cusp_there():
    line = PiecewiseCubic([[[0, 0], [3, 3], [-2, -2], [1, 1]]])
    value, u = line.max_curvature()
    assert value == np.inf
    assert np.linalg.norm(line.evaluate(u, 1)) < 1e-8
    pause = PiecewiseCubic([np.outer([0, 1, 0, 1], [0.3, 0.7])])
    assert pause.max_curvature()[0] == 0.0


def test_a_polyline_and_a_line_have_no_curvature_and_no_jumps():
    for dimension in (1, 2, 3):
        ours = curve(dimension, tension=1.0)
        assert ours.max_curvature()[0] == 0.0
        assert np.array_equal(ours.curvature_jumps(), np.zeros(6))


def test_jumps_are_the_difference_across_each_joint():
    ours = curve()
    eps = 1e-9
    expected = [abs(ours.curvature(k) - ours.curvature(k - eps)) for k in range(1, 7)]
    assert ours.curvature_jumps() == pytest.approx(expected, abs=1e-5)
    assert curve(closed=True).curvature_jumps().shape == (8,)
    assert curve(count=2).curvature_jumps().shape == (0,)


def test_jumps_in_space_are_those_of_the_curvature_vector():
    up = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 1]]
    flat = PiecewiseCubic([np.array([[-3, 1, 0], [-2, 0, 0], [-1, 0, 0], [0, 0, 0]]), np.array(up)])
    assert flat.curvature_jumps() == pytest.approx([0.0])
    bent = PiecewiseCubic(
        [
            np.array([[-2, 3, 0], [-2, 2, 0], [-1, 0, 0], [0, 0, 0]]),
            np.array([[0, 0, 0], [1, 0, 0], [2, 0, 2], [2, 0, 3]]),
        ]
    )
    assert bent.curvature_jumps() == pytest.approx([np.hypot(4 / 3, 4 / 3)])


def test_a_cusp_at_a_joint_jumps_without_bound():
    ours = PiecewiseCubic([[[-1, 0], [-1, 0], [0, 0], [0, 0]], [[0, 0], [0, 0], [1, 0], [2, 1]]])
    assert np.array_equal(ours.curvature_jumps(), [np.inf])
    assert ours.max_curvature() == (np.inf, 1.0)
