"""What a string can lie against; the function has no door from Python but with the JIT off."""

import os
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.kernels.routing.string_pulling.features import features_near
from viaspline.kernels.world.ring_features import FEATURE_RADIUS, FEATURE_X, OUT_X
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.pack import pack

pytestmark = pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT") != "1", reason="kernels alone call it"
)

Floats = NDArray[np.float64]
SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
L_SHAPE = [(0.0, 0.0), (6.0, 0.0), (6.0, 2.0), (2.0, 2.0), (2.0, 6.0), (0.0, 6.0)]
HALF = np.sqrt(0.5)


def near(
    obstacle: Obstacle | None, x: float, y: float, reach: float, room: int = 64, fences: Any = ()
) -> Floats:
    out = np.full((room, 5), np.nan)
    packed = pack([] if obstacle is None else [obstacle], None, [(ring,) for ring in fences])
    return out[: features_near(packed, x, y, reach, out)]


def corners(features: Floats) -> set[tuple[float, float]]:
    return {(float(x), float(y)) for x, y in features[:, FEATURE_X : FEATURE_X + 2]}


def test_a_circle_is_near_where_its_rim_is() -> None:
    circle = Obstacle(circle={"center": (0, 0), "radius": 3})
    assert len(near(circle, 5, 0, 1.99)) == 0
    np.testing.assert_array_equal(near(circle, 5, 0, 2.0), [(0, 0, 3, 0, 0)])
    assert len(near(circle, 0, 0, 0.1)) == 1


@pytest.mark.parametrize("ring", [SQUARE, SQUARE[::-1]])
def test_the_corners_of_a_polygon_point_away_from_it(ring: list[tuple[float, float]]) -> None:
    found = near(Obstacle(polygon=ring), 2, 2, 9)
    assert corners(found) == set(SQUARE)
    assert (found[:, FEATURE_RADIUS] == 0).all()
    expected = (found[:, :2] - 2) / np.hypot(2, 2)
    np.testing.assert_allclose(found[:, OUT_X : OUT_X + 2], expected, atol=1e-12)
    assert corners(near(Obstacle(polygon=ring), -1, -1, 2)) == {(0.0, 0.0)}


def test_only_convex_corners_can_be_turned_at() -> None:
    assert corners(near(Obstacle(polygon=L_SHAPE), 2, 2, 9)) == set(L_SHAPE) - {(2.0, 2.0)}


def test_no_string_lies_against_the_convex_corners_of_a_hole_or_a_fence() -> None:
    room = Obstacle(polygon=[(-9, -9), (9, -9), (9, 9), (-9, 9)], holes=(L_SHAPE,))
    assert corners(near(room, 2, 2, 8)) == {(2.0, 2.0)}
    found = near(None, 2, 2, 8, fences=[L_SHAPE])
    assert corners(found) == {(2.0, 2.0)}
    np.testing.assert_allclose(found[0, OUT_X : OUT_X + 2], (-HALF, -HALF))


@given(st.integers(0, 2**32), st.floats(-3, 3))
def test_a_grid_has_the_corners_of_its_squares(seed: int, yaw: float) -> None:
    blocked = np.random.default_rng(seed).random((4, 5)) < 0.4
    found = near(Obstacle(grid=Grid(blocked, 2.0, (1.0, 3.0, yaw))), 0, 0, 99)
    walled = np.pad(blocked, 1).astype(int)
    four = walled[:-1, :-1] + walled[1:, :-1] + walled[:-1, 1:] + walled[1:, 1:]
    cross = (four == 2) & (walled[:-1, :-1] == walled[1:, 1:])
    turn = np.array([(np.cos(yaw), np.sin(yaw)), (-np.sin(yaw), np.cos(yaw))])
    expected = [2.0 * np.array((x, y)) @ turn + (1, 3) for y, x in np.argwhere(four == 1)]
    expected += [2.0 * np.array((x, y)) @ turn + (1, 3) for y, x in np.argwhere(cross)] * 2
    assert len(found) == len(expected)
    if expected:
        np.testing.assert_allclose(
            sorted(map(tuple, found[:, :2].round(6))), sorted(map(tuple, np.round(expected, 6)))
        )
        np.testing.assert_allclose(np.hypot(*found[:, OUT_X : OUT_X + 2].T), 1.0)


def test_what_does_not_fit_is_left_out() -> None:
    assert len(near(Obstacle(polygon=SQUARE), 2, 2, 9, room=3)) == 3
