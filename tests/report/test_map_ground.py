from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.report.map_ground import (
    BLOCKED,
    FREE,
    UNKNOWN,
    codes_in,
    dots_of,
    nearest_point,
    too_near,
)
from viaspline.report.sheet import new_sheet
from viaspline.world.world import World

VIEW = (-6.0, -5.0, 10.0, 11.0)
PLACES = [(1.03, 2.04, 0.0), (1.0, 2.0, 0.4), (5.0, 1.0, 2.0), (1.03, 2.04, math.pi / 2)]

cells = arrays(bool, st.tuples(st.integers(1, 12), st.integers(1, 12)))


@settings(deadline=None, max_examples=30)
@given(blocked=cells, place=st.sampled_from(PLACES))
def test_a_dot_shows_the_square_that_it_lies_in(blocked: Any, place: Any) -> None:
    unknown = blocked & (np.indices(blocked.shape).sum(axis=0) % 2 == 0)
    grid = Grid(blocked, 0.5, place, unknown=unknown)
    codes = codes_in(grid, VIEW, (80, 80))
    for i, j in np.random.default_rng(0).integers(0, 80, (60, 2)):
        at = VIEW[0] + (j + 0.5) / 5, VIEW[1] + (i + 0.5) / 5
        column, row = np.floor(grid.to_cells([at])[0]).astype(int)
        expected = FREE
        if 0 <= column < grid.width and 0 <= row < grid.height and blocked[row, column]:
            expected = UNKNOWN if unknown[row, column] else BLOCKED
        assert codes[i, j] == expected


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("aside", [7, 40, 83])
def test_no_blocked_square_is_too_small_to_be_seen(place: Any, aside: int) -> None:
    blocked = np.random.default_rng(1).random((60, 60)) < 0.01
    grid = Grid(blocked, 0.1, place)
    codes = codes_in(grid, VIEW, (aside, aside))
    dot = (VIEW[2] - VIEW[0]) / aside
    shown = (np.argwhere(codes == BLOCKED)[:, ::-1] + 0.5) * dot + VIEW[:2]
    for row, column in np.argwhere(blocked):
        away = np.hypot(*(shown - grid.center(row, column)).T)
        assert away.min() < 2 * dot


@settings(deadline=None, max_examples=20)
@given(blocked=cells, place=st.sampled_from(PLACES), distance=st.floats(0.2, 3))
def test_the_ground_too_near_is_that_of_the_worlds_distance(
    blocked: Any, place: Any, distance: float
) -> None:
    grid = Grid(blocked, 0.5, place)
    area = too_near(grid, VIEW, (320, 320), distance)
    points = np.random.default_rng(2).uniform(VIEW[:2], VIEW[2:], (300, 2))
    true = World([Obstacle(grid=grid)]).distance(points) if blocked.any() else np.full(300, np.inf)
    drawn = shapely.contains_xy(area, points)
    assert drawn[true < distance - 0.1].all()
    holes = shapely.contains_xy(shapely.convex_hull(area), points)
    assert not drawn[(true > distance + 0.1) & ~holes].any()


@settings(deadline=None, max_examples=30)
@given(blocked=cells, place=st.sampled_from(PLACES), at=st.tuples(*[st.floats(-300, 300)] * 2))
def test_the_nearest_point_is_as_far_as_the_world_says(
    blocked: Any, place: Any, at: tuple[float, float]
) -> None:
    grid = Grid(blocked, 0.5, place)
    nearest = nearest_point(grid, at)
    if not blocked.any():
        assert nearest is None
        return
    assert nearest is not None
    distance = float(World([Obstacle(grid=grid)]).distance(at))
    assert math.dist(nearest, at) == pytest.approx(max(distance, 0.0), abs=1e-9)


def test_a_map_of_a_hundred_million_squares_is_drawn_as_fine_as_can_be_seen() -> None:
    blocked, unknown = np.zeros((2, 10_000, 10_000), bool)
    blocked[::1000] = True
    unknown[:, 4000:6000] = True
    grid = Grid(blocked | unknown, 0.01, (3.0, -2.0, 0.1), unknown=unknown)
    sheet = new_sheet(grid.extent, (), "", ())
    dots = dots_of(sheet.map)
    codes = codes_in(grid, grid.extent, dots)
    assert codes.size <= 4 * np.prod(dots)  # what can't be seen isn't drawn
    assert set(np.unique(codes)) == {FREE, UNKNOWN, BLOCKED}
