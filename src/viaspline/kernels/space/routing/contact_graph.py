"""A way from contact to contact, among those solids alone that stand in the way.

A* on the complete graph of the places next to the solids met so far. Whether an edge is free is
looked at when its end is about to be settled; a solid that blocks one joins those met, with its
places. So of a thousand solids a dozen are looked at.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Bytes, Flags, Floats, Ints
from viaspline.kernels.growable import new_floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.routing.contact_nodes import add_contacts
from viaspline.kernels.space.routing.route_protocol import is_free
from viaspline.kernels.space.routing.side_gates import gates_allow
from viaspline.kernels.space.routing.travel_norm import travel_between
from viaspline.kernels.space.space_distance import space_segment

_START, _GOAL = 0, 1
_NEW, _SETTLED = 0, 1


class ContactGraph(NamedTuple):
    """Places where a way may turn, and what is known of the ways between them.

    Attributes:
        places: [m], (n, 3); the start, the goal, and contacts.
        costs: Of the way to each, and from it straight to the goal, (n, 2).
        parents: Where it comes from, (n,).
        settled: 1 where that is known, (n,).
        blocked: Ways that are known to be blocked, (n, n).
        met: Solids whose places are there, (solids,).
        bound: Only ways that cost less are of interest, (1,).
        size: How many places there are, (1,).
    """

    places: Floats
    costs: Floats
    parents: Ints
    settled: Bytes
    blocked: Flags
    met: Flags
    bound: Floats
    size: Ints


@inner
def _reach_anew(graph: ContactGraph, norm: Floats, here: int) -> None:
    """Let a place be reached from the best settled one that isn't known to be out of sight."""
    graph.costs[here, 0] = np.inf
    graph.parents[here] = -1
    for other in range(graph.size[0]):
        if graph.settled[other] == _SETTLED and not graph.blocked[other, here]:
            cost = graph.costs[other, 0] + travel_between(norm, graph.places, other, here)
            if cost < graph.costs[here, 0]:
                graph.costs[here, 0] = cost
                graph.parents[here] = other


@inner
def _keep_promising(graph: ContactGraph, norm: Floats, first: int) -> None:
    """Leave out places from one on through which every way costs the bound, or more."""
    kept = first
    for here in range(first, graph.size[0]):
        least = travel_between(norm, graph.places, _START, here)
        if least + travel_between(norm, graph.places, here, _GOAL) < graph.bound[0]:
            for axis in range(3):
                graph.places[kept, axis] = graph.places[here, axis]
            kept += 1
    graph.size[0] = kept


@inner
def _meet(space: PackedSpace, graph: ContactGraph, norm: Floats, radius: float, solid: int) -> None:
    """Let the places of a further solid join."""
    graph.met[solid] = True
    first = graph.size[0]
    add_contacts(space, solid, radius, graph.places, graph.places, graph.size)
    _keep_promising(graph, norm, first)
    for here in range(first, graph.size[0]):
        graph.settled[here] = _NEW
        graph.costs[here, 1] = travel_between(norm, graph.places, here, _GOAL)
        _reach_anew(graph, norm, here)


@inner
def _next(graph: ContactGraph) -> int:
    """The place whose turn it is; -1 where none is left that can be reached."""
    best = -1
    least = graph.bound[0]
    for here in range(graph.size[0]):
        if graph.settled[here] == _NEW:
            cost = graph.costs[here, 0] + graph.costs[here, 1]
            if cost < least:
                least = cost
                best = here
    return best


@inner
def _traced(graph: ContactGraph) -> Floats:
    count = 1
    here = _GOAL
    while here != _START:
        here = graph.parents[here]
        count += 1
    way = new_floats(count, 3)
    here = _GOAL
    for row in range(count - 1, -1, -1):
        for axis in range(3):
            way[row, axis] = graph.places[here, axis]
        here = graph.parents[here]
    return way


@inner
def _begun(
    space: PackedSpace, norm: Floats, start: Floats, goal: Floats, bound: float, room: int
) -> ContactGraph:
    graph = ContactGraph(
        np.empty((room, 3)),
        np.empty((room, 2)),
        np.empty(room, np.int64),
        np.zeros(room, np.uint8),
        np.zeros((room, room), np.bool_),
        np.zeros(space.kinds.size, np.bool_),
        np.empty(1),
        np.empty(1, np.int64),
    )
    for axis in range(3):
        graph.places[_START, axis] = start[axis]
        graph.places[_GOAL, axis] = goal[axis]
    graph.size[0] = 2
    graph.bound[0] = bound
    graph.settled[_START] = _SETTLED
    graph.costs[_START, 0] = 0.0
    graph.costs[_GOAL, 1] = 0.0
    graph.parents[_START] = _START
    _reach_anew(graph, norm, _GOAL)
    return graph


@inner
def _is_clear(
    space: PackedSpace, gates: Floats, norm: Floats, graph: ContactGraph, radius: float, here: int
) -> bool:
    """Whether the way to a place is free; a solid that isn't met yet and blocks it is met."""
    parent = graph.parents[here]
    x, y, z = graph.places[parent, 0], graph.places[parent, 1], graph.places[parent, 2]
    dx = graph.places[here, 0] - x
    dy = graph.places[here, 1] - y
    dz = graph.places[here, 2] - z
    if gates_allow(gates, x, y, z, dx, dy, dz) and is_free(space, x, y, z, dx, dy, dz, radius):
        return True
    graph.blocked[parent, here] = True
    graph.blocked[here, parent] = True
    distance, solid = space_segment(space, x, y, z, x + dx, y + dy, z + dz, radius)
    if distance < radius and 0 <= solid < space.kinds.size and not graph.met[solid]:
        _meet(space, graph, norm, radius, solid)
    return False


@kernel
def contact_way(
    space: PackedSpace,
    gates: Floats,
    norm: Floats,
    start: Floats,
    goal: Floats,
    radius: float,
    bound: float,
    room: int,
    most: int,
) -> tuple[Floats, int]:
    """A way between two places that turns next to solids.

    Args:
        space: What stands about.
        gates: See ``side_gates``, (g, 8).
        norm: See ``travel_norm``, (3,).
        start: [m], (3,).
        goal: [m], (3,).
        radius: To be kept from everything [m].
        bound: Only a way that costs less is of interest [m or s].
        room: For so many places.
        most: Lines to look at.

    Returns:
        (corners (k, 3), lines looked at): no corners where none was found.
    """
    graph = _begun(space, norm, start, goal, bound, room)
    looks = 0
    while looks < most:
        here = _next(graph)
        if here < 0:
            break
        looks += 1
        if not _is_clear(space, gates, norm, graph, radius, here):
            _reach_anew(graph, norm, here)
            continue
        if here == _GOAL:
            return _traced(graph), looks
        graph.settled[here] = _SETTLED
        for other in range(graph.size[0]):
            if graph.settled[other] == _NEW and not graph.blocked[here, other]:
                cost = graph.costs[here, 0] + travel_between(norm, graph.places, here, other)
                if cost < graph.costs[other, 0]:
                    graph.costs[other, 0] = cost
                    graph.parents[other] = here
    return new_floats(0, 3), looks
