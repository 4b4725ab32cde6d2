"""The nodes of Polyanya's search, and the heap of those that have not been expanded.

Tested through ``kernels/routing/navmesh/test_polyanya``.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Bytes, Floats, Ints
from viaspline.kernels.growable import sized_floats, sized_ints
from viaspline.kernels.jit import inlined, inner

SAME_PLACE_CELLS = 1e-9
# columns of the two tables of nodes
A, B, ROOT_X, ROOT_Y, COST = range(5)
PORTAL, UP, ROOT, PARENT = range(4)
START = -1  # the root before the first turn
GOAL = -2  # in place of the portal: the path has arrived


class PolyanyaSearch(NamedTuple):
    """Nodes, and a heap of those that have not been expanded.

    A root is a portal's end: ``2 * portal`` for the left one, ``2 * portal + 1`` for the right.

    Attributes:
        places: The interval, the root, and the length of the path up to it, (n, 5).
        links: The portal, whether the path goes up through it, the root, the node before, (n, 4).
        keys: The heap's keys: how long a path through the node is at least, (n, 1). The last row
            is that of the node that waits beside the heap.
        items: The heap's nodes, (n, 1); the last row as above, -1 where none waits.
        sizes: How many nodes there are, and how many of them are in the heap, (1, 2).
        closed: 1 for rectangles that are dead ends, else 0, (r,).
        cheapest: Length of the shortest path yet to each root, (2 p, 1).
        goal: (2,).
    """

    places: Floats
    links: Ints
    keys: Floats
    items: Ints
    sizes: Ints
    closed: Bytes
    cheapest: Floats
    goal: Floats


@inlined
def push(search: PolyanyaSearch, key: float, item: int) -> None:
    """Have a node expanded in its turn.

    The best of the last ones waits beside the heap: most often it is the next, and never gets in.
    """
    beside = search.items.shape[0] - 1
    other = search.items[beside, 0]
    if other < 0 or key < search.keys[beside, 0]:
        other_key = search.keys[beside, 0]
        search.keys[beside, 0] = key
        search.items[beside, 0] = item
        if other < 0:
            return
        key = other_key
        item = other
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


@inlined
def _sink(search: PolyanyaSearch, size: int, key: float, item: int) -> None:
    """Put a node into a heap of ``size`` whose first place is free."""
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


@inlined
def _pop(search: PolyanyaSearch) -> int:
    """Take the node with the smallest key; -1 where there is none."""
    beside = search.items.shape[0] - 1
    waiting = search.items[beside, 0]
    search.items[beside, 0] = -1
    size = search.sizes[0, 1]
    if size == 0 or (waiting >= 0 and search.keys[beside, 0] <= search.keys[0, 0]):
        return waiting
    first = search.items[0, 0]
    if waiting >= 0:
        _sink(search, size, search.keys[beside, 0], waiting)
        return first
    size -= 1
    search.sizes[0, 1] = size
    _sink(search, size, search.keys[size, 0], search.items[size, 0])
    return first


@inlined
def next_node(search: PolyanyaSearch) -> int:
    """The next node that no shorter path to its root has made worthless; -1 where none is left."""
    while True:
        node = _pop(search)
        if node < 0:
            return -1
        root = search.links[node, ROOT]
        if (
            root == START
            or search.places[node, COST] <= search.cheapest[root, 0] + SAME_PLACE_CELLS
        ):
            return node


@inlined
def add(
    search: PolyanyaSearch,
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


@inner
def sized(search: PolyanyaSearch, room: int) -> PolyanyaSearch:
    """The search with room for that many nodes."""
    count = search.sizes[0, 0]
    queued = search.sizes[0, 1]
    beside = search.items.shape[0] - 1
    keys = sized_floats(search.keys, queued, room + 1)
    items = sized_ints(search.items, queued, room + 1)
    keys[room, 0] = search.keys[beside, 0]
    items[room, 0] = search.items[beside, 0]
    return PolyanyaSearch(
        sized_floats(search.places, count, room),
        sized_ints(search.links, count, room),
        keys,
        items,
        search.sizes,
        search.closed,
        search.cheapest,
        search.goal,
    )
