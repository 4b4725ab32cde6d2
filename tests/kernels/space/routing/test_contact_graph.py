"""Ways from contact to contact: free, bounded, and on the shorter side."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.routing import shape_moves as shape_moves
from viaspline.kernels.space.routing.contact_graph import contact_way
from viaspline.kernels.space.routing.way_checks import way_cost, way_is_free
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism, RoundedSegment, Solid
from viaspline.world.space.spatial_world import SpatialWorld

NO_GATES = np.empty((0, 8))
LENGTH = np.zeros(3)


def search(
    world: SpatialWorld, first: Floats, last: Floats, radius: float, bound: float = math.inf
) -> Floats:
    way: Floats = contact_way(
        world.packed, NO_GATES, LENGTH, first, last, radius, bound, 512, 2000
    )[0]
    return way


def scene(rng: np.random.Generator) -> list[Solid]:
    found: list[Solid] = []
    for _ in range(6):
        x, y, z = rng.uniform((-15, -15, 0), (15, 15, 15))
        turn = rng.uniform(0, math.pi)
        c, s = math.cos(turn), math.sin(turn)
        ring = [(x + c * u - s * v, y + s * u + c * v) for u, v in ((-3, -2), (3, -2), (0, 2))]
        found.append(Prism(RoundedRing([ring], float(rng.uniform(0, 1))), 0.0, z))
        x, y, z = rng.uniform((-15, -15, 0), (15, 15, 15))
        other = (x + rng.normal() * 5, y + rng.normal() * 5, z)
        found.append(RoundedSegment((x, y, z), other if rng.random() < 0.5 else (x, y, z), 1.5))
    return found


@pytest.mark.long_without_jit
@settings(max_examples=60)
@given(st.integers(0, 2**32))
def test_a_way_is_free_and_keeps_its_bound(seed: int) -> None:
    rng = np.random.default_rng(seed)
    world = SpatialWorld.of(scene(rng), ground=-1.0, core_radius=0.2, core_half_height=0.1)
    first, last = rng.uniform((-20, -20, 0), (20, 20, 16), (2, 3))
    if world.distance([first, last]).min() < 0.5:
        return
    way = search(world, first, last, 0.5)
    if not len(way):
        return
    assert way_is_free(world.packed, NO_GATES, way, 0.5)
    np.testing.assert_array_equal(way[[0, -1]], [first, last])
    cost = way_cost(LENGTH, way)
    assert len(search(world, first, last, 0.5, cost)) == 0
    again = search(world, first, last, 0.5, 1.0001 * cost)
    assert len(again)
    assert way_cost(LENGTH, again) <= 1.0001 * cost


def test_a_wide_wall_is_flown_over_and_a_tall_one_round() -> None:
    first, last = np.array([-30.0, 0.0, 2.0]), np.array([30.0, 0.0, 2.0])
    for half, top, over in ((40.0, 8.0, True), (8.0, 40.0, False)):
        ring = [(-1.0, -half), (1.0, -half), (1.0, half), (-1.0, half)]
        world = SpatialWorld.of([Prism(RoundedRing([ring]), -1.0, top)], ground=0.0)
        way = search(world, first, last, 0.5)
        assert (way[:, 2].max() > 8.0) == over
        assert (np.abs(way[:, 1]).max() > 8.0) != over


def test_there_is_none_out_of_a_room() -> None:
    ring = [[(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)]]
    hole = [[(-4.0, -4.0), (-4.0, 4.0), (4.0, 4.0), (4.0, -4.0)]]
    world = SpatialWorld.of([Prism(RoundedRing([*ring, *hole]))])
    assert len(search(world, np.zeros(3), np.array([20.0, 0.0, 0.0]), 0.5)) == 0
