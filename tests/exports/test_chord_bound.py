"""The bound of the chord error against dense samples, and how tight it is."""

from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.exports.chord_bound import chord_bound, chord_bounds

numbers = st.floats(-10, 10).map(lambda x: round(x, 3))
places = st.tuples(numbers, numbers)
seeds = st.integers(0, 100_000)


@given(st.lists(places, min_size=4, max_size=4), places, places)
def test_no_point_of_the_curve_or_of_the_line_is_farther_than_the_bound(
    control: list[tuple[float, float]], start: tuple[float, float], end: tuple[float, float]
) -> None:
    curve = PiecewiseCubic([control])
    (bound,) = chord_bounds(curve, np.array([0.0, 1.0]), np.array([start, end]))
    sampled = shapely.LineString(curve.evaluate(np.linspace(0, 1, 2001)))
    line = shapely.LineString([start, end])
    assert shapely.hausdorff_distance(sampled, line, densify=0.01) <= bound + 1e-3


def test_on_a_shallow_arc_the_bound_is_within_a_few_percent_of_the_truth() -> None:
    angles = np.linspace(-0.2, 0.2, 5)
    curve = _arc(50.0, angles)
    height = 50.0 * (1.0 - np.cos(0.2))
    found = chord_bound(curve, 0.0, 4.0)
    assert height <= found + 1e-9 <= 1.03 * height


def test_a_line_that_is_a_point_is_as_far_as_the_farthest_place() -> None:
    line = PiecewiseCubic([[(0, 0), (1, 0), (2, 0), (3, 0)]])
    assert chord_bounds(line, np.array([0.0, 1.0]), np.zeros((2, 2))).tolist() == [3.0]


@given(st.lists(st.tuples(numbers, numbers, numbers), min_size=2, max_size=5, unique=True), seeds)
def test_parts_are_bounded_as_the_curves_that_they_are(
    points: list[tuple[float, float, float]], seed: int
) -> None:
    curve = CardinalSpline(points)
    rng = np.random.default_rng(seed)
    u = np.unique(rng.uniform(*curve.domain, 6))
    ends = np.asarray(curve.evaluate(u))
    moved = ends + rng.normal(0, 0.3, ends.shape)
    bounds = chord_bounds(curve, u, moved)
    for k, (a, b) in enumerate(pairwise(u.tolist())):
        part = curve.section(a, b)
        assert chord_bound(curve, a, b) == pytest.approx(
            chord_bound(part, *part.domain), rel=1e-9, abs=1e-9
        )
        (alone,) = chord_bounds(curve, u[k : k + 2], moved[k : k + 2])
        assert alone == bounds[k]
        at = part.evaluate(np.linspace(*part.domain, 400))
        way = moved[k + 1] - moved[k]
        share = np.clip((at - moved[k]) @ way / (way @ way), 0.0, 1.0)
        assert (
            np.linalg.norm(at - moved[k] - share[:, None] * way, axis=1).max() <= bounds[k] + 1e-9
        )


def _arc(radius: float, angles: np.ndarray) -> PiecewiseCubic:
    spans = []
    for a, b in pairwise(angles):
        k = 4.0 / 3.0 * np.tan((b - a) / 4.0)
        p, q = (np.array([np.cos(x), np.sin(x)]) for x in (a, b))
        spans.append([p, p + k * np.array([-p[1], p[0]]), q - k * np.array([-q[1], q[0]]), q])
    return PiecewiseCubic(radius * np.array(spans))
