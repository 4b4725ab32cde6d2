"""The strip of a corridor, beside shapely's offsets."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from viaspline.mission.strip import Strip, around, rings_of


def ring_rows(radius: float, right: float, left: float, count: int = 90) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    widths = np.full(count, right), np.full(count, left)
    return np.column_stack((radius * np.cos(angle), radius * np.sin(angle), *widths))


def test_a_closed_strip_is_a_ring_with_an_island() -> None:
    area = Strip.of_rows(ring_rows(20, 3, 2), closed=True).area
    outer, island = rings_of(area)
    # driven anticlockwise, the right is outside
    np.testing.assert_allclose(np.hypot(*np.array(outer).T), 23, atol=1e-9)
    np.testing.assert_allclose(np.hypot(*np.array(island).T), 18, atol=1e-9)


def test_an_open_strip_goes_on_beyond_its_ends() -> None:
    area = Strip.of_rows([[0, 0, 1, 3], [10, 0, 1, 3]], closed=False).area
    assert area.bounds == (-3.0, -1.0, 13.0, 3.0)


def test_a_figure_of_eight_covers_what_either_lane_covers() -> None:
    t = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    rows = np.column_stack((40 * np.sin(t), 20 * np.sin(2 * t), np.full((120, 2), 3.0)))
    strip = Strip.of_rows(rows, closed=True)
    assert strip.area.is_valid
    assert len(rings_of(strip.area)) == 3
    lanes = shapely.LinearRing(rows[:, :2]).buffer(3.0)
    assert strip.area.symmetric_difference(lanes).area < 0.02 * lanes.area


def test_edges_that_run_against_their_line_are_named() -> None:
    rows = ring_rows(4, 1, 6)
    assert {side for _, side in Strip.of_rows(rows, closed=True).folds} == {"left"}
    assert not Strip.of_rows(ring_rows(4, 6, 3), closed=True).folds


def test_finer_rows_are_the_same_strip() -> None:
    strip = Strip.of_rows(ring_rows(20, 3, 2, 12), closed=True)
    fine = strip.finer(0.5)
    assert np.diff(fine.along).max() <= 0.5 + 1e-9
    assert fine.area.symmetric_difference(strip.area).area < 1e-9
    straight = Strip.of_rows([[0, 0, 1, 1], [1, 0, 2, 1], [7, 0, 2, 3]], closed=False)
    assert straight.finer(1.0).area.symmetric_difference(straight.area).area < 1e-9


@given(
    st.lists(
        st.tuples(st.integers(-20, 20), st.integers(-20, 20)), min_size=2, max_size=6, unique=True
    ),
    st.floats(0.2, 4.0),
)
def test_equal_widths_are_shapelys_buffer(points: list[tuple[int, int]], width: float) -> None:
    area = around(np.array(points) * 10, width, width, closed=False)
    line = shapely.LineString(np.array(points) * 10)
    ends = [
        shapely.Point(10 * np.array(p)).buffer(1.5 * width, cap_style="square")
        for p in points[:: len(points) - 1]
    ]
    beyond = area.difference(line.buffer(width * 1.002, quad_segs=64))
    assert beyond.difference(shapely.union_all(ends)).area < 1e-9
    assert shapely.covers(area.buffer(1e-9), line.buffer(width * 0.998, quad_segs=16))


@pytest.mark.parametrize(("right", "left"), [(1.0, 3.0), (3.0, 1.0)])
def test_unequal_widths_lie_on_their_own_side(right: float, left: float) -> None:
    corner = [(0, 0), (20, 0), (20, 20)]
    area = around(corner, right, left, closed=False)
    for x, y, inside in (
        (10, left - 0.01, True), (10, left + 0.01, False),
        (10, -right + 0.01, True), (10, -right - 0.01, False),
        (20 - left + 0.01, 10, True), (20 + right + 0.01, 10, False),
        (20 + 0.7 * right, -0.7 * right, True), (20 + right, -right, False),
    ):  # fmt: skip
        assert area.contains(shapely.Point(x, y)) == inside


@given(
    st.lists(
        st.tuples(st.floats(0, 20), st.floats(0, 20)).map(lambda at: tuple(np.round(at, 2))),
        min_size=3, max_size=6, unique=True,
    ),
    st.floats(0.5, 4.0),
    st.floats(0.5, 4.0),
    st.booleans(),
)  # fmt: skip
def test_no_crack_leads_to_a_place_of_the_line(
    places: list[tuple[float, float]], right: float, left: float, closed: bool
) -> None:
    points = np.array(places)
    area = around(points, right, left, closed=closed)
    edges = [area.exterior, *area.interiors]
    assert min(edge.distance(shapely.Point(at)) for edge in edges for at in points) > 0.4
    ring = np.vstack((points, points[:1])) if closed else points
    assert area.contains(shapely.LineString(ring))
