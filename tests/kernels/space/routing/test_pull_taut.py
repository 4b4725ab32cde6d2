"""Ways pulled taut, against shortest ways that are known."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.space.routing import voxel_moves as voxel_moves
from viaspline.kernels.space.routing.lazy_theta import lattice_way
from viaspline.kernels.space.routing.pull_taut import taut_way
from viaspline.kernels.space.routing.route_protocol import PlaceLattice
from viaspline.kernels.space.routing.voxel_block import VoxelBlock, voxel_block
from viaspline.kernels.space.routing.way_checks import way_cost, way_is_free

NO_GATES = np.empty((0, 8))
LENGTH = np.zeros(3)
RADIUS, REACH = 0.45, 0.0225


def block_of(blocked: Flags) -> tuple[VoxelBlock, PlaceLattice]:
    shape = np.array(blocked.shape)
    limits = np.array([RADIUS] * 3 + [*(shape - RADIUS)])
    lattice = PlaceLattice(np.array([0.5, 0.5, 0.5, 1.0]), shape)
    return voxel_block(blocked, 1.0, (0.0, 0.0, 0.0), limits), lattice


def pull(block: VoxelBlock, way: Floats, least: float = 1e-6, norm: Floats = LENGTH) -> Floats:
    taut: Floats = taut_way(block, NO_GATES, norm, way, RADIUS, REACH, least)
    return taut


@pytest.mark.slow
@pytest.mark.long_without_jit
@settings(max_examples=50)
@given(st.integers(0, 2**32), st.booleans())
def test_a_pulled_way_is_free_and_costs_no_more(seed: int, timed: bool) -> None:
    rng = np.random.default_rng(seed)
    shape = rng.integers(3, 12, 3)
    blocked = rng.random(tuple(shape)) < 0.2
    ends = np.array([rng.integers(0, shape), rng.integers(0, shape)])
    blocked[tuple(ends.T)] = False
    block, lattice = block_of(blocked)
    first, last = ends + 0.5
    norm = np.array([2.0, 0.7, 0.4]) if timed else LENGTH
    way = lattice_way(block, NO_GATES, norm, lattice, first, last, RADIUS, 1.1, math.inf, 10**6)[0]
    if len(way):
        taut = pull(block, way, 1e-3, norm)
        assert way_is_free(block, NO_GATES, taut, RADIUS)
        assert way_cost(norm, taut) <= way_cost(norm, way) * (1.0 + 2e-3 * timed) + 1e-9
        np.testing.assert_array_equal(taut[[0, -1]], [first, last])


def test_a_way_over_a_wall_is_as_short_as_two_arcs_allow() -> None:
    blocked = np.zeros((31, 5, 20), bool)
    blocked[15, :, :10] = True
    block, _ = block_of(blocked)
    first, last = np.array([2.5, 2.5, 2.5]), np.array([28.5, 2.5, 2.5])
    way = np.array([first, [2.5, 2.5, 18.5], [28.5, 2.5, 18.5], last])
    taut = pull(block, way)
    reach, up = 12.5, 7.5  # from the start to the edge; then an arc, and along the top
    away = math.hypot(reach, up)
    tangent = math.sqrt(away**2 - RADIUS**2)
    arc = math.atan2(up, reach) + math.asin(RADIUS / away)
    shortest = 2 * (tangent + RADIUS * arc) + 1.0
    assert shortest <= way_cost(LENGTH, taut) <= shortest * 1.0005
    assert len(taut) < 40


def test_a_way_slides_along_an_edge_to_where_it_is_shortest() -> None:
    blocked = np.zeros((31, 31, 16), bool)
    blocked[15, :, :10] = True
    block, _ = block_of(blocked)
    first, last = np.array([10.5, 2.5, 4.5]), np.array([20.5, 28.5, 9.5])
    taut = pull(block, np.array([first, [15.5, 28.0, 14.5], last]), 1e-7)

    def over(y: float) -> float:
        """Two lines and a line over the wall, as if it were as sharp as a cube."""
        shares = np.linspace(0.0, 1.0, 200)
        return min(
            math.dist(first, (14.7, y, 10.3))
            + math.dist((14.7, y, 10.3), (16.3, y + d, 10.3))
            + math.dist((16.3, y + d, 10.3), last)
            for d in shares * 8.0
        )

    best = minimize_scalar(over, bounds=(2.5, 28.5), method="bounded")
    assert way_cost(LENGTH, taut) == pytest.approx(best.fun, rel=5e-3)


def test_cuts_that_gain_little_are_left_out() -> None:
    blocked = np.zeros((31, 5, 20), bool)
    blocked[15, :, :10] = True
    block, _ = block_of(blocked)
    way = np.array([[2.5, 2.5, 2.5], [2.5, 2.5, 18.5], [28.5, 2.5, 18.5], [28.5, 2.5, 2.5]])
    counts = [len(pull(block, way, least)) for least in (1.0, 0.01, 1e-6)]
    assert counts == sorted(counts)
    assert counts[0] <= 4


@pytest.mark.long_without_jit
def test_a_fast_way_climbs_no_more_than_time_allows() -> None:
    """Climbing is slow here: the way round is longer than the way over, and faster."""
    blocked = np.zeros((31, 31, 20), bool)
    blocked[15, 3:28, :8] = True
    block, lattice = block_of(blocked)
    first, last = np.array([10.5, 15.5, 1.5]), np.array([20.5, 15.5, 1.5])
    for norm, climbs in ((LENGTH, True), (np.array([10.0, 1.0, 1.0]), False)):
        way = lattice_way(
            block, NO_GATES, norm, lattice, first, last, RADIUS, 1.0, math.inf, 10**6
        )[0]
        taut = pull(block, way, 1e-3, norm)
        assert (taut[:, 2].max() > 8.0) == climbs


def test_a_straight_way_is_left_as_it_is() -> None:
    block, _ = block_of(np.zeros((9, 9, 9), bool))
    way = np.array([[1.0, 1.0, 1.0], [8.0, 7.0, 6.0]])
    np.testing.assert_array_equal(pull(block, way), way)


@pytest.mark.long_without_jit
def test_pulling_twice_gives_the_same_bytes() -> None:
    rng = np.random.default_rng(3)
    blocked = rng.random((20, 20, 20)) < 0.15
    blocked[0, 0, 0] = blocked[19, 19, 19] = False
    block, lattice = block_of(blocked)
    asked = (
        block,
        NO_GATES,
        LENGTH,
        lattice,
        np.full(3, 0.5),
        np.full(3, 19.5),
        RADIUS,
        1.1,
        math.inf,
    )
    ways = [pull(block, lattice_way(*asked, 10**6)[0]) for _ in range(2)]
    assert len(ways[0]) > 2
    assert ways[0].tobytes() == ways[1].tobytes()
