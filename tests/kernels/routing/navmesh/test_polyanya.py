"""Shortest paths through lattices, against a visibility graph of their corners."""

import heapq
import itertools
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from viaspline.kernels.arrays import Bytes
from viaspline.kernels.routing.navmesh.polyanya import shortest_path
from viaspline.kernels.routing.navmesh.rectangles import mesh_of

Floats = NDArray[np.float64]
shapes = st.tuples(st.integers(1, 8), st.integers(1, 8))
lattices = arrays(np.uint8, shapes, elements=st.sampled_from([0, 0, 1]))
seeds = st.integers(0, 2**32)


def corners(walled: Bytes) -> list[tuple[float, float]]:
    """Lattice points where just one of the four cells round them is blocked."""
    four = walled[:-1, :-1] + walled[1:, :-1] + walled[:-1, 1:] + walled[1:, 1:]
    return [(float(x), float(y)) for y, x in np.argwhere(four == 1)]


def pinches(walled: Bytes) -> list[tuple[float, float]]:
    """Lattice points between two cells that are blocked and face each other diagonally."""
    one = walled[:-1, :-1] & walled[1:, 1:] & ~walled[1:, :-1] & ~walled[:-1, 1:]
    two = ~walled[:-1, :-1] & ~walled[1:, 1:] & walled[1:, :-1] & walled[:-1, 1:]
    return [(float(x), float(y)) for y, x in np.argwhere((one | two) & 1)]


def solid(walled: Bytes) -> Any:
    """What is blocked, a hair smaller, with the pinches shut."""
    boxes = [shapely.box(x - 1, y - 1, x, y) for y, x in np.argwhere(walled)]
    shut = [shapely.Point(place).buffer(1e-6) for place in pinches(walled)]
    return shapely.union_all([shapely.union_all(boxes).buffer(-1e-7), *shut])


def visibility_length(blocked: Bytes, start: Floats, goal: Floats) -> float:
    """Length of the shortest path by Dijkstra; infinite where there is none."""
    walled = np.pad(blocked, 1, constant_values=1)
    nodes = np.array([tuple(start), tuple(goal), *corners(walled)])
    pairs = np.array(list(itertools.combinations(range(len(nodes)), 2)))
    free = ~shapely.intersects(solid(walled), shapely.linestrings(nodes[pairs]))
    gaps = np.full((len(nodes), len(nodes)), np.inf)
    for i, j in pairs[free]:
        gaps[i, j] = gaps[j, i] = np.hypot(*(nodes[i] - nodes[j]))
    best = np.full(len(nodes), np.inf)
    queue = [(0.0, 0)]
    while queue:
        length, here = heapq.heappop(queue)
        if length >= best[here]:
            continue
        best[here] = length
        for other in np.flatnonzero(length + gaps[here] < best):
            heapq.heappush(queue, (length + gaps[here, other], int(other)))
    return float(best[1])


def length_of(path: Floats) -> float:
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum()) if len(path) else np.inf


def check_middles(
    blocked: Bytes, start: Floats, goal: Floats, middles: Floats, *, found: bool
) -> None:
    """The path through middles of cells is half a cell from what is blocked, its ends aside."""
    assert (len(middles) > 0) == found
    if found:
        np.testing.assert_array_equal(middles[[0, -1]], [start, goal])
        walls = solid(np.pad(blocked, 1, constant_values=1))
        inner = shapely.LineString(middles[1:-1])
        assert inner.distance(walls) >= 0.5 - 1e-9
        for end, first in ((start, middles[1]), (goal, middles[-2])):
            assert np.abs(end - first).max() <= 0.5 + 1e-9
            assert not shapely.LineString((end, first)).intersects(walls.buffer(-1e-9))


def check(blocked: Bytes, start: Any, goal: Any) -> None:
    start, goal = np.array(start, float), np.array(goal, float)
    path, middles = shortest_path(mesh_of(blocked), start, goal)
    check_middles(blocked, start, goal, middles, found=len(path) > 0)
    assert length_of(path) == pytest.approx(visibility_length(blocked, start, goal), abs=1e-6)
    if len(path):
        np.testing.assert_array_equal(path[[0, -1]], [start, goal])
        walled = np.pad(blocked, 1, constant_values=1)
        assert not shapely.LineString(path).intersects(solid(walled))
        assert {tuple(turn) for turn in path[1:-1]} <= set(corners(walled))
        back, _ = shortest_path(mesh_of(blocked), goal, start)
        assert length_of(back) == pytest.approx(length_of(path))


def free_cells(blocked: Bytes, seed: int) -> tuple[np.random.Generator, Floats]:
    rng = np.random.default_rng(seed)
    cells = np.argwhere(blocked == 0)[:, ::-1]
    return rng, rng.choice(cells, 2).astype(float) if len(cells) else np.empty((0, 2))


@given(lattices, seeds)
def test_paths_between_middles_of_cells_are_the_shortest(blocked: Bytes, seed: int) -> None:
    _, cells = free_cells(blocked, seed)
    if len(cells):
        check(blocked, *(cells + 0.5))


@given(lattices, seeds)
def test_paths_between_any_places_are_the_shortest(blocked: Bytes, seed: int) -> None:
    rng, cells = free_cells(blocked, seed)
    if len(cells):
        check(blocked, *(cells + rng.uniform(0.001, 0.999, (2, 2))))


@given(lattices, seeds)
def test_paths_between_sides_of_cells_are_the_shortest(blocked: Bytes, seed: int) -> None:
    rng, cells = free_cells(blocked, seed)
    if len(cells):
        check(blocked, *(cells + rng.permuted([[0.5, 0.0], [0.5, 1.0]], axis=1)))


def test_a_place_is_as_far_from_itself_as_nothing() -> None:
    check(np.zeros((3, 3), np.uint8), (1.25, 1.5), (1.25, 1.5))


def test_nothing_leads_through_a_pinch() -> None:
    blocked = np.array([[0, 1], [1, 0]], np.uint8)
    assert len(shortest_path(mesh_of(blocked), np.array([0.5, 0.5]), np.array([1.5, 1.5]))[0]) == 0


@given(lattices, st.floats(-1, 9), st.floats(-1, 9))
def test_a_place_is_found_where_it_is_in_a_free_cell_or_on_its_border(
    blocked: Bytes, x: float, y: float
) -> None:
    free = shapely.union_all(
        [shapely.box(c, r, c + 1, r + 1) for r, c in np.argwhere(blocked == 0)]
    )
    place = np.array([x, y])
    gap = free.distance(shapely.Point(place))
    if gap == 0.0 or gap > 1e-8:  # else within rounding
        assert len(shortest_path(mesh_of(blocked), place, place)[0]) == (2 if gap == 0.0 else 0)


@pytest.mark.parametrize("shape", [(0, 0), (0, 3), (3, 0)])
def test_nothing_leads_through_a_lattice_without_cells(shape: tuple[int, int]) -> None:
    mesh = mesh_of(np.zeros(shape, np.uint8))
    assert len(shortest_path(mesh, np.zeros(2), np.ones(2))[0]) == 0


@pytest.mark.parametrize("place", [(-3.0, 1.5), (1.5, 1.5), (1.5, 90.0), (np.nan, 1.0)])
def test_nothing_leads_to_where_no_free_cell_is(place: tuple[float, float]) -> None:
    blocked = np.zeros((3, 3), np.uint8)
    blocked[1, 1] = 1
    mesh = mesh_of(blocked)
    for ends in ((place, (0.5, 0.5)), ((0.5, 0.5), place)):
        assert len(shortest_path(mesh, *map(np.array, ends))[0]) == 0


def test_a_path_turns_as_often_as_it_must() -> None:
    blocked = np.zeros((81, 9), np.uint8)
    blocked[1::4, :-1] = 1
    blocked[3::4, 1:] = 1
    start, goal = np.array([0.5, 0.5]), np.array([0.5, 80.5])
    path, _ = shortest_path(mesh_of(blocked), start, goal)
    assert len(path) == 2 + 2 * 40 - 1
    assert length_of(path) == pytest.approx(visibility_length(blocked, start, goal))
