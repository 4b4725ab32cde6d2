import copy

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import RegularGridInterpolator

from viaspline.errors import GeometryError
from viaspline.maps.terrain import Terrain


@given(seed=st.integers(0, 999), u=st.floats(-0.2, 1.2), v=st.floats(-0.2, 1.2))
def test_the_ground_between_nodes_is_bilinear(seed: int, u: float, v: float) -> None:
    rng = np.random.default_rng(seed)
    nx, ny = rng.integers(2, 6, 2).tolist()
    heights, cell = rng.normal(0, 10, (ny, nx)), 2.5
    terrain = Terrain(heights, cell, (3.0, -4.0))
    x = 3.0 + u * (nx - 1) * cell
    y = -4.0 + v * (ny - 1) * cell
    axes = (-4.0 + cell * np.arange(ny), 3.0 + cell * np.arange(nx))
    oracle = RegularGridInterpolator(axes, heights, bounds_error=False, fill_value=np.nan)
    assert np.allclose(terrain.height_at((x, y)), oracle((y, x)), atol=1e-9, equal_nan=True)


def test_nothing_is_known_of_a_patch_with_a_hole_in_it() -> None:
    terrain = Terrain([[0, 0, 0], [0, 0, np.nan]], 1.0)
    assert terrain.height_at((0.5, 0.5)) == 0.0
    assert np.isnan(terrain.height_at((1.5, 0.1)))
    assert (terrain.lowest, terrain.highest) == (0.0, 0.0)


def test_nothing_is_known_of_heights_that_are_masked() -> None:
    heights = np.ma.masked_equal(np.array([[0, 1, -9999], [2, 3, 4]], np.int16), -9999)
    terrain = Terrain(heights, 1.0)
    assert terrain == Terrain([[0, 1, np.nan], [2, 3, 4]], 1.0)
    assert terrain.lowest == 0.0


def test_terrains_are_equal_when_the_ground_is() -> None:
    one = Terrain([[0, 1], [2, 3]], 1.0, source="dem.asc")
    assert one == copy.deepcopy(one) == Terrain(np.array([[0, 1], [2, 3]], np.float32), 1.0)
    assert hash(one) == hash(Terrain([[0, 1], [2, 3]], 1.0))
    assert one != Terrain([[0, 1], [2, 3]], 2.0)
    assert repr(one) == "Terrain(2 x 2 nodes, 1 m apart, 0 to 3 m high)"


@pytest.mark.parametrize(
    ("heights", "cell", "origin", "words"),
    [
        ([[1.0]], 1.0, (0, 0), "nodes aside"),
        ([1.0, 2.0], 1.0, (0, 0), "shape"),
        ([[1, np.inf], [1, 1]], 1.0, (0, 0), "finite"),
        ([[1, 1], [1, 1]], -1.0, (0, 0), "cell"),
        ([[1, 1], [1, 1]], 1.0, (0, np.nan), "origin"),
        ([[1, 1], [1, 1]], 1.0, (1e10, 0), "within 1e"),
        ([[1, 1], [1, 1]], 1e308, (0, 0), "within 1e"),
        ([[1, 1], [1, 1]], 1e-9, (0, 0), "or more"),
        ([[1, 1], [1, -3.4e38]], 1.0, (0, 0), "from 0, or NaN"),
        (np.ones((2, 2), complex), 1.0, (0, 0), "type complex"),
        (np.array([["1", "2"], ["3", "4"]]), 1.0, (0, 0), "type <U1"),
        (np.broadcast_to(0.0, (30_000, 30_000)), 1.0, (0, 0), "too many"),
    ],
)
def test_heights_that_make_no_ground_are_refused(
    heights: object, cell: float, origin: tuple[float, ...], words: str
) -> None:
    with pytest.raises(GeometryError, match=words):
        Terrain(heights, cell, origin)  # type: ignore[arg-type]
