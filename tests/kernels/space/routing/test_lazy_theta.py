"""Ways through lattices of cubes, against Dijkstra on 26 neighbours and floods."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.space.routing import voxel_moves as voxel_moves
from viaspline.kernels.space.routing.lazy_theta import lattice_way
from viaspline.kernels.space.routing.route_protocol import PlaceLattice
from viaspline.kernels.space.routing.side_gates import LEFT, OVER, RIGHT, UNDER
from viaspline.kernels.space.routing.voxel_block import VoxelBlock, voxel_block
from viaspline.kernels.space.routing.way_checks import way_cost, way_is_free

NO_GATES = np.empty((0, 8))
LENGTH = np.zeros(3)
RADIUS = 0.45


def block_of(blocked: Flags) -> tuple[VoxelBlock, PlaceLattice]:
    shape = np.array(blocked.shape)
    limits = np.array([RADIUS] * 3 + [*(shape - RADIUS)])
    lattice = PlaceLattice(np.array([0.5, 0.5, 0.5, 1.0]), shape)
    return voxel_block(blocked, 1.0, (0.0, 0.0, 0.0), limits), lattice


def find(
    blocked: Flags, first: Floats, last: Floats, weight: float = 1.1, gates: Floats = NO_GATES
) -> Floats:
    block, lattice = block_of(blocked)
    way: Floats = lattice_way(
        block, gates, LENGTH, lattice, first, last, RADIUS, weight, math.inf, 10**6
    )[0]
    return way


def optimum(blocked: Flags, first: Floats, last: Floats) -> float:
    """Length of the shortest way among 26 neighbours that cuts no corner."""
    free = ~blocked
    number = np.arange(free.size).reshape(free.shape)
    rows, columns, lengths = [], [], []
    for move in np.ndindex(3, 3, 3):
        step = np.array(move) - 1
        if not step.any():
            continue
        here = tuple(
            slice(max(0, -d), n - max(0, d)) for d, n in zip(step, free.shape, strict=True)
        )
        clear = np.ones_like(free[here])
        for corner in np.ndindex(2, 2, 2):
            part = step * np.array(corner)
            there = tuple(slice(s.start + d, s.stop + d) for s, d in zip(here, part, strict=True))
            clear &= free[there]
        there = tuple(slice(s.start + d, s.stop + d) for s, d in zip(here, step, strict=True))
        rows.append(number[here][clear])
        columns.append(number[there][clear])
        lengths.append(np.full(clear.sum(), np.linalg.norm(step)))
    graph = coo_array(
        (np.concatenate(lengths), (np.concatenate(rows), np.concatenate(columns))),
        shape=(free.size, free.size),
    )
    start = number[tuple(first.astype(int))]
    return float(dijkstra(graph.tocsr(), indices=start)[number[tuple(last.astype(int))]])


@st.composite
def problems(draw: st.DrawFn) -> tuple[Flags, Floats, Floats]:
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    shape = rng.integers(1, 9, 3)
    blocked = rng.random(tuple(shape)) < draw(st.sampled_from([0.1, 0.3, 0.5]))
    ends = np.array([rng.integers(0, shape), rng.integers(0, shape)])
    blocked[tuple(ends.T)] = False
    return blocked, ends[0] + 0.5, ends[1] + 0.5


@given(problems(), st.sampled_from([1.0, 1.1]))
def test_a_way_is_found_just_where_cubes_connect_the_ends(
    problem: tuple[Flags, Floats, Floats], weight: float
) -> None:
    blocked, first, last = problem
    rooms, _ = ndimage.label(~blocked)
    together = rooms[tuple(first.astype(int))] == rooms[tuple(last.astype(int))]
    way = find(blocked, first, last, weight)
    assert (len(way) > 0) == together
    if together:
        np.testing.assert_array_equal(way[[0, -1]], [first, last])
        assert way_is_free(block_of(blocked)[0], NO_GATES, way, RADIUS)


@settings(max_examples=50)
@given(problems())
def test_a_way_is_hardly_longer_than_the_shortest_among_neighbours(
    problem: tuple[Flags, Floats, Floats],
) -> None:
    blocked, first, last = problem
    way = find(blocked, first, last, 1.0)
    if len(way):
        assert way_cost(LENGTH, way) <= 1.1 * optimum(blocked, first, last) + 1e-9


def test_a_search_ends_when_its_nodes_are_spent() -> None:
    blocked = np.zeros((12, 12, 12), bool)
    blocked[6, :, :11] = True
    block, lattice = block_of(blocked)
    ends = np.array([1.5, 6.5, 1.5]), np.array([10.5, 6.5, 1.5])
    asked = block, NO_GATES, LENGTH, lattice, *ends, RADIUS, 1.1, math.inf
    way, expanded = lattice_way(*asked, 10)
    assert (len(way), expanded) == (0, 10)
    assert len(lattice_way(*asked, 10**6)[0])


@settings(max_examples=50)
@given(problems(), st.floats(0.5, 1.5))
def test_a_way_that_costs_no_more_than_the_bound_is_found_with_it(
    problem: tuple[Flags, Floats, Floats], share: float
) -> None:
    blocked, first, last = problem
    block, lattice = block_of(blocked)
    asked = block, NO_GATES, LENGTH, lattice, first, last, RADIUS, 1.1
    way = lattice_way(*asked, math.inf, 10**6)[0]
    bound = share * float(way_cost(LENGTH, way)) + 1e-9
    bounded = lattice_way(*asked, bound, 10**6)[0]
    if len(bounded):
        assert way_cost(LENGTH, bounded) <= bound
    else:
        assert share < 1.0 or not len(way)


def test_a_ball_larger_than_half_a_cube_keeps_to_wider_gaps() -> None:
    blocked = np.zeros((9, 9, 9), bool)
    blocked[4] = True
    blocked[4, 1, 1] = False
    blocked[4, 5:8, 5:8] = False
    block = voxel_block(blocked, 1.0, (0, 0, 0), np.array([0.9] * 3 + [8.1] * 3))
    lattice = PlaceLattice(np.array([1.5, 1.5, 1.5, 1.0]), np.array([7, 7, 7]))
    ends = np.array([1.5, 1.5, 1.5]), np.array([7.5, 1.5, 1.5])
    way = lattice_way(block, NO_GATES, LENGTH, lattice, *ends, 0.9, 1.1, math.inf, 10**6)[0]
    assert len(way) > 2
    assert way_is_free(block, NO_GATES, way, 0.9)
    assert way[:, 1:].max() > 5.0


@pytest.mark.parametrize("side", [LEFT, RIGHT, OVER, UNDER])
def test_a_way_passes_on_the_side_that_its_gate_allows(side: int) -> None:
    blocked = np.zeros((21, 21, 21), bool)
    blocked[10, 8:13, 8:13] = True
    first, last = np.array([2.5, 10.5, 10.5]), np.array([18.5, 10.5, 10.5])
    gate = np.array([[10.5, 10.5, 1.0, 0.0, -2.5, 2.5, 10.5, side]])
    way = find(blocked, first, last, 1.1, gate)
    places = np.array([np.interp(10.5, way[:, 0], way[:, axis]) for axis in range(3)])
    left = places[1] - 10.5
    seen = LEFT if left > 2.5 else RIGHT if left < -2.5 else OVER if places[2] > 10.5 else UNDER
    assert seen == side
