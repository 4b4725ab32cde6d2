from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.space.laying.leg_polygon import LegPolygon

seeds = st.integers(0, 10_000)


def random_leg(seed: int) -> LegPolygon:
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(0, 10, (int(rng.integers(2, 6)), 3)), axis=0)
    directions = rng.normal(size=(2, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    directions[rng.random(2) < 0.3] = np.nan
    return LegPolygon(points, directions, np.full(len(points), rng.uniform(0.1, 20)))


@given(seed=seeds)
def test_a_leg_runs_from_via_point_to_via_point_along_the_directions_that_are_given(
    seed: int,
) -> None:
    leg = random_leg(seed)
    spans, joints = leg.spans()
    assert np.array_equal(spans[0, 0], leg.points[0])
    assert np.array_equal(spans[-1, 3], leg.points[-1])
    assert np.all(np.diff(joints) > 0) or len(joints) < 2
    for end, way in ((0, spans[0, 1] - spans[0, 0]), (1, spans[-1, 3] - spans[-1, 2])):
        if not np.isnan(leg.directions[end]).any():
            assert np.allclose(way / np.linalg.norm(way), leg.directions[end], atol=1e-6)


@given(seed=seeds)
def test_the_tighter_its_corners_the_nearer_a_leg_comes_to_the_taut_way(seed: int) -> None:
    leg = random_leg(seed)
    leg = replace(leg, radii=1e-4 * leg.radii)
    places = PiecewiseCubic(leg.spans()[0])
    at = places.evaluate(np.linspace(*places.domain, 500))
    first, last = leg.points[:-1], leg.points[1:]
    along = np.clip(
        ((at[:, None] - first) * (last - first)).sum(-1) / ((last - first) ** 2).sum(-1), 0, 1
    )
    apart = np.linalg.norm(first + along[..., None] * (last - first) - at[:, None], axis=-1)
    longest = np.linalg.norm(last - first, axis=1).max()
    assert apart.min(axis=1).max() < 0.05 * longest


def test_a_corner_is_passed_on_its_outside_right_at_the_detour_via_point() -> None:
    corner = np.array([[0.0, 0, 5], [10, 0, 5], [10, 10, 5]])
    leg = LegPolygon(corner, np.full((2, 3), np.nan), np.full(3, 2.0))
    spans, joints = leg.spans()
    assert np.allclose(spans[int(joints[0]), 0], corner[1], atol=2e-3)
    places = PiecewiseCubic(spans).evaluate(np.linspace(0, len(spans), 1000))
    inside = (places[:, 0] < 10 - 2e-3) & (places[:, 1] > 2e-3)
    assert not inside.any()
