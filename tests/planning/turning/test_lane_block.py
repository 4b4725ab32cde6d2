"""How wide what stands in a lane is, against shapely's unions of the blocked squares."""

from __future__ import annotations

import math

import numpy as np
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from shapely.affinity import rotate, translate

import viaspline as vs
from viaspline.maps.grid import Grid
from viaspline.planning.turning.lane import Lane
from viaspline.planning.turning.lane_block import SQUARES, width_in
from viaspline.world.world import World


def lane_along(heading: float) -> Lane:
    """A lane of 40 m through the middle of things."""
    along = np.array((math.cos(heading), math.sin(heading)))
    return Lane(-20.0 * along, along, 40.0)


def extent(shape: shapely.Geometry, lane: Lane) -> float:
    """Of a shape along a lane or across it [m]."""
    seen = lane.seen(shapely.get_coordinates(shape))
    return float(np.ptp(seen, axis=0).max())


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000), st.floats(-3, 3), st.floats(-3, 3))
def test_on_a_map_it_is_that_of_the_squares_that_stand_together(
    seed: int, yaw: float, heading: float
) -> None:
    rng = np.random.default_rng(seed)
    blocked = rng.random((16, 16)) < 0.3
    blocked[[0, -1]] = blocked[:, [0, -1]] = False
    assume(blocked.any())
    grid = Grid(blocked, 0.5, (-3.0, -3.0, yaw))
    squares = [
        translate(rotate(shapely.box(0, 0, 0.5, 0.5), yaw, (0, 0), use_radians=True),
                  *grid.to_world([(column, row)])[0])
        for row, column in np.argwhere(blocked)
    ]  # fmt: skip
    islands = shapely.get_parts(shapely.union_all([each.buffer(1e-6) for each in squares]))
    place = np.array(grid.center(*np.argwhere(blocked)[0]))
    mine = next(each for each in islands if each.contains(shapely.Point(place)))
    lane, world = lane_along(heading), World([vs.Obstacle(grid=grid)])
    assert math.isclose(width_in(world, lane, place, 0, 12.0), extent(mine, lane), abs_tol=1e-4)


def test_a_wall_that_goes_on_beyond_what_is_looked_at_is_as_wide_as_anything() -> None:
    blocked = np.zeros((400, 400), bool)
    blocked[200, 100:300] = True
    world = World([vs.Obstacle(grid=Grid(blocked, 0.1, (-20.0, -20.0, 0.0)))])
    place = np.array((0.0, 0.05))
    assert width_in(world, lane_along(math.pi / 2), place, 0, 8.0) == math.inf
    assert math.isclose(
        width_in(world, lane_along(math.pi / 2), place, 0, 15.0), 20.0, rel_tol=0.05
    )


def test_on_a_fine_map_it_is_told_in_blocks_of_cells() -> None:
    blocked = np.zeros((2000, 2000), bool)
    blocked[980:1021, 900:1101] = True
    world = World([vs.Obstacle(grid=Grid(blocked, 0.01, (-10.0, -10.0, 0.0)))])
    width = width_in(world, lane_along(0.0), np.zeros(2), 0, 8.0)
    assert 2.01 <= width <= 2.01 + 2 * 0.01 * math.ceil(800 / SQUARES)


def test_of_a_shape_it_is_its_own_and_of_bounds_none() -> None:
    disc = vs.Obstacle(circle={"center": (1.0, 2.0), "radius": 3.0})
    box = vs.Obstacle(polygon=[(0, 0), (4, 0), (4, 1), (0, 1)])
    world = World([disc, box], bounds=(-50, -50, 50, 50))
    lane = lane_along(0.0)
    assert [width_in(world, lane, np.zeros(2), k, 10.0) for k in (0, 1, -2)] == [6.0, 4.0, 0.0]
