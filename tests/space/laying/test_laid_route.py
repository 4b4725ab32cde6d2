import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.space.laying.laid_route import CurveShape, RouteLegs, lay_route

seeds = st.integers(0, 10_000)


def random_route(seed: int) -> RouteLegs:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 8))
    vias = rng.uniform(0, 100, (count, 3))
    legs = RouteLegs.left_to_the_spline(
        vias, np.full((count, 3), np.nan), CurveShape(rng.uniform(-0.5, 0.8, count - 1)), 0.5
    )
    for leg in np.flatnonzero(rng.random(count - 1) < 0.4).tolist():
        inner = rng.uniform(0, 100, (int(rng.integers(0, 4)), 3))
        legs = legs.led_round(leg, inner, float(rng.uniform(1, 20)))
    return legs


@given(seed=seeds)
def test_a_route_passes_its_via_points_exactly_with_continuous_direction_and_curvature(
    seed: int,
) -> None:
    legs = random_route(seed)
    laid = lay_route(legs)
    places = np.concatenate((laid.spans[:, 0], laid.spans[-1:, 3]))
    assert np.array_equal(places[laid.joints], legs.vias)
    curve = PiecewiseCubic(laid.spans)
    joints = np.arange(1, len(curve.spans))
    if len(joints):
        before, after = curve.tangent(joints - 1e-7), curve.tangent(joints + 1e-7)
        assert np.abs(before - after).max() < 1e-2
        bends = curve.curvature(joints - 1e-7), curve.curvature(joints + 1e-7)
        assert np.allclose(*bends, rtol=1e-2, atol=1e-3)


@given(seed=seeds)
def test_a_route_that_nothing_stands_in_the_way_of_is_the_cardinal_spline(seed: int) -> None:
    legs = random_route(seed)
    free = RouteLegs.left_to_the_spline(legs.vias, legs.given, legs.shape)
    laid = lay_route(free)
    spline = CardinalSpline(legs.vias, legs.shape.tension, knots="chordal", tangents="continuous")
    assert np.array_equal(laid.spans, spline.spans)
    assert not any(len(one) for one in laid.detours)


def test_a_direction_that_is_given_is_the_direction_there_on_both_sides() -> None:
    vias = np.array([[0.0, 0, 5], [10, 0, 5], [20, 10, 8]])
    given_ways = np.full((3, 3), np.nan)
    given_ways[1] = (0.0, 1.0, 0.0)
    legs = RouteLegs.left_to_the_spline(vias, given_ways, CurveShape(np.zeros(2)))
    for each in (legs, legs.led_round(1, np.empty((0, 3)), 2.0)):
        laid = lay_route(each)
        joint = int(laid.joints[1])
        for way in (
            laid.spans[joint - 1, 3] - laid.spans[joint - 1, 2],
            laid.spans[joint, 1] - laid.spans[joint, 0],
        ):
            assert np.allclose(way / np.linalg.norm(way), given_ways[1], atol=1e-9)
