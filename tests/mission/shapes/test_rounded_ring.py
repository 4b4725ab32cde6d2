"""Rounded rings beside what shapely grows."""

from __future__ import annotations

from typing import Any

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.mission.shapes.rounded_ring import RoundedRing

numbers = st.integers(-400, 400).map(lambda k: k / 4)
places = st.tuples(numbers, numbers)
radii = st.floats(0.01, 50)
CORE = st.one_of(
    st.lists(places, min_size=1, max_size=1),
    st.lists(places, min_size=2, max_size=2, unique=True),
    st.lists(places, min_size=3, max_size=7, unique=True).filter(
        lambda ring: shapely.Polygon(ring).is_valid
    ),
)


@settings(deadline=None)
@given(core=CORE, radius=radii, segments=st.integers(1, 16))
def test_a_polygon_around_a_rounded_ring_leaves_nothing_of_it_out_and_reaches_no_farther_than_said(
    core: Any, radius: float, segments: int
) -> None:
    ring = RoundedRing([core], radius)
    corners, beyond = ring.polygon_around(segments)
    polygon = shapely.Polygon(corners)
    assert polygon.is_valid
    assert polygon.buffer(1e-9 * radius).covers(ring.core().buffer(radius, quad_segs=400))
    assert shapely.distance(ring.core(), shapely.points(corners)).max() <= radius + beyond + 1e-9


def test_a_polygon_around_a_polygon_is_the_polygon() -> None:
    triangle = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)]
    assert RoundedRing([triangle]).polygon_around() == (triangle, 0.0)


@pytest.mark.parametrize("core", [[(1, 2)], [(1, 2), (5, 2)], [(1, 2), (5, 2), (5, 9)]])
def test_its_box_and_the_disc_around_it_hold_all_of_it(core: Any) -> None:
    ring = RoundedRing([core], 1.5)
    area = ring.outline(200)
    assert ring.box == pytest.approx(area.bounds, abs=1e-3)
    x, y, radius = ring.disc_around()
    assert shapely.Point(x, y).buffer(radius + 1e-4, quad_segs=400).covers(area)
