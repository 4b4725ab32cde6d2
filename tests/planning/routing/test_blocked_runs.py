"""Where a line is blocked, with shapely as the oracle."""

from __future__ import annotations

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.routing.blocked_runs import FINEST, blocked_runs


@settings(max_examples=60)
@given(st.integers(0, 10_000))
def test_all_that_is_too_close_is_found_and_little_more(seed: int) -> None:
    rng = np.random.default_rng(seed)
    discs = [(*rng.uniform(0, 100, 2), rng.uniform(0.2, 12)) for _ in range(int(rng.integers(6)))]
    world = vs.World([vs.Obstacle(circle={"center": (x, y), "radius": r}) for x, y, r in discs])
    start, goal = rng.uniform(0, 100, (2, 2))
    required = float(rng.uniform(0.1, 3))
    found = blocked_runs(world, start, goal, required)
    line = shapely.LineString((start, goal))
    places = np.linspace(0.0, line.length, 4000)
    points = line.interpolate(places)
    room = np.full(len(places), np.inf)
    for x, y, radius in discs:
        room = np.minimum(room, shapely.distance(points, shapely.Point(x, y)) - radius)
    within = ((places[:, None] >= found[:, 0]) & (places[:, None] <= found[:, 1])).any(axis=1)
    assert within[room < required - 1e-9].all()
    assert (room[within] <= required * (1.0 + FINEST) + 1e-9).all()
    assert (found[:, 1] > found[:, 0]).all()
    assert (found[1:, 0] > found[:-1, 1]).all()


def test_nothing_is_blocked_in_an_empty_world_or_on_no_line() -> None:
    ends = np.array(((3.0, 4.0), (50.0, 4.0)))
    assert blocked_runs(vs.World([]), *ends, 1.0).shape == (0, 2)
    assert blocked_runs(vs.World([]), ends[0], ends[0], 1.0).shape == (0, 2)
