"""What a node of Polyanya's search leads to: portals that are seen from it, and turns.

Tested through ``kernels/routing/navmesh/test_polyanya``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Ints
from viaspline.kernels.jit import inlined
from viaspline.kernels.routing.navmesh.polyanya_nodes import (
    COST,
    GOAL,
    PORTAL,
    ROOT,
    ROOT_X,
    ROOT_Y,
    SAME_PLACE_CELLS,
    UP,
    A,
    B,
    PolyanyaSearch,
    add,
    push,
)
from viaspline.kernels.routing.navmesh.rectangles import (
    BOTTOM,
    FIRST_ABOVE,
    FIRST_BELOW,
    HEIGHT,
    LEFT,
    OVER,
    RIGHT,
    TOP,
    TURN_LEFT,
    UNDER,
    Mesh,
)


@inlined
def _apart(dx: float, dy: float) -> float:
    """Length in cells: neither so many nor so few that squares overflow, as ``hypot`` minds."""
    return math.sqrt(dx * dx + dy * dy)


@inlined
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
    return x, _apart(x - rx, y - ry) + _apart(gx - x, gy - y)


@inlined
def _first_door(portals: Ints, first: int, last: int, low: float) -> int:
    """The first of the portals first:last, which stand from left to right, beyond ``low``."""
    while last - first > 8:
        middle = (first + last) >> 1
        if portals[middle, RIGHT] <= low + SAME_PLACE_CELLS:
            first = middle + 1
        else:
            last = middle
    while first < last and portals[first, RIGHT] <= low + SAME_PLACE_CELLS:
        first += 1
    return first


@inlined
def spread_interval(
    mesh: Mesh,
    search: PolyanyaSearch,
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
    if high - low <= SAME_PLACE_CELLS:
        return
    side = FIRST_ABOVE if up == 1 else FIRST_BELOW
    last = mesh.doors[room, side + 1]
    door = _first_door(mesh.portals, mesh.doors[room, side], last, low)
    behind = search.links[parent, PORTAL] if parent >= 0 else -1
    far = float(mesh.rectangles[room, TOP if up == 1 else BOTTOM])
    while door < last and mesh.portals[door, LEFT] < high - SAME_PLACE_CELLS:
        # where the window ends within rounding of the portal's end it is that end: paths turn there
        a = float(mesh.portals[door, LEFT])
        a = low if low > a + SAME_PLACE_CELLS else a
        b = float(mesh.portals[door, RIGHT])
        b = high if high < b - SAME_PLACE_CELLS else b
        beyond = mesh.portals[door, OVER if up == 1 else UNDER]
        if door != behind and search.closed[beyond] == 0:
            if far == y and not a <= x <= b:
                _slide(search, door, parent, up, a, b, x, y, cost, root)
            else:
                node = add(search, door, up, a, b, x, y, cost, root, parent)
                _, rest = _crossing(x, y, a, b, far, search.goal[0], search.goal[1])
                push(search, cost + rest, node)
        door += 1


@inlined
def _slide(
    search: PolyanyaSearch,
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
    if cost_there > search.cheapest[turned, 0] + SAME_PLACE_CELLS:
        return
    search.cheapest[turned, 0] = cost_there
    first = add(search, door, up, a, b, x, y, cost, root, parent)
    node = add(search, door, up, a, b, end, y, cost_there, turned, first)
    _, rest = _crossing(end, y, a, b, y, search.goal[0], search.goal[1])
    push(search, cost_there + rest, node)


@inlined
def _turn(
    mesh: Mesh, search: PolyanyaSearch, here: int, room: int, end: int, seen: float, near: float
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
    cost = search.places[here, COST] + _apart(
        x - search.places[here, ROOT_X], near - search.places[here, ROOT_Y]
    )
    if cost > search.cheapest[root, 0] + SAME_PLACE_CELLS:
        return
    search.cheapest[root, 0] = cost
    left = float(mesh.rectangles[room, LEFT])
    right = float(mesh.rectangles[room, RIGHT])
    for back in range(2):  # what is hidden on the far side, then back through the near side
        limit = x if back == 1 else min(max(seen, left), right)
        low = left if end == 0 else limit
        high = limit if end == 0 else right
        spread_interval(mesh, search, room, here, abs(up - back), low, high, x, near, cost, root)


@inlined
def expand(mesh: Mesh, search: PolyanyaSearch, here: int, last_room: int) -> None:
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
        node = add(search, GOAL, up, at, at, x, y, search.places[here, COST], root, here)
        push(search, search.places[here, COST] + rest, node)
    # the far side as the root sees it through the interval
    low = left = float(mesh.rectangles[room, LEFT])
    high = right = float(mesh.rectangles[room, RIGHT])
    if y != near:
        far = float(mesh.rectangles[room, TOP if up == 1 else BOTTOM])
        low = x + (a - x) * (far - y) / (near - y)
        high = x + (b - x) * (far - y) / (near - y)
    spread_interval(
        mesh, search, room, here, up, max(low, left), min(high, right),
        x, y, search.places[here, COST], search.links[here, ROOT],
    )  # fmt: skip
    for end in range(2):
        _turn(mesh, search, here, room, end, low if end == 0 else high, near)
