"""Gaps a little too narrow for a robot's reference point, which a lattice shows open."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.turning.collision_cache import HALF_DIAGONAL_CELLS
from viaspline.planning.routing.gap_graph import GapGraph, is_soon_made
from viaspline.world.world import World


def closed_gaps(world: World, inner: float, side: float) -> Floats:
    """Segments across gaps that a lattice may show open and no way leads through [m], (n, 4).

    Narrower ones are blocked on it. None is told among too many things, and on maps.

    Args:
        world: What there is in a window.
        inner: Distance that the reference point keeps at least [m].
        side: Of a cell of the lattice [m].
    """
    if not len(world) or not is_soon_made(world):
        return np.empty((0, 4))
    # a cell is blocked whose middle is nearer than half a diagonal less than what is kept; those on
    # the line across a gap have theirs half a diagonal beside it
    blocked = max(2.0 * (inner - 2.0 * HALF_DIAGONAL_CELLS * side), 0.0)
    return np.ascontiguousarray(GapGraph.of(world, 2.0 * inner, blocked).links.feet)
