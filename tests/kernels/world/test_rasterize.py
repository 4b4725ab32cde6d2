"""Worlds on a lattice, against signed distances at the middles of cells."""

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.kernels.arrays import Bytes
from viaspline.kernels.world.distance import distances
from viaspline.kernels.world.rasterize import mark_segments, rasterized
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.pack import pack

Floats = NDArray[np.float64]
NOTHING: Bytes = np.empty((0, 0), np.uint8)
seeds = st.integers(0, 2**32)


def random_obstacles(rng: np.random.Generator) -> list[Obstacle]:
    made = []
    for _ in range(int(rng.integers(0, 4))):
        x, y = rng.uniform(-2, 12, 2)
        made.append(Obstacle(circle={"center": (x, y), "radius": float(rng.uniform(0.1, 3))}))
        angle = np.sort(rng.uniform(0, 2 * np.pi, 3)) + np.array([0.0, 0.01, 0.02])
        ring = rng.uniform(-2, 12, 2) + 2 * np.column_stack((np.cos(angle), np.sin(angle)))
        made.append(Obstacle(polygon=ring))
    if rng.random() < 0.5:
        blocked = rng.random((5, 6)) < 0.3
        made.append(Obstacle(grid=Grid(blocked, 1.3, (1.0, 2.0, float(rng.uniform(-1, 1))))))
    return made


@given(seeds)
def test_cells_are_blocked_whose_middles_are_too_close(seed: int) -> None:
    rng = np.random.default_rng(seed)
    bounds = (-1.0, -1.0, 11.0, 9.0) if rng.random() < 0.5 else None
    fences = [((0, 0), (10, 0), (10, 9), (4, 3))] if rng.random() < 0.5 else []
    packed = pack(random_obstacles(rng), bounds, [(ring,) for ring in fences])
    side, reach = rng.uniform(0.4, 1.5), rng.uniform(0.0, 1.5)
    height, width = rng.integers(1, 14, 2).tolist()
    x, y = rng.uniform(-3, 3, 2).tolist()
    cells = rasterized(packed, x, y, side, height, width, reach, NOTHING)
    row, column = np.indices((height, width)) + 0.5
    middles = np.column_stack((x + column.ravel() * side, y + row.ravel() * side))
    distance = distances(packed, middles)[0].reshape(height, width)
    clear_cut = np.abs(distance - reach) > 1e-9
    np.testing.assert_array_equal((cells != 0)[clear_cut], (distance < reach)[clear_cut])


def test_maps_that_are_on_the_lattice_already_are_not_drawn_again() -> None:
    blocked = np.array([[1, 0, 0]], bool)
    packed = pack([Obstacle(grid=Grid(blocked, 1.0, (0.0, 0.0, 0.0)))], None, ())
    given_cells = np.array([[0, 0, 1]], np.uint8)
    cells = rasterized(packed, 0.0, 0.0, 1.0, 1, 3, 0.1, given_cells)
    assert cells.tolist() == [[0, 0, 1]]
    cells[0, 0] = 1
    assert given_cells.tolist() == [[0, 0, 1]]


def touched(segment: Floats, side: float, shape: tuple[int, int], more: float) -> Any:
    """Whether each cell, grown by ``more``, meets a segment."""
    row, column = np.indices(shape)
    boxes = shapely.box(
        column * side - more, row * side - more, (column + 1) * side + more, (row + 1) * side + more
    )
    return shapely.intersects(boxes, shapely.linestrings(segment.reshape(2, 2)))


@given(seeds)
def test_segments_block_the_cells_that_they_pass_through(seed: int) -> None:
    rng = np.random.default_rng(seed)
    side = float(rng.uniform(0.3, 2.0))
    segments = rng.uniform(-2, 8, (2, 4))
    if rng.random() < 0.3:
        segments = np.round(segments / side) * side
    cells = np.zeros((7, 6), np.uint8)
    mark_segments(segments, 0.0, 0.0, side, cells)
    low = touched(segments[0], side, (7, 6), -1e-6) | touched(segments[1], side, (7, 6), -1e-6)
    high = touched(segments[0], side, (7, 6), 1e-6) | touched(segments[1], side, (7, 6), 1e-6)
    assert (cells[low] == 1).all()
    assert (cells[~high] == 0).all()


@pytest.mark.parametrize(
    "segment", [(1.0, 0.5, 1.0, 3.5), (0.5, 2.0, 3.5, 2.0), (1.0, 1.0, 3.0, 3.0), (2, 0, 2, 4)]
)
def test_segments_along_the_lines_of_a_lattice_close_it(segment: Any) -> None:
    """Bytes to both sides of the segment are no longer joined across it."""
    cells = np.zeros((4, 4), np.uint8)
    mark_segments(np.array([segment], float), 0.0, 0.0, 1.0, cells)
    a, b = np.array(segment[:2], float), np.array(segment[2:], float)
    across = np.array([a[1] - b[1], b[0] - a[0]]) / np.hypot(*(b - a))
    for w in np.linspace(0.05, 0.95, 19):
        place = a + w * (b - a)
        near = [tuple(np.floor(place + s * 1e-6 * across).astype(int)) for s in (-1, 1)]
        assert any(cells[y, x] for x, y in near)


def test_segments_off_the_lattice_block_nothing() -> None:
    cells = np.zeros((3, 3), np.uint8)
    mark_segments(
        np.array([[-5.0, -5, -1, -2], [4, 4, 9, 9], [-9, 1, -8, 1]]), 0.0, 0.0, 1.0, cells
    )
    mark_segments(np.empty((0, 4)), 0.0, 0.0, 1.0, cells)
    assert not cells.any()
