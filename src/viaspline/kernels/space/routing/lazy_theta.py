"""The way through a lattice with straight lines of any direction: Lazy Theta*.

Alex Nash, Sven Koenig, Craig Tovey: "Lazy Theta*: Any-Angle Path Planning and Path Length Analysis
in 3D", AAAI 2010. A node takes the parent of the node that it was seen from, and only when its turn
comes is the line to that parent looked at; if it is blocked, the best settled neighbour is taken
that sees it. Lines between neighbours are looked at no sooner, either.
With the estimate weighted above 1 the search is greedier; the way is pulled taut afterwards anyway.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.growable import new_floats
from viaspline.kernels.heap import pop, push
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.space.routing.lattice_nodes import (
    COST,
    GOAL_KEY,
    KEY,
    MOST_ASIDE,
    OPEN,
    PARENT,
    SETTLED,
    SHUT,
    START_KEY,
    STATE,
    LatticeNodes,
    X,
    Y,
    Z,
    added_node,
    found_node,
    key_of,
    no_nodes,
    with_room,
)
from viaspline.kernels.space.routing.route_protocol import (
    PlaceLattice,
    is_free,
    is_open,
    is_place,
    open_moves,
)
from viaspline.kernels.space.routing.side_gates import gates_allow
from viaspline.kernels.space.routing.travel_norm import travel_between
from viaspline.kernels.space.routing.travel_past import travel_past

_START, _GOAL = 0, 1
_FIRST_ROOM = 1024


@inner
def _line_is_free(space: Any, gates: Floats, places: Floats, i: int, j: int, radius: float) -> bool:
    x = places[i, X]
    y = places[i, Y]
    z = places[i, Z]
    dx = places[j, X] - x
    dy = places[j, Y] - y
    dz = places[j, Z] - z
    return gates_allow(gates, x, y, z, dx, dy, dz) and is_free(space, x, y, z, dx, dy, dz, radius)


@inlined
def _reach(
    nodes: LatticeNodes,
    gates: Floats,
    norm: Floats,
    weight: float,
    bound: float,
    node: int,
    parent: int,
) -> None:
    """Let a node be reached from a parent, if that is cheaper, and not too dear."""
    places = nodes.places
    cost = places[parent, COST] + travel_between(norm, places, parent, node)
    if cost < places[node, COST]:
        ahead = travel_past(
            gates,
            norm,
            places[node, X],
            places[node, Y],
            places[node, Z],
            places[_GOAL, X],
            places[_GOAL, Y],
            places[_GOAL, Z],
        )
        if cost + ahead <= bound:
            places[node, COST] = cost
            nodes.links[node, PARENT] = parent
            push(nodes.open, cost + weight * ahead, node)


@inlined
def _nearest_row(lattice: PlaceLattice, axis: int, at: float) -> int:
    """The row of a lattice next to a coordinate, which may lie outside."""
    return math.floor((at - lattice.frame[axis]) / lattice.frame[3] + 0.5)


@inner
def _new_node(
    space: Any, nodes: LatticeNodes, lattice: PlaceLattice, i: int, j: int, k: int, radius: float
) -> int:
    """A node for a place of the lattice that is new."""
    step = lattice.frame[3]
    x = lattice.frame[0] + i * step
    y = lattice.frame[1] + j * step
    z = lattice.frame[2] + k * step
    node = added_node(nodes, key_of(i, j, k), x, y, z)
    if not is_open(space, x, y, z, radius):
        nodes.links[node, STATE] = SHUT
    return node


@inner
def _begin(
    space: Any,
    gates: Floats,
    norm: Floats,
    lattice: PlaceLattice,
    start: Floats,
    goal: Floats,
    radius: float,
    weight: float,
    bound: float,
) -> LatticeNodes:
    """A search that knows the places of the lattice about its start."""
    nodes = no_nodes(_FIRST_ROOM)
    added_node(nodes, START_KEY, start[0], start[1], start[2])
    added_node(nodes, GOAL_KEY, goal[0], goal[1], goal[2])
    nodes.places[_START, COST] = 0.0
    nodes.links[_START, PARENT] = _START
    nodes.links[_START, STATE] = SETTLED
    if _line_is_free(space, gates, nodes.places, _START, _GOAL, radius):
        _reach(nodes, gates, norm, weight, bound, _GOAL, _START)
        return nodes
    for move in range(27):
        i = _nearest_row(lattice, 0, start[0]) + move // 9 - 1
        j = _nearest_row(lattice, 1, start[1]) + move // 3 % 3 - 1
        k = _nearest_row(lattice, 2, start[2]) + move % 3 - 1
        if is_place(lattice, i, j, k):
            node = _new_node(space, nodes, lattice, i, j, k, radius)
            if _line_is_free(space, gates, nodes.places, _START, node, radius):
                _reach(nodes, gates, norm, weight, bound, node, _START)
    return nodes


@inner
def _settle(
    space: Any,
    gates: Floats,
    nodes: LatticeNodes,
    norm: Floats,
    lattice: PlaceLattice,
    here: int,
    moves: int,
    radius: float,
) -> bool:
    """Let a node whose line to its parent is blocked come from the best settled neighbour.

    Returns:
        Whether there is one; else the node waits for another that sees it.
    """
    key = nodes.links[here, KEY]
    i = key // MOST_ASIDE // MOST_ASIDE
    j = key // MOST_ASIDE % MOST_ASIDE
    k = key % MOST_ASIDE
    while True:
        nodes.places[here, COST] = np.inf
        best = -1
        for move in range(27):
            if (moves >> move) & 1 == 0:
                continue
            other = found_node(
                nodes, key_of(i + move // 9 - 1, j + move // 3 % 3 - 1, k + move % 3 - 1)
            )
            if other >= 0 and nodes.links[other, STATE] == SETTLED:
                cost = nodes.places[other, COST] + travel_between(norm, nodes.places, other, here)
                if cost < nodes.places[here, COST]:
                    nodes.places[here, COST] = cost
                    nodes.links[here, PARENT] = other
                    best = move
        if best < 0:
            return False
        if _line_is_free(space, gates, nodes.places, nodes.links[here, PARENT], here, radius):
            return True
        moves ^= 1 << best


@inner
def _spread(
    space: Any,
    gates: Floats,
    nodes: LatticeNodes,
    norm: Floats,
    lattice: PlaceLattice,
    here: int,
    moves: int,
    radius: float,
    weight: float,
    bound: float,
) -> None:
    """Let the neighbours of a node be reached from its parent."""
    key = nodes.links[here, KEY]
    i = key // MOST_ASIDE // MOST_ASIDE
    j = key // MOST_ASIDE % MOST_ASIDE
    k = key % MOST_ASIDE
    parent = nodes.links[here, PARENT]
    for move in range(27):
        if (moves >> move) & 1 == 1:
            x = i + move // 9 - 1
            y = j + move // 3 % 3 - 1
            z = k + move % 3 - 1
            other = found_node(nodes, key_of(x, y, z))
            if other < 0:
                other = _new_node(space, nodes, lattice, x, y, z, radius)
            if nodes.links[other, STATE] == OPEN:
                _reach(nodes, gates, norm, weight, bound, other, parent)


@inner
def _sees_goal(
    space: Any,
    gates: Floats,
    nodes: LatticeNodes,
    lattice: PlaceLattice,
    here: int,
    radius: float,
) -> bool:
    """Whether a node is next to the goal and a free way leads there."""
    step = 1.5 * lattice.frame[3]
    for axis in range(3):
        if abs(nodes.places[here, axis] - nodes.places[_GOAL, axis]) > step:
            return False
    return _line_is_free(space, gates, nodes.places, here, _GOAL, radius)


@inner
def _traced(nodes: LatticeNodes) -> Floats:
    """The way from the start to the goal, (k, 3)."""
    count = 1
    here = _GOAL
    while here != _START:
        here = nodes.links[here, PARENT]
        count += 1
    way = new_floats(count, 3)
    here = _GOAL
    for row in range(count - 1, -1, -1):
        for axis in range(3):
            way[row, axis] = nodes.places[here, axis]
        here = nodes.links[here, PARENT]
    return way


@kernel
def lattice_way(
    space: Any,
    gates: Floats,
    norm: Floats,
    lattice: PlaceLattice,
    start: Floats,
    goal: Floats,
    radius: float,
    weight: float,
    bound: float,
    most: int,
) -> tuple[Floats, int]:
    """A way between two places, through places of a lattice.

    Args:
        space: Answers ``is_free``, ``is_open`` and ``open_moves``.
        gates: See ``side_gates``, (g, 8).
        norm: See ``travel_norm``, (3,).
        lattice: At most 2^20 places along an axis.
        start: [m], (3,).
        goal: [m], (3,).
        radius: To be kept from everything [m].
        weight: Of the estimate, from 1 on.
        bound: Only a way that costs no more is of interest [m or s].
        most: Nodes to expand.

    Returns:
        (corners (k, 3), nodes expanded): no corners where there is no way through the lattice, or
        none was found with the nodes that may be expanded.
    """
    nodes = _begin(space, gates, norm, lattice, start, goal, radius, weight, bound)
    expanded = 0
    while nodes.open.size[0] > 0 and expanded < most:
        here = pop(nodes.open)
        if nodes.links[here, STATE] == SETTLED or nodes.places[here, COST] == np.inf:
            continue
        if here == _GOAL:
            return _traced(nodes), expanded
        nodes = with_room(nodes)
        expanded += 1
        key = nodes.links[here, KEY]
        moves = open_moves(
            space,
            lattice,
            key // MOST_ASIDE // MOST_ASIDE,
            key // MOST_ASIDE % MOST_ASIDE,
            key % MOST_ASIDE,
            radius,
        )
        parent = nodes.links[here, PARENT]
        if not _line_is_free(space, gates, nodes.places, parent, here, radius) and not _settle(
            space, gates, nodes, norm, lattice, here, moves, radius
        ):
            continue
        nodes.links[here, STATE] = SETTLED
        _spread(space, gates, nodes, norm, lattice, here, moves, radius, weight, bound)
        if _sees_goal(space, gates, nodes, lattice, here, radius):
            _reach(nodes, gates, norm, weight, bound, _GOAL, here)
    return new_floats(0, 3), expanded
