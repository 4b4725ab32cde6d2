"""Outlines beside the formulas of what they are; faults are tested in test_svg.py."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from viaspline.maps.svg_outline import flattened, hull_of, matrix_of, segments_of


@given(
    points=st.lists(st.floats(-50, 50), min_size=8, max_size=8),
    matrix=st.lists(st.floats(-3, 3), min_size=4, max_size=4),
)
def test_a_cubic_is_nowhere_farther_from_its_chords_than_is_asked_for(
    points: list[float], matrix: list[float]
) -> None:
    control = np.reshape(points, (4, 2))
    d = "M{} {}C{} {} {} {} {} {}".format(*points)
    placing = np.array([[matrix[0], matrix[1], 7.0], [matrix[2], matrix[3], -2.0], [0, 0, 1.0]])
    (ring,) = flattened(segments_of("path", {"d": d}), placing, 0.01)
    u = np.linspace(0, 1, 500)[:, None]
    curve = (1 - u) ** 3 * control[0] + 3 * u * (1 - u) ** 2 * control[1]
    curve = curve + 3 * u**2 * (1 - u) * control[2] + u**3 * control[3]
    placed = curve @ placing[:2, :2].T + placing[:2, 2]
    assert shapely.distance(shapely.LineString(ring), shapely.points(placed)).max() <= 0.0100001


@given(
    arc=st.tuples(
        st.floats(0.1, 9), st.floats(0.1, 9), st.floats(-180, 180), st.booleans(), st.booleans(),
        st.floats(-20, 20), st.floats(-20, 20),
    )
)  # fmt: skip
def test_an_arc_lies_in_its_hull_and_its_chords_are_as_near_as_is_asked_for(
    arc: tuple[float, float, float, bool, bool, float, float],
) -> None:
    rx, ry, turn, is_large, is_swept, x, y = arc
    d = f"M0 0A{rx} {ry} {turn} {is_large:d} {is_swept:d} {x} {y}"
    matrix = matrix_of("skewX(40) scale(2, -0.5) translate(3 4)")
    segments = segments_of("path", {"d": d})
    (fine,), (coarse,) = flattened(segments, matrix, 1e-5), flattened(segments, matrix, 0.02)
    away = shapely.distance(shapely.LineString(coarse), shapely.points(fine))
    assert away.max() <= 0.02001
    hull = hull_of(segments, matrix)
    assert (fine >= hull.min(axis=0) - 1e-9).all()
    assert (fine <= hull.max(axis=0) + 1e-9).all()


@pytest.mark.parametrize(
    ("transform", "image"),
    [
        ("rotate(90)", (-2, 1)), ("rotate(90 1 1)", (0, 1)), ("translate(3)", (4, 2)),
        ("scale(2)", (2, 4)), ("skewX(45)", (3, 2)), ("skewY(45),scale(2 1)", (2, 4)),
        ("matrix(1 2 3 4 5 6)", (12, 16)), ("translate(1. 2.)", (2, 4)), (" ", (1, 2)),
    ],
)  # fmt: skip
def test_a_transform_takes_a_point_where_svg_says(transform: str, image: tuple[int, int]) -> None:
    np.testing.assert_allclose(matrix_of(transform) @ (1, 2, 1), (*image, 1), atol=1e-12)
