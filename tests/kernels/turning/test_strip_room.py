"""The room beside a strip, beside what one disc leaves."""

from __future__ import annotations

import numpy as np
import pytest

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
