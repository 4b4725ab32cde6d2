import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.kernels.space.ground_pyramid import ground_heights
from viaspline.maps.terrain import Terrain
from viaspline.world.space.spatial_world import SpatialWorld

seeds = st.integers(0, 100_000)


def random_terrain(rng: np.random.Generator) -> Terrain:
    nodes = rng.uniform(-9, 30, tuple(rng.integers(2, 40, 2).tolist()))
    nodes[rng.random(nodes.shape) < rng.choice([0.0, 0.03])] = np.nan
    return Terrain(nodes, float(rng.choice([0.5, 7.0])), (3.0, -2.0))


@given(seeds)
def test_the_ground_is_as_high_as_the_terrain_says(seed: int) -> None:
    rng = np.random.default_rng(seed)
    terrain = random_terrain(rng)
    x0, y0, x1, y1 = terrain.extent
    places = rng.uniform((x0 - 1, y0 - 1), (x1 + 1, y1 + 1), (50, 2))
    found = ground_heights(SpatialWorld.of(ground=terrain).packed, places)
    np.testing.assert_allclose(found, terrain.height_at(places), atol=1e-9)


@given(seeds)
def test_cells_of_every_level_bound_all_of_their_nodes(seed: int) -> None:
    rng = np.random.default_rng(seed)
    terrain = random_terrain(rng)
    packed = SpatialWorld.of(ground=terrain).packed
    for level, (columns, rows, first) in enumerate(packed.ground_levels.tolist()):
        size = 4 ** (level + 1)
        for j in range(rows):
            for i in range(columns):
                cell = first + i + columns * j
                nodes = terrain.heights[
                    j * size : (j + 1) * size + 1, i * size : (i + 1) * size + 1
                ]
                y, x = np.indices(nodes.shape) * terrain.cell
                base, along, across, below, above = packed.ground_planes[cell]
                off = nodes - base - along * x - across * y
                if np.isnan(nodes).all():
                    assert below > above
                else:
                    assert np.nanmin(off) == pytest.approx(below, abs=1e-9)
                    assert np.nanmax(off) == pytest.approx(above, abs=1e-9)
                top = math.inf if np.isnan(nodes).any() else nodes.max()
                assert packed.ground_tops[cell] == top


def test_a_slope_is_its_own_plane() -> None:
    slope = Terrain(np.arange(20.0) * np.ones((9, 1)), 2.0)
    packed = SpatialWorld.of(ground=slope).packed
    np.testing.assert_allclose(packed.ground_planes[:, 1:], [[0.5, 0, 0, 0]] * 13, atol=1e-12)


def test_unknown_ground_that_is_free_is_nowhere_high() -> None:
    nodes = np.zeros((6, 6))
    nodes[2, 2] = np.nan
    packed = SpatialWorld.of(ground=Terrain(nodes, 1.0), nodata="free").packed
    assert (packed.ground_tops == 0.0).all()
