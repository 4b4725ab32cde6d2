"""Whether two places are certainly apart: no way between them, however it bends.

A cell of a lattice is kept if it could hold a free place: unless its middle lies deeper within
reach of something than half its diagonal. Where no row of kept cells, side by side, leads from the
one place to the other, there is no way. A way that leaves a cell through an edge or a corner has a
free place there, so all cells that meet there are kept, and it could have gone through sides too.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.space.routing.lattice_nodes import (
    KEY,
    MOST_ASIDE,
    PARENT,
    STATE,
    LatticeNodes,
    added_node,
    found_node,
    key_of,
    no_nodes,
    with_room,
)
from viaspline.kernels.space.routing.route_protocol import PlaceLattice, could_hold, is_place

APART, TOGETHER, UNKNOWN = range(3)

_FIRST_ROOM = 1024
_WALL = 2


@inner
def _first_cell(nodes: LatticeNodes, lattice: PlaceLattice, place: Floats) -> int:
    """The cell in which a place lies; -1 where it lies outside of the lattice."""
    step = lattice.frame[3]
    i = math.floor((place[0] - lattice.frame[0]) / step + 0.5)
    j = math.floor((place[1] - lattice.frame[1]) / step + 0.5)
    k = math.floor((place[2] - lattice.frame[2]) / step + 0.5)
    if not is_place(lattice, i, j, k):
        return -1
    key = key_of(i, j, k)
    node = found_node(nodes, key)
    return node if node >= 0 else added_node(nodes, key, 0.0, 0.0, 0.0)


@inner
def _flood(
    space: Any,
    lattice: PlaceLattice,
    radius: float,
    nodes: LatticeNodes,
    here: int,
    side: int,
    last: Ints,
) -> bool:
    """Let a flood go on from a cell to those beside it; whether it meets the other flood."""
    key = nodes.links[here, KEY]
    for way in range(6):
        i = key // MOST_ASIDE // MOST_ASIDE
        j = key // MOST_ASIDE % MOST_ASIDE
        k = key % MOST_ASIDE
        by = 1 if way % 2 == 0 else -1
        if way // 2 == 0:
            i += by
        elif way // 2 == 1:
            j += by
        else:
            k += by
        if not is_place(lattice, i, j, k):
            continue
        node = found_node(nodes, key_of(i, j, k))
        if node >= 0:
            if nodes.links[node, STATE] == 1 - side:
                return True
            continue
        node = added_node(nodes, key_of(i, j, k), 0.0, 0.0, 0.0)
        if not could_hold(space, lattice, i, j, k, radius):
            nodes.links[node, STATE] = _WALL
            continue
        nodes.links[node, STATE] = side
        nodes.links[last[side], PARENT] = node
        last[side] = node
    return False


@kernel
def are_apart(
    space: Any, lattice: PlaceLattice, start: Floats, goal: Floats, radius: float, most: int
) -> tuple[int, int]:
    """Whether a lattice shows that there is no way between two free places.

    Two floods go on in turn, so that one out of a small room ends early.

    Args:
        space: Answers ``could_hold``.
        lattice: Middles of cells. All space that may be used has to lie in it.
        start: A free place [m], (3,).
        goal: A free place [m], (3,).
        radius: To be kept from everything [m].
        most: Cells to look at.

    Returns:
        (``APART``, ``TOGETHER`` or ``UNKNOWN``, which of them is shut in if they are apart): 0 for
        the start, 1 for the goal.
    """
    nodes = no_nodes(_FIRST_ROOM)
    first = _first_cell(nodes, lattice, start)
    other = _first_cell(nodes, lattice, goal)
    if first < 0 or other < 0:
        return UNKNOWN, 0
    if first == other:
        return TOGETHER, 0
    turn = np.empty(2, np.int64)  # the cell whose turn it is, of each flood
    last = np.empty(2, np.int64)
    turn[0] = first
    turn[1] = other
    for side in range(2):
        last[side] = turn[side]
        nodes.links[turn[side], STATE] = side
    while nodes.size[0] < most:
        for side in range(2):
            here = turn[side]
            if here < 0:
                return APART, side
            nodes = with_room(nodes)
            if _flood(space, lattice, radius, nodes, here, side, last):
                return TOGETHER, 0
            turn[side] = nodes.links[here, PARENT]
    return UNKNOWN, 0
