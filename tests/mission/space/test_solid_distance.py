"""Distances of upright cylinders, by looking at every cube, patch or sample there is."""

import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.maps.grid import Grid
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import GridPrism, Prism, RoundedSegment
from viaspline.mission.space.solid_distance import ground_distance, solid_distance
from viaspline.mission.space.upright_body import UprightBody

REACH = 5.0


def body(rng: np.random.Generator) -> UprightBody:
    x, y, z = rng.uniform(-6, 6, 3).tolist()
    return UprightBody(x, y, z, z + rng.uniform(0, 4), rng.choice([0.0, rng.uniform(0.1, 2)]))


def to_place(body: UprightBody, x: float, y: float, z: float) -> float:
    """The distance of a place from a body, 0 inside."""
    across = max(math.hypot(x - body.x, y - body.y) - body.radius, 0.0)
    return math.hypot(across, max(body.low - z, z - body.high, 0.0))


def to_box(body: UprightBody, low: np.ndarray, high: np.ndarray) -> float:
    """The distance of an upright box from a body, 0 where they meet."""
    x, y = np.clip((body.x, body.y), low[:2], high[:2])
    return to_place(body, x, y, min(max(body.low, low[2]), high[2]))


@settings(deadline=None)
@given(seed=st.integers(0, 10_000))
def test_a_line_is_as_far_as_the_nearest_of_its_places(seed: int) -> None:
    rng = np.random.default_rng(seed)
    there, radius = body(rng), rng.uniform(0.1, 1)
    first, last = rng.uniform(-6, 6, (2, 3))
    if seed % 5 == 0:
        last[:2] = first[:2]  # a mast
    places = first + np.linspace(0, 1, 4001)[:, None] * (last - first)
    oracle = min(to_place(there, *place) for place in places.tolist()) - radius
    found = solid_distance(
        there, RoundedSegment(tuple(first.tolist()), tuple(last.tolist()), radius), REACH
    )
    assert oracle - 0.003 <= found <= oracle + 1e-9


@settings(deadline=None)
@given(seed=st.integers(0, 10_000))
def test_a_prism_is_as_far_as_its_outline_and_its_heights(seed: int) -> None:
    rng = np.random.default_rng(seed)
    there, radius = body(rng), float(rng.choice([0.0, 0.7]))
    hull = shapely.MultiPoint(rng.uniform(-6, 6, (5, 2))).convex_hull
    low, high = np.sort(rng.uniform(-6, 6, 2)).tolist()
    solid = Prism(RoundedRing((tuple(hull.exterior.coords[:-1]),), radius), low, high)
    found = solid_distance(there, solid, REACH)
    middle = shapely.Point(there.x, there.y)
    across = max(hull.distance(middle) - radius - there.radius, 0.0)
    upright = max(low - there.high, there.low - high, 0.0)
    assert max(found, 0.0) == pytest.approx(math.hypot(across, upright), abs=1e-9)
    assert (found < 0) == (across == 0 and upright == 0)


@settings(deadline=None)
@given(seed=st.integers(0, 10_000))
def test_voxels_are_as_far_as_the_nearest_blocked_cube(seed: int) -> None:
    rng = np.random.default_rng(seed)
    there, cell = body(rng), rng.uniform(0.3, 2)
    cubes = rng.random(rng.integers(1, 6, 3)) < 0.3
    origin = rng.uniform(-6, 3, 3)
    voxels = Voxels(cubes, cell, tuple(origin.tolist()))
    lows = [origin + np.array(cube) * cell for cube in np.argwhere(cubes)]
    oracle = min((to_box(there, low, low + cell) for low in lows), default=math.inf)
    found = solid_distance(there, voxels, REACH)
    if oracle > REACH:
        assert found == math.inf
    else:
        assert max(found, 0.0) == pytest.approx(oracle, abs=1e-9)


@settings(deadline=None, max_examples=40)
@given(seed=st.integers(0, 10_000), blocked=st.booleans())
def test_ground_is_as_far_as_the_nearest_of_its_columns(seed: int, blocked: bool) -> None:
    rng = np.random.default_rng(seed)
    there, cell = body(rng), rng.uniform(0.5, 3)
    heights = rng.normal(0, 2, rng.integers(2, 6, 2))
    heights[rng.random(heights.shape) < 0.1] = np.nan
    x, y = rng.uniform(-8, 2, 2)
    found = ground_distance(
        there, Terrain(heights, cell, (float(x), float(y))), blocked=blocked, reach=REACH
    )
    oracle = math.inf
    for i, j in itertools.product(range(-30, 36), repeat=2):
        inside = 0 <= i < heights.shape[1] - 1 and 0 <= j < heights.shape[0] - 1
        corners = heights[j : j + 2, i : i + 2] if inside else np.array([np.nan])
        top = corners.max() if not np.isnan(corners).any() else math.inf if blocked else -math.inf
        if top > -math.inf:
            low = np.array([x + i * cell, y + j * cell, -1e9])
            oracle = min(oracle, to_box(there, low, np.array([*(low[:2] + cell), top])))
    assert max(found, 0.0) == pytest.approx(oracle if oracle <= REACH else math.inf, abs=1e-9)


def test_squares_of_a_map_reach_between_their_heights() -> None:
    solid = GridPrism(Grid([[False, True]], 2.0), 0.0, 5.0)
    assert solid_distance(UprightBody(0.5, 1, 1, 2, 0.5), solid, REACH) == pytest.approx(1.0)
    assert solid_distance(UprightBody(3, 1, 8, 9, 0.5), solid, REACH) == pytest.approx(3.0)
    assert solid_distance(UprightBody(3, 1, 1, 9, 0.5), solid, REACH) < 0
