"""Gaps that are told of are gaps: nothing that is as wide as the robot goes through."""

import math
import os
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.kernels.routing.narrow_gaps import narrow_places
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.world import World

Floats = NDArray[np.float64]
seeds = st.integers(0, 2**32)


def disc(x: float, y: float, radius: float) -> Obstacle:
    return Obstacle(circle={"center": (float(x), float(y)), "radius": float(radius)})


def wall(y: float, tilt: float = 0.0) -> Obstacle:
    """A wall of 1 m from (-10, y) to (10, y + tilt) and on upwards, or downwards."""
    up = math.copysign(1.0, y)
    return Obstacle(polygon=[(-10, y), (10, y + tilt), (10, y + tilt + up), (-10, y + up)])


def size(gap: Floats) -> float:
    return float(np.hypot(gap[2] - gap[0], gap[3] - gap[1]))


def check(world: World, gaps: Floats, rho: float) -> None:
    """Every gap is shorter than 2 rho, its ends touch, and nothing on it keeps rho."""
    w = np.linspace(0, 1, 301)[:, None]
    for gap in gaps:
        assert size(gap) < 2 * rho
        on_it = world.distance(gap[:2] + w * (gap[2:] - gap[:2]))
        assert on_it.max() < rho
        assert np.abs(on_it[[0, -1]]).max() <= 2 * rho - size(gap)


@pytest.mark.parametrize("width", [0.3, 1.0, 1.98])
def test_between_walls_gaps_are_as_wide_as_that(width: float) -> None:
    world = World([wall(0.5 * width), wall(-0.5 * width)])
    guide = np.array([(-20.0, 0.1), (20.0, -0.1)])
    gaps = narrow_places(world.packed, guide, 1.0)
    check(world, gaps, 1.0)
    assert len(gaps) > 3
    assert np.median([*map(size, gaps)]) == pytest.approx(width, abs=0.01)


@pytest.mark.long_without_jit
@pytest.mark.parametrize("width", [2.0, 2.0001, 2.5, 30.0])
def test_where_there_is_room_no_gap_is_told_of(width: float) -> None:
    world = World([wall(0.5 * width), wall(-0.5 * width)])
    guide = np.array([(-20.0, 0.9), (20.0, -0.9)])
    assert len(narrow_places(world.packed, guide, 1.0)) == 0


def test_a_guide_beside_a_lone_wall_goes_through_no_gap() -> None:
    world = World([wall(0.5)])
    guide = np.array([(-20.0, 0.0), (20.0, 0.0)])
    assert len(narrow_places(world.packed, guide, 1.0)) == 0


@given(seeds, st.floats(0.2, 3.0))
def test_gaps_among_anything_are_too_narrow(seed: int, rho: float) -> None:
    rng = np.random.default_rng(seed)
    made = [disc(x, y, rng.uniform(0.1, 4)) for x, y in rng.uniform(0, 20, (6, 2))]
    blocked = rng.random((6, 6)) < 0.3
    made.append(Obstacle(grid=Grid(blocked, 1.5, (5.0, 5.0, float(rng.uniform(-1, 1))))))
    world = World(made, bounds=(0, 0, 20, 20))
    guide = rng.uniform(0, 20, (4, 2))
    check(world, narrow_places(world.packed, guide, rho), rho)


def test_a_guide_of_one_place_goes_nowhere() -> None:
    world: Any = World([disc(0, 0, 1)])
    assert narrow_places(world.packed, np.array([(1.5, 0.0), (1.5, 0.0)]), 1.0).shape == (0, 4)


@pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT") == "1", reason="nothing is quick with the JIT off"
)
@pytest.mark.parametrize("rho", [-5e-7, 0.0, 1e-4])
def test_walls_that_are_all_but_touched_are_followed_without_crawling(rho):
    touched = World([Obstacle(polygon=[(0, -1), (100, -1), (100, 0), (0, 0)])])
    guide = np.array([[0.0, 5e-5], [100.0, 5e-5]])
    assert len(narrow_places(touched.packed, guide, rho)) == 0  # it would crawl for hours


@pytest.mark.parametrize("off", [0.0, 9e-6, -9e-6])
def test_a_gap_that_is_hardly_too_narrow_is_found_by_a_guide_along_its_posts(off):
    """Of BARN's world 175: between two posts just as far apart as the body is wide."""
    posts = World([disc(0.0, 0.375, 0.075), disc(0.0, -0.375, 0.075)])
    guide = np.array([[-2.03, off], [2.0, off]])
    found = narrow_places(posts.packed, guide, 0.3001)
    assert len(found) > 0
    assert np.hypot(*(found[:, :2] - found[:, 2:]).T) == pytest.approx(0.6, abs=3e-4)
    assert len(narrow_places(posts.packed, guide, 0.2999)) == 0
