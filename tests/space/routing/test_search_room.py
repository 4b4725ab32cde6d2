"""Rooms of searches: voxels alone are searched as cubes, to the same end as a world is."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.solids import RoundedSegment, Solid
from viaspline.planning.problem.method import Found
from viaspline.space.routing.pass_gates import PassSide, gate
from viaspline.space.routing.search_room import SearchRoom
from viaspline.space.routing.space_router import SpaceRouter
from viaspline.space.routing.taut_route import TautRoute
from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.spatial_world import SpatialWorld

SPEEDS = (10.0, 2.5, 1.5)


def clearance_by_samples(world: SpatialWorld, route: TautRoute) -> float:
    shares = np.linspace(0.0, 1.0, 60)[:, None]
    parts = zip(route.points[:-1], route.points[1:], strict=True)
    return min(float(world.distance(a + shares * (b - a)).min()) for a, b in parts)


def among_cubes(seed: int) -> tuple[Voxels, SpatialWorld]:
    rng = np.random.default_rng(seed)
    cubes = Voxels(rng.random((7, 6, 5)) < rng.uniform(0.1, 0.5), 2.0, (0.1, -3.0, 1.0))
    band = HeightBand(lowest=1.9, highest=10.1)
    return cubes, SpatialWorld.of([cubes], bounds=(0.1, -3.0, 14.1, 9.0), band=band)


def along_neighbours(cubes: Voxels, first: int, last: int) -> float:
    """The length from cube to cube, not cutting corners: Dijkstra's, by scipy."""
    free, links = ~cubes.blocked, []
    for move in np.ndindex(3, 3, 3):
        step = np.array(move) - 1
        for at in np.argwhere(free):
            low, high = np.minimum(at, at + step), np.maximum(at, at + step) + 1
            if step.any() and (low >= 0).all() and (high <= free.shape).all():
                between = free[tuple(slice(a, b) for a, b in zip(low, high, strict=True))]
                if between.all():
                    ends = (np.ravel_multi_index(tuple(p), free.shape) for p in (at, at + step))
                    links.append((*ends, cubes.cell * np.linalg.norm(step)))
    if not links:
        return math.inf
    rows, columns, lengths = zip(*links, strict=True)
    graph = coo_array((lengths, (rows, columns)), shape=(free.size, free.size)).tocsr()
    return float(dijkstra(graph, indices=first)[last])


@settings(max_examples=12)
@example(seed=0)
@given(st.integers(0, 2**32))
def test_voxels_alone_are_searched_quickly_to_the_same_end(seed: int) -> None:
    cubes, world = among_cubes(seed)
    plain = SearchRoom.of_world(world)
    quick = plain.knowing(world, [cubes])
    assert quick.searched(0.9, np.empty((0, 3))) is not plain.packed
    free = np.flatnonzero(~cubes.blocked)
    first, last = np.random.default_rng(seed + 1).choice(free, 2).tolist()
    ends = [
        np.array(cubes.origin) + cubes.cell * (np.array(np.unravel_index(k, (7, 6, 5))) + 0.5)
        for k in (first, last)
    ]
    found = SpaceRouter(quick).find(*ends, 0.9)
    assert type(found) is type(SpaceRouter(plain).find(*ends, 0.9))
    least = along_neighbours(cubes, first, last)
    assert isinstance(found, Found) or least == math.inf
    if isinstance(found, Found):
        assert clearance_by_samples(world, found.value) >= 0.9 - 1e-9
        assert found.value.points[:, 2].min() >= 1.9
        assert found.value.points[:, 2].max() <= 10.1
        assert found.value.length <= least * (1.0 + 1e-9)


@settings(max_examples=15)
@example(seed=0)
@given(st.integers(0, 2**32))
def test_quick_ways_among_voxels_keep_the_bounds_to_the_last_digit(seed: int) -> None:
    rng = np.random.default_rng(seed)
    cubes = np.zeros((8, 8, 8), bool)
    cubes[4, 1:7] = True  # a way leads round both ends of it, by the bounds
    wall = Voxels(cubes, 1.0)
    low, radius = rng.uniform(-2.0, -0.3), rng.uniform(0.2, 0.7)
    world = SpatialWorld.of([wall], bounds=(low, low, 9.0, 9.0), band=HeightBand(0.5, 7.5))
    room = SearchRoom.of_world(world).knowing(world, [wall])
    edge = float(low + radius)
    edge = math.nextafter(edge, 9.0) if edge - low < radius else edge
    outcome = SpaceRouter(room).find((1.0, edge, 4.0), (7.5, edge, 4.0), radius)
    if edge + radius <= 1.0:
        assert isinstance(outcome, Found)
        assert world.distance(outcome.value.points).min() >= radius
    up = SpaceRouter(room).find((1.0, 4.0, 4.0), (7.5, 4.0, 4.0), radius, SPEEDS)
    assert isinstance(up, Found)
    assert world.distance(up.value.points).min() >= radius


def test_what_isnt_voxels_alone_or_is_wide_is_searched_as_it_is() -> None:
    cubes = Voxels(np.eye(4, dtype=bool)[:, :, None], 1.0)
    mast = RoundedSegment((9.0, 0.0, 0.0), (9.0, 0.0, 5.0), 0.5)
    fence = ([(-9.0, -9.0), (9.0, -9.0), (0.0, 9.0)],)
    others: list[tuple[list[Solid], dict[str, object]]] = [
        ([cubes, mast], {}), ([mast], {}), ([cubes, cubes], {}), ([cubes], {"ground": 0.0}),
        ([cubes], {"fences": [fence]}), ([cubes], {"core_radius": 0.2}),
        ([cubes], {"core_half_height": 0.2}),
    ]  # fmt: skip
    nowhere = np.empty((0, 3))
    for solids, kept in others:
        world = SpatialWorld.of(solids, **kept)
        room = SearchRoom.of_world(world).knowing(world, solids)
        assert room.searched(0.5, nowhere) is room.packed
    alone = SpatialWorld.of([cubes])
    room = SearchRoom.of_world(alone).knowing(alone, [cubes])
    assert room.searched(0.5, nowhere) is not room.packed
    assert room.searched(1.5, nowhere) is room.searched(0.0, nowhere) is room.packed


@pytest.mark.parametrize("side", ["left", "over"])
def test_quick_ways_among_voxels_pass_on_the_side_that_is_asked(side: PassSide) -> None:
    cubes = np.zeros((10, 10, 10), bool)
    cubes[4:6, 3:7, :6] = True
    alone = Voxels(cubes, 1.0)
    world = SpatialWorld.of([alone], bounds=(0, -8, 10, 18), band=HeightBand(0.5, 15.0))
    room = SearchRoom.of_world(world).knowing(world, [alone])
    ends = (1.0, 5.0, 2.0), (9.0, 5.0, 2.0)
    outcome = SpaceRouter(room).find(*ends, 0.45, gates=gate(alone, *ends, [side]))
    assert isinstance(outcome, Found)
    middle = np.array([np.interp(5.0, outcome.value.points[:, 0], outcome.value.points[:, k])
                       for k in (1, 2)])  # fmt: skip
    assert middle[0] > 10.0 if side == "left" else middle[1] > 5.0
    assert clearance_by_samples(world, outcome.value) >= 0.45 - 1e-9
