"""Shortest paths through a mesh of rectangles: Polyanya.

Michael Cui, Daniel Harabor, Alban Grastien: "Compromise-free Pathfinding on a Navigation Mesh",
IJCAI 2017. A* over intervals: a node is the part [a, b] of a portal that is seen from its root, the
last place where the path turned. The path that it finds is the shortest of all in the mesh.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Bytes, Floats, Ints
from viaspline.kernels.growable import new_bytes, new_floats, new_ints, sized_floats, sized_ints
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.routing.navmesh.polyanya_nodes import (
    GOAL,
    PARENT,
    PORTAL,
    ROOT,
    ROOT_X,
    ROOT_Y,
    START,
    UP,
    A,
    PolyanyaSearch,
    next_node,
    sized,
)
from viaspline.kernels.routing.navmesh.polyanya_successors import expand, spread_interval
from viaspline.kernels.routing.navmesh.rectangles import (
    BOTTOM,
    FIRST_ABOVE,
    FIRST_BELOW,
    HEIGHT,
    LEFT,
    OVER,
    PIECE,
    RIGHT,
    UNDER,
    Mesh,
    rectangle_at,
)


@inlined
def _doors_of(mesh: Mesh, room: int) -> int:
    """How many portals a rectangle has."""
    below = mesh.doors[room, FIRST_BELOW + 1] - mesh.doors[room, FIRST_BELOW]
    return below + mesh.doors[room, FIRST_ABOVE + 1] - mesh.doors[room, FIRST_ABOVE]


@inlined
def _most_after(mesh: Mesh, search: PolyanyaSearch, here: int) -> int:
    """How many nodes there are at most when a node has been expanded."""
    portal = search.links[here, PORTAL]
    room = mesh.portals[portal, OVER if search.links[here, UP] == 1 else UNDER]
    return search.sizes[0, 0] + 1 + 6 * _doors_of(mesh, room)


@inlined
def _way_on(mesh: Mesh, closed: Bytes, room: int) -> int:
    """A rectangle next to one that is not closed; -1 where there is none."""
    for up in range(2):
        for door in range(
            mesh.doors[room, FIRST_ABOVE if up == 1 else FIRST_BELOW],
            mesh.doors[room, FIRST_ABOVE + 1 if up == 1 else FIRST_BELOW + 1],
        ):
            other = mesh.portals[door, OVER if up == 1 else UNDER]
            if closed[other] == 0:
                return other
    return -1


@inner
def _dead_ends(mesh: Mesh, room: int, last_room: int) -> Bytes:
    """1 for rectangles out of which a path between two others comes only where it went in, (r,)."""
    count = mesh.rectangles.shape[0]
    closed = new_bytes(count)
    ways = new_ints(count, 1)
    for r in range(count):
        closed[r] = 0
        ways[r, 0] = _doors_of(mesh, r)
    for end in range(2):
        ways[room if end == 0 else last_room, 0] += 2  # never closed
    for r in range(count):
        here = r
        while here >= 0 and ways[here, 0] == 1 and closed[here] == 0:
            closed[here] = 1
            here = _way_on(mesh, closed, here)
            if here >= 0:
                ways[here, 0] -= 1
    return closed


@inner
def _begun(mesh: Mesh, start: Floats, goal: Floats, room: int, last_room: int) -> PolyanyaSearch:
    """A search with what is seen from the start."""
    cheapest = new_floats(2 * mesh.portals.shape[0], 1)
    for k in range(cheapest.shape[0]):
        cheapest[k, 0] = np.inf
    size = 1024 + 2 * mesh.portals.shape[0]
    search = PolyanyaSearch(
        new_floats(size, 5),
        new_ints(size, 4),
        new_floats(size + 1, 1),
        new_ints(size + 1, 1),
        new_ints(1, 2),
        _dead_ends(mesh, room, last_room),
        cheapest,
        goal,
    )
    search.items[size, 0] = -1
    search.sizes[0, 0] = 0
    search.sizes[0, 1] = 0
    left = float(mesh.rectangles[room, LEFT])
    right = float(mesh.rectangles[room, RIGHT])
    for up in range(2):
        spread_interval(mesh, search, room, -1, up, left, right, start[0], start[1], 0.0, START)
    return search


@kernel
def shortest_path(mesh: Mesh, start: Floats, goal: Floats) -> tuple[Floats, Floats]:
    """The shortest path between two places of a mesh, and one through the middles of cells.

    The other path goes through the same portals in the same order, so that one can be bent into
    the other. It is nowhere nearer than half a cell to what is blocked, but in the cells of start
    and goal.

    Args:
        mesh: Mesh.
        start: (2,) [cells].
        goal: (2,) [cells].

    Returns:
        (start, the corners where the shortest path turns, goal, (k, 2); start, middles of cells,
        goal, (m, 2)) [cells]; no rows where there is no path.
    """
    room = rectangle_at(mesh, start[0], start[1])
    last_room = rectangle_at(mesh, goal[0], goal[1])
    if room < 0 or last_room < 0:
        return new_floats(0, 2), new_floats(0, 2)
    if mesh.rectangles[room, PIECE] != mesh.rectangles[last_room, PIECE]:
        return new_floats(0, 2), new_floats(0, 2)
    if room == last_room:
        chain = new_ints(0, 2)
        path = _path(new_floats(0, 2), 0, start, goal)
        return path, _middles(mesh, chain, 0, room, room, start, goal)
    search = _begun(mesh, start, goal, room, last_room)
    here = next_node(search)
    while here >= 0 and search.links[here, PORTAL] != GOAL:
        most = _most_after(mesh, search, here)
        if most > search.places.shape[0]:
            search = sized(search, 2 * most)
        expand(mesh, search, here, last_room)
        here = next_node(search)
    turns, count = _turns(mesh, search, here)
    chain, size = _chain(search, here)
    middles = _middles(mesh, chain, size, room, last_room, start, goal)
    return _path(turns, count, start, goal), middles


@inner
def _turns(mesh: Mesh, search: PolyanyaSearch, last: int) -> tuple[Floats, int]:
    """Where the path to the last node turns, from its end to its start, and how often."""
    gx = search.goal[0]
    gy = search.goal[1]
    turns = new_floats(16, 2)
    count = 0
    # the last turn may be at an end of the last interval
    at = search.places[last]
    x = at[A]
    y = float(mesh.portals[search.links[search.links[last, PARENT], PORTAL], HEIGHT])
    area = (x - at[ROOT_X]) * (gy - y) - (y - at[ROOT_Y]) * (gx - x)
    if abs(area) > 1e-7 * (abs(gx - x) + abs(gy - y) + 1.0):
        turns[0, 0] = x
        turns[0, 1] = y
        count = 1
    node = last
    while node >= 0 and search.links[node, ROOT] != START:
        x = search.places[node, ROOT_X]
        y = search.places[node, ROOT_Y]
        if count == turns.shape[0]:
            turns = sized_floats(turns, count, 2 * count)
        if count == 0 or x != turns[count - 1, 0] or y != turns[count - 1, 1]:
            turns[count, 0] = x
            turns[count, 1] = y
            count += 1
        node = search.links[node, PARENT]
    return turns, count


@inner
def _chain(search: PolyanyaSearch, last: int) -> tuple[Ints, int]:
    """The portals of the path to the last node and whether it goes up, from its end to its start.

    A turn on a portal's own line has two nodes for the one portal.
    """
    chain = new_ints(16, 2)
    count = 0
    node = search.links[last, PARENT]
    while node >= 0:
        portal = search.links[node, PORTAL]
        if count == 0 or chain[count - 1, 0] != portal:
            if count == chain.shape[0]:
                chain = sized_ints(chain, count, 2 * count)
            chain[count, 0] = portal
            chain[count, 1] = search.links[node, UP]
            count += 1
        node = search.links[node, PARENT]
    return chain, count


@inlined
def _middle_in(mesh: Mesh, room: int, place: float, low: int) -> float:
    """The middle of the cell of a rectangle that holds a coordinate, or the next one to it."""
    first = mesh.rectangles[room, low] + 0.5
    last = mesh.rectangles[room, low + 1] - 0.5
    return min(max(math.floor(place) + 0.5, first), last)


@inner
def _middles(
    mesh: Mesh, chain: Ints, count: int, room: int, last_room: int, start: Floats, goal: Floats
) -> Floats:
    """A path through the middles of the cells on both sides of every portal of a chain."""
    path = new_floats(2 * count + 4, 2)
    for axis in range(2):
        path[0, axis] = start[axis]
        path[1, axis] = _middle_in(mesh, room, start[axis], LEFT if axis == 0 else BOTTOM)
    for k in range(count):
        portal = chain[count - 1 - k, 0]
        first = mesh.portals[portal, LEFT] + 0.5
        last = mesh.portals[portal, RIGHT] - 0.5
        x = min(max(path[2 * k + 1, 0], first), last)
        sense = 1.0 if chain[count - 1 - k, 1] == 1 else -1.0
        for side in range(2):
            path[2 * k + 2 + side, 0] = x
            path[2 * k + 2 + side, 1] = mesh.portals[portal, HEIGHT] + (side - 0.5) * sense
    end = 2 * count + 2
    for axis in range(2):
        path[end, axis] = _middle_in(mesh, last_room, goal[axis], LEFT if axis == 0 else BOTTOM)
        path[end + 1, axis] = goal[axis]
    return path


@inner
def _path(turns: Floats, count: int, start: Floats, goal: Floats) -> Floats:
    """Start, turns in their order, goal, (count + 2, 2)."""
    path = new_floats(count + 2, 2)
    for axis in range(2):
        path[0, axis] = start[axis]
        path[count + 1, axis] = goal[axis]
        for k in range(count):
            path[count - k, axis] = turns[k, axis]
    return path
