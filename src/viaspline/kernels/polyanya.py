"""Shortest paths through a mesh of rectangles: Polyanya.

Michael Cui, Daniel Harabor, Alban Grastien: "Compromise-free Pathfinding on a Navigation Mesh",
IJCAI 2017. A* over intervals: a node is the part [a, b] of a portal that is seen from its root, the
last place where the path turned. The path that it finds is the shortest of all in the mesh.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.jit import inner, kernel, within
from viaspline.kernels.mesh import (
    BOTTOM,
    FIRST_ABOVE,
    FIRST_BELOW,
    HEIGHT,
    LEFT,
    OVER,
    PIECE,
    RIGHT,
    TOP,
    TURN_LEFT,
    UNDER,
    Mesh,
    rectangle_at,
)
from viaspline.kernels.packed import Floats, Ints
from viaspline.kernels.rows import new_floats, new_ints, sized_floats, sized_ints

TINY = 1e-9
# columns of the two tables of nodes
A, B, ROOT_X, ROOT_Y, COST = range(5)
PORTAL, UP, ROOT, PARENT = range(4)
START = -1  # the root before the first turn
GOAL = -2  # in place of the portal: the path has arrived


class Search(NamedTuple):
    """Nodes, and a heap of those that have not been expanded.

    A root is a portal's end: ``2 * portal`` for the left one, ``2 * portal + 1`` for the right.

    Attributes:
        places: The interval, the root, and the length of the path up to it, (n, 5).
        links: The portal, whether the path goes up through it, the root, the node before, (n, 4).
        keys: The heap's keys: how long a path through the node is at least, (n, 1).
        items: The heap's nodes, (n, 1).
        sizes: How many nodes there are, and how many of them are in the heap, (1, 2).
        cheapest: Length of the shortest path yet to each root, (2 p, 1).
        goal: (2,).
    """

    places: Floats
    links: Ints
    keys: Floats
    items: Ints
    sizes: Ints
    cheapest: Floats
    goal: Floats


@within
def _push(search: Search, key: float, item: int) -> None:
    k = search.sizes[0, 1]
    while k > 0:
        parent = (k - 1) >> 1
        if search.keys[parent, 0] <= key:
            break
        search.keys[k, 0] = search.keys[parent, 0]
        search.items[k, 0] = search.items[parent, 0]
        k = parent
    search.keys[k, 0] = key
    search.items[k, 0] = item
    search.sizes[0, 1] += 1


@within
def _pop(search: Search) -> int:
    """Take the node with the smallest key; -1 where there is none."""
    size = search.sizes[0, 1] - 1
    if size < 0:
        return -1
    first = search.items[0, 0]
    key = search.keys[size, 0]
    item = search.items[size, 0]
    k = 0
    while True:
        child = 2 * k + 1
        if child >= size:
            break
        if child + 1 < size and search.keys[child + 1, 0] < search.keys[child, 0]:
            child += 1
        if search.keys[child, 0] >= key:
            break
        search.keys[k, 0] = search.keys[child, 0]
        search.items[k, 0] = search.items[child, 0]
        k = child
    search.keys[k, 0] = key
    search.items[k, 0] = item
    search.sizes[0, 1] = size
    return first


@within
def _next(search: Search) -> int:
    """The next node that no shorter path to its root has made worthless; -1 where none is left."""
    while True:
        node = _pop(search)
        if node < 0:
            return -1
        root = search.links[node, ROOT]
        if root == START or search.places[node, COST] <= search.cheapest[root, 0] + TINY:
            return node


@within
def _crossing(
    rx: float, ry: float, a: float, b: float, y: float, gx: float, gy: float
) -> tuple[float, float]:
    """Where the shortest way from a root through [a, b] at y to the goal crosses, and its length.

    A goal on the root's side is mirrored: a path that has to go through the interval and come
    back is as long as one to its image.
    """
    if (gy < y) == (ry < y) and gy != y and ry != y:
        gy = 2.0 * y - gy
    elif ry == y and gy == y:
        x = min(max(rx, a), b)
        return x, abs(x - rx) + abs(gx - x)
    x = rx + (gx - rx) * (y - ry) / (gy - ry) if gy != ry else rx
    x = min(max(x, a), b)
    return x, math.hypot(x - rx, y - ry) + math.hypot(gx - x, gy - y)


@within
def _add(
    search: Search,
    portal: int,
    up: int,
    a: float,
    b: float,
    x: float,
    y: float,
    cost: float,
    root: int,
    parent: int,
) -> int:
    """A new node, which is not in the heap yet; returns its number."""
    count = search.sizes[0, 0]
    search.sizes[0, 0] += 1
    search.places[count, A] = a
    search.places[count, B] = b
    search.places[count, ROOT_X] = x
    search.places[count, ROOT_Y] = y
    search.places[count, COST] = cost
    search.links[count, PORTAL] = portal
    search.links[count, UP] = up
    search.links[count, ROOT] = root
    search.links[count, PARENT] = parent
    return count


@within
def _first_door(portals: Ints, first: int, last: int, low: float) -> int:
    """The first of the portals first:last, which stand from left to right, beyond ``low``."""
    while last - first > 8:
        middle = (first + last) >> 1
        if portals[middle, RIGHT] <= low + TINY:
            first = middle + 1
        else:
            last = middle
    while first < last and portals[first, RIGHT] <= low + TINY:
        first += 1
    return first


@within
def _spread(
    mesh: Mesh,
    search: Search,
    room: int,
    parent: int,
    up: int,
    low: float,
    high: float,
    x: float,
    y: float,
    cost: float,
    root: int,
) -> None:
    """Add a node for every portal of a side of a rectangle that is seen in [low, high].

    Args:
        mesh: Mesh.
        search: What is added to.
        room: The rectangle.
        parent: The node that is expanded, -1 at the start.
        up: 1 for the upper side, 0 for the lower one.
        low: [cells].
        high: [cells].
        x: Of the root from which the window is seen.
        y: The same.
        cost: Length of the path to the root.
        root: The root.
    """
    if high - low <= TINY:
        return
    side = FIRST_ABOVE if up == 1 else FIRST_BELOW
    last = mesh.doors[room, side + 1]
    door = _first_door(mesh.portals, mesh.doors[room, side], last, low)
    behind = search.links[parent, PORTAL] if parent >= 0 else -1
    far = float(mesh.rectangles[room, TOP if up == 1 else BOTTOM])
    while door < last and mesh.portals[door, LEFT] < high - TINY:
        # where the window ends within rounding of the portal's end it is that end: paths turn there
        a = float(mesh.portals[door, LEFT])
        a = low if low > a + TINY else a
        b = float(mesh.portals[door, RIGHT])
        b = high if high < b - TINY else b
        if door != behind:
            if far == y and not a <= x <= b:
                _slide(search, door, parent, up, a, b, x, y, cost, root)
            else:
                node = _add(search, door, up, a, b, x, y, cost, root, parent)
                _, rest = _crossing(x, y, a, b, far, search.goal[0], search.goal[1])
                _push(search, cost + rest, node)
        door += 1


@within
def _slide(
    search: Search,
    door: int,
    parent: int,
    up: int,
    a: float,
    b: float,
    x: float,
    y: float,
    cost: float,
    root: int,
) -> None:
    """Add a node for a portal on the root's own line: along the wall to its end, and round it.

    The path turns twice at once. The first turn gets a node of its own.
    """
    end = a if x < a else b
    turned = 2 * door if x < a else 2 * door + 1
    cost_there = cost + abs(end - x)
    if cost_there > search.cheapest[turned, 0] + TINY:
        return
    search.cheapest[turned, 0] = cost_there
    first = _add(search, door, up, a, b, x, y, cost, root, parent)
    node = _add(search, door, up, a, b, end, y, cost_there, turned, first)
    _, rest = _crossing(end, y, a, b, y, search.goal[0], search.goal[1])
    _push(search, cost_there + rest, node)


@within
def _turn(
    mesh: Mesh, search: Search, here: int, room: int, end: int, seen: float, near: float
) -> None:
    """Turn at the left (0) or the right (1) end of a node's interval, if the path can.

    Args:
        mesh: Mesh.
        search: What is added to.
        here: The node.
        room: The rectangle that it leads into.
        end: 0 or 1.
        seen: As far as the far side of the rectangle is seen past this end without a turn.
        near: Height of the portal.
    """
    portal = search.links[here, PORTAL]
    up = search.links[here, UP]
    x = search.places[here, A + end]
    if x != mesh.portals[portal, LEFT + end] or mesh.portals[portal, TURN_LEFT + end] == 0:
        return
    root = 2 * portal + end
    cost = search.places[here, COST] + math.hypot(
        x - search.places[here, ROOT_X], near - search.places[here, ROOT_Y]
    )
    if cost > search.cheapest[root, 0] + TINY:
        return
    search.cheapest[root, 0] = cost
    left = float(mesh.rectangles[room, LEFT])
    right = float(mesh.rectangles[room, RIGHT])
    for back in range(2):  # what is hidden on the far side, then back through the near side
        limit = x if back == 1 else min(max(seen, left), right)
        low = left if end == 0 else limit
        high = limit if end == 0 else right
        _spread(mesh, search, room, here, abs(up - back), low, high, x, near, cost, root)


@within
def _expand(mesh: Mesh, search: Search, here: int, last_room: int) -> None:
    """Add what a node leads to."""
    portal = search.links[here, PORTAL]
    up = search.links[here, UP]
    room = mesh.portals[portal, OVER if up == 1 else UNDER]
    a = search.places[here, A]
    b = search.places[here, B]
    x = search.places[here, ROOT_X]
    y = search.places[here, ROOT_Y]
    near = float(mesh.portals[portal, HEIGHT])
    if room == last_room:
        at, rest = _crossing(x, y, a, b, near, search.goal[0], search.goal[1])
        root = search.links[here, ROOT]
        node = _add(search, GOAL, up, at, at, x, y, search.places[here, COST], root, here)
        _push(search, search.places[here, COST] + rest, node)
    # the far side as the root sees it through the interval
    low = left = float(mesh.rectangles[room, LEFT])
    high = right = float(mesh.rectangles[room, RIGHT])
    if y != near:
        far = float(mesh.rectangles[room, TOP if up == 1 else BOTTOM])
        low = x + (a - x) * (far - y) / (near - y)
        high = x + (b - x) * (far - y) / (near - y)
    _spread(
        mesh, search, room, here, up, max(low, left), min(high, right),
        x, y, search.places[here, COST], search.links[here, ROOT],
    )  # fmt: skip
    for end in range(2):
        _turn(mesh, search, here, room, end, low if end == 0 else high, near)


@within
def _doors_of(mesh: Mesh, room: int) -> int:
    """How many portals a rectangle has."""
    below = mesh.doors[room, FIRST_BELOW + 1] - mesh.doors[room, FIRST_BELOW]
    return below + mesh.doors[room, FIRST_ABOVE + 1] - mesh.doors[room, FIRST_ABOVE]


@within
def _most_after(mesh: Mesh, search: Search, here: int) -> int:
    """How many nodes there are at most when a node has been expanded."""
    portal = search.links[here, PORTAL]
    room = mesh.portals[portal, OVER if search.links[here, UP] == 1 else UNDER]
    return search.sizes[0, 0] + 1 + 6 * _doors_of(mesh, room)


@inner
def _sized(search: Search, room: int) -> Search:
    """The same with room for that many nodes."""
    count = search.sizes[0, 0]
    return Search(
        sized_floats(search.places, count, room),
        sized_ints(search.links, count, room),
        sized_floats(search.keys, search.sizes[0, 1], room),
        sized_ints(search.items, search.sizes[0, 1], room),
        search.sizes,
        search.cheapest,
        search.goal,
    )


@inner
def _begun(mesh: Mesh, start: Floats, goal: Floats, room: int) -> Search:
    """A search with what is seen from the start."""
    cheapest = new_floats(2 * mesh.portals.shape[0], 1)
    for k in range(cheapest.shape[0]):
        cheapest[k, 0] = np.inf
    size = 1024 + 2 * mesh.portals.shape[0]
    search = Search(
        new_floats(size, 5),
        new_ints(size, 4),
        new_floats(size, 1),
        new_ints(size, 1),
        new_ints(1, 2),
        cheapest,
        goal,
    )
    search.sizes[0, 0] = 0
    search.sizes[0, 1] = 0
    left = float(mesh.rectangles[room, LEFT])
    right = float(mesh.rectangles[room, RIGHT])
    for up in range(2):
        _spread(mesh, search, room, -1, up, left, right, start[0], start[1], 0.0, START)
    return search


@kernel
def shortest_path(mesh: Mesh, start: Floats, goal: Floats) -> Floats:
    """The shortest path between two places of a mesh.

    Args:
        mesh: Mesh.
        start: (2,) [cells].
        goal: (2,) [cells].

    Returns:
        Start, the corners where it turns, goal, (k, 2) [cells]; no rows where there is no path.
    """
    room = rectangle_at(mesh, start[0], start[1])
    last_room = rectangle_at(mesh, goal[0], goal[1])
    if room < 0 or last_room < 0:
        return new_floats(0, 2)
    if mesh.rectangles[room, PIECE] != mesh.rectangles[last_room, PIECE]:
        return new_floats(0, 2)
    if room == last_room:
        return _path(new_floats(0, 2), 0, start, goal)
    search = _begun(mesh, start, goal, room)
    here = _next(search)
    while here >= 0 and search.links[here, PORTAL] != GOAL:
        most = _most_after(mesh, search, here)
        if most > search.places.shape[0]:
            search = _sized(search, 2 * most)
        _expand(mesh, search, here, last_room)
        here = _next(search)
    turns, count = _turns(mesh, search, here)
    return _path(turns, count, start, goal)


@inner
def _turns(mesh: Mesh, search: Search, last: int) -> tuple[Floats, int]:
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
def _path(turns: Floats, count: int, start: Floats, goal: Floats) -> Floats:
    """Start, turns in their order, goal, (count + 2, 2)."""
    path = new_floats(count + 2, 2)
    for axis in range(2):
        path[0, axis] = start[axis]
        path[count + 1, axis] = goal[axis]
        for k in range(count):
            path[count - k, axis] = turns[k, axis]
    return path
