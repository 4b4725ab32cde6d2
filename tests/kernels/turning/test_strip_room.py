"""The room beside a strip, beside what one disc leaves."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import viaspline as vs
from viaspline.kernels.turning.strip_room import strip_room
from viaspline.kernels.turning.strip_spans import strip_spans


@pytest.mark.parametrize("aside", [0.0, 0.3])
@pytest.mark.parametrize("off", [-2.5, -2.2, 2.2, 3.0])
def test_a_place_may_go_as_far_as_it_keeps_clear(off: float, aside: float) -> None:
    """The disc stands beside the middle between two places: both have its room to keep."""
    world = vs.World([vs.Obstacle(circle={"center": (5.0, off), "radius": 1.0})])
    places = np.array([[0.0, 0.0], [4.0, 0.0], [6.0, 0.0], [10.0, 0.0]])
    normals = np.tile([0.0, 1.0], (4, 1))
    low, high = np.full(4, -np.inf), np.full(4, np.inf)
    reach, rooms = np.empty(4), np.empty(4)
    spans = strip_spans(places, normals, np.full((2, 2), np.nan), False)
    beside, kept = np.full(4, aside), np.ones(4)
    strip_room(world.packed, places, normals, spans, beside, kept, low, high, reach, rooms)
    room = abs(off - aside) - 2.0
    assert rooms[1:3] == pytest.approx(room)
    assert (reach > 0.0).all()
    if off < 0.0:
        assert low[1:3] == pytest.approx(-room, rel=1e-3)
        assert np.isinf(high).all()
    else:
        assert high[1:3] == pytest.approx(room, rel=1e-3)
        assert np.isinf(low).all()


@pytest.mark.parametrize(("left", "right"), [(2.05, -2.2), (2.3, -2.1)])
def test_in_a_gap_it_is_told_how_far_a_place_may_go_on_both_sides(
    left: float, right: float
) -> None:
    rocks = [vs.Obstacle(circle={"center": (5.0, at), "radius": 1.0}) for at in (left, right)]
    places = np.array([[0.0, 0.0], [5.0, 0.0], [10.0, 0.0]])
    normals = np.tile([0.0, 1.0], (3, 1))
    low, high = np.full(3, -np.inf), np.full(3, np.inf)
    spans = strip_spans(places, normals, np.full((2, 2), np.nan), False)
    rest = np.empty(3), np.empty(3)
    world = vs.World(rocks).packed
    strip_room(world, places, normals, spans, np.zeros(3), np.ones(3), low, high, *rest)
    assert high[1] == pytest.approx(left - 2.0, abs=1e-3)
    assert low[1] == pytest.approx(right + 2.0, abs=1e-3)


@given(
    st.lists(st.tuples(st.floats(-40, 50), st.floats(-40, 40)), max_size=3), st.floats(18.0, 60.0)
)
def test_where_nothing_is_near_it_is_told_what_looking_at_every_place_tells(
    middles: list[tuple[float, float]], out: float
) -> None:
    """With a fence every place is looked at; it stands farther off than any looks."""
    rocks = [vs.Obstacle(circle={"center": at, "radius": 1.0}) for at in middles]
    bounds = (-out, -out, 10.0 + out, out)
    far = [(-500.0, -500.0), (500.0, -500.0), (500.0, 500.0), (-500.0, 500.0)]
    places = np.array([[0.0, 0.0], [4.0, 0.5], [6.0, 0.5], [10.0, 0.0]])
    normals = np.tile([0.0, 1.0], (4, 1))
    spans = strip_spans(places, normals, np.full((2, 2), np.nan), False)
    found = []
    for fences in ([], [far]):
        world = vs.World(rocks, bounds=bounds, fences=fences)
        told = [np.full(4, -np.inf), np.full(4, np.inf), np.empty(4), np.empty(4)]
        strip_room(world.packed, places, normals, spans, np.zeros(4), np.ones(4), *told)
        found.append(np.array(told))
    np.testing.assert_array_equal(*found)
