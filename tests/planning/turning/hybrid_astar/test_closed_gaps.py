"""Gaps a little too narrow: with what is left out as blocked already, the lattice is the same."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.kernels.turning.collision_cache import HALF_DIAGONAL_CELLS
from viaspline.kernels.world.rasterize import mark_segments, rasterized
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.routing.gap_graph import GapGraph
from viaspline.planning.turning.hybrid_astar.closed_gaps import closed_gaps
from viaspline.planning.turning.hybrid_astar.search_window import NO_GROWN_MAPS
from viaspline.world.world import World

INNER_M, SIDE_M = 0.6, 0.1


def clutter(seed: int) -> World:
    rng = np.random.default_rng(seed)
    discs = [
        Obstacle.model_validate({"circle": {"center": at, "radius": float(rng.uniform(0.05, 0.4))}})
        for at in rng.uniform(0.0, 10.0, (25, 2)).tolist()
    ]
    corners = rng.uniform(1.0, 9.0, (6, 2))[:, None] + rng.uniform(-0.7, 0.7, (6, 3, 2))
    lumps = [Obstacle.model_validate({"polygon": one.tolist()}) for one in corners]
    return World(tuple(discs + lumps))


def lattice(world: World, segments: np.ndarray) -> np.ndarray:
    kept = INNER_M - HALF_DIAGONAL_CELLS * SIDE_M
    cells = rasterized(world.packed, 0.0, 0.0, SIDE_M, 100, 100, kept, NO_GROWN_MAPS)
    mark_segments(np.ascontiguousarray(segments), 0.0, 0.0, SIDE_M, cells)
    return cells


@given(st.integers(0, 2**32 - 1))
@settings(deadline=None, max_examples=25)
def test_gaps_that_are_left_out_are_blocked_on_the_lattice_already(seed: int) -> None:
    world = clutter(seed)
    every = GapGraph.of(world, 2.0 * INNER_M).links.feet
    some = closed_gaps(world, INNER_M, SIDE_M)
    assert len(some) <= len(every)
    assert np.array_equal(lattice(world, some) != 0, lattice(world, every) != 0)


def test_a_gap_that_is_a_little_too_narrow_is_told() -> None:
    sides = [{"circle": {"center": [x, 5.0], "radius": 1.0}} for x in (2.0, 5.15)]
    world = World(tuple(Obstacle.model_validate(one) for one in sides))
    assert closed_gaps(world, INNER_M, SIDE_M).tolist() == [[2.0, 5.0, 5.15, 5.0]]
    assert not len(closed_gaps(world, 0.55, SIDE_M))
