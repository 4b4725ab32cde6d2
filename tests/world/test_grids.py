"""Maps in a world: beside other obstacles, shared, named, and what they take of memory."""

import gc
import math
import tracemalloc
import weakref
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.certificate import certify
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.world import World

Oracle = Callable[..., Any]
seeds = st.integers(0, 10_000)


def disc(x: float, y: float, radius: float) -> Obstacle:
    return Obstacle(circle={"center": (x, y), "radius": radius})


def random_obstacle(rng: np.random.Generator) -> Obstacle:
    x, y = rng.uniform(0, 60, 2).tolist()
    kind = rng.integers(3)
    if kind == 0:
        return disc(x, y, float(rng.uniform(0.1, 5)))
    if kind == 1:
        return Obstacle(polygon=[(x, y), (x + 7, y + 1), (x + 3, y + 2), (x + 1, y + 6)])
    blocked = rng.random(rng.integers(1, 12, 2)) < rng.choice([0.1, 0.5, 0.9])
    yaw = float(rng.choice([0.0, 0.7, -2.5]))
    return Obstacle(grid=Grid(blocked, float(rng.choice([0.3, 1.0, 2.0])), (x, y, yaw)))


@given(seeds, st.lists(st.integers(0, 5), min_size=1, max_size=6))
def test_grids_that_are_added_again_and_again_equal_a_world_built_anew(
    seed: int, portions: list[int]
) -> None:
    rng = np.random.default_rng(seed)
    obstacles = [random_obstacle(rng) for _ in range(sum(portions))]
    grown, done = World(bounds=(-20, -20, 90, 90)), 0
    for portion in portions:
        grown = grown.with_obstacles(obstacles[done : done + portion])
        done += portion
    anew = World(obstacles, bounds=(-20, -20, 90, 90))
    xy = rng.uniform(-20, 90, (100, 2))
    np.testing.assert_array_equal(grown.distance(xy), anew.distance(xy))
    assert grown.groups(2.0) == anew.groups(2.0)
    for i in range(len(obstacles)):
        np.testing.assert_array_equal(grown.distances_to(i, xy), anew.distances_to(i, xy))


@given(seeds)
def test_the_distance_among_obstacles_of_all_kinds_is_exact(
    shapely_distance: Oracle, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    obstacles = [random_obstacle(rng) for _ in range(int(rng.integers(1, 9)))]
    xy = rng.uniform(-10, 80, (80, 2))
    np.testing.assert_allclose(
        World(obstacles).distance(xy), shapely_distance(xy, obstacles), atol=1e-9
    )


def test_a_map_is_called_by_its_file_unless_it_has_a_name() -> None:
    cells = np.ones((1, 1), bool)
    world = World(
        [
            Obstacle(grid=Grid(cells, 1.0, source="maps/depot.yaml")),
            Obstacle(grid=Grid(cells, 1.0, source="maps/depot.yaml"), name="depot"),
            Obstacle(grid=Grid(cells, 1.0)),
        ]
    )
    assert world.names == ("map 'maps/depot.yaml'", "depot", "obstacle 3")


def test_a_map_without_a_blocked_square_is_infinitely_far_away() -> None:
    world = World([Obstacle(grid=Grid(np.zeros((3, 3), bool), 1.0))])
    distance, index = world.nearest([(1, 1), (9, 9)])
    assert np.isinf(distance).all()
    assert (index == -1).all()
    certificate = certify(CardinalSpline([(0, 0), (3, 3)]), world, 1.0)
    assert math.isinf(certificate.clearance)
    assert certificate.obstacle is None


def test_worlds_of_the_same_map_share_its_tables() -> None:
    rng = np.random.default_rng(0)
    cells = rng.random((20, 30)) < 0.2
    first = World([Obstacle(grid=Grid(cells, 0.5, source="a.yaml"))])
    second = World([disc(0, 0, 1), Obstacle(grid=Grid(cells, 0.5, source="b.yaml"))])
    seen = first.with_obstacles([disc(3, 3, 1)])
    for other in (second, seen, World().with_obstacles(first.obstacles)):
        assert np.shares_memory(first.packed.to_right, other.packed.to_right)
        assert np.shares_memory(first.packed.to_left, other.packed.to_left)


def test_a_map_that_nobody_holds_any_more_takes_no_memory() -> None:
    world = World([Obstacle(grid=Grid(np.eye(7, dtype=bool), 0.123))])
    tables = weakref.ref(world.packed.to_right)
    assert tables() is not None
    del world
    gc.collect()
    assert tables() is None


@pytest.mark.parametrize("others", [0, 3])
def test_a_world_takes_four_bytes_for_a_square_and_no_more_in_between(others: int) -> None:
    cells = np.zeros((600, 700), bool)
    cells[::50] = cells[:, ::70] = True
    map_of_it = Obstacle(grid=Grid(cells, 0.1))
    World([Obstacle(grid=Grid(np.eye(2, dtype=bool), 0.1)), disc(0, 0, 1)])  # all is compiled
    tracemalloc.start()
    try:
        world = World([map_of_it, *(disc(-5, k, 1) for k in range(others))])
        world = world.with_obstacles([disc(-9, 0, 1)])
        kept, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert len(world.packed.to_right) == cells.size
    assert kept <= 4.1 * cells.size
    assert peak <= 4.2 * cells.size
