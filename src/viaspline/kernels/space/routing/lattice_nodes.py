"""The places of a lattice that a search has seen, in a hash table: memory goes with the search.

Tested through ``kernels/space/routing/test_lazy_theta``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.growable import new_floats, new_ints, sized_floats, sized_ints
from viaspline.kernels.heap import Heap
from viaspline.kernels.jit import inlined, inner

KEY, PARENT, STATE = range(3)
"""Columns of links: the place as a number (the start is -2, the goal -3), the node that a way comes
from, and whether its way is settled."""

OPEN, SETTLED, SHUT = range(3)

X, Y, Z, COST = range(4)
"""Columns of places: where a node is [m], and what the way to it costs."""

START_KEY, GOAL_KEY = -2, -3
_EMPTY = -1
MOST_ASIDE = 1 << 20
_SPARE = 64  # nodes and waiting items that one expansion may add


class LatticeNodes(NamedTuple):
    """Nodes of a search, the open ones among them in a heap.

    Attributes:
        places: (n, 4).
        links: (n, 3).
        slots: Where nodes are found by their keys: their numbers, or -1, (a power of two, 1).
        open: Those whose turn will come, the most promising on top.
        size: How many nodes there are, (1,).
    """

    places: Floats
    links: Ints
    slots: Ints
    open: Heap
    size: Ints


@inlined
def key_of(i: int, j: int, k: int) -> int:
    """A place of a lattice as a number."""
    return (i * MOST_ASIDE + j) * MOST_ASIDE + k


@inlined
def _slot_of(slots: Ints, key: int) -> int:
    """The slot in which a key stands, or would stand."""
    at = (key >> 40) * 73856093
    at ^= ((key >> 20) & (MOST_ASIDE - 1)) * 19349663
    at ^= (key & (MOST_ASIDE - 1)) * 83492791
    return (at ^ (at >> 15)) & (slots.shape[0] - 1)


@inlined
def found_node(nodes: LatticeNodes, key: int) -> int:
    """The node of a place, or -1."""
    at = _slot_of(nodes.slots, key)
    while True:
        node = nodes.slots[at, 0]
        if node == _EMPTY or nodes.links[node, KEY] == key:
            return node
        at = (at + 1) & (nodes.slots.shape[0] - 1)


@inlined
def added_node(nodes: LatticeNodes, key: int, x: float, y: float, z: float) -> int:
    """A further node, not reached yet; there has to be room for it."""
    node = nodes.size[0]
    nodes.size[0] = node + 1
    nodes.places[node, X] = x
    nodes.places[node, Y] = y
    nodes.places[node, Z] = z
    nodes.places[node, COST] = np.inf
    nodes.links[node, KEY] = key
    nodes.links[node, PARENT] = -1
    nodes.links[node, STATE] = OPEN
    at = _slot_of(nodes.slots, key)
    while nodes.slots[at, 0] != _EMPTY:
        at = (at + 1) & (nodes.slots.shape[0] - 1)
    nodes.slots[at, 0] = node
    return node


@inner
def no_nodes(room: int) -> LatticeNodes:
    """A search that has seen nothing, with room for a power of two of nodes."""
    heap = Heap(np.empty(2 * room), np.empty(2 * room, np.int64), np.zeros(1, np.int64))
    nodes = LatticeNodes(
        new_floats(room, 4),
        new_ints(room, 3),
        new_ints(2 * room, 1),
        heap,
        np.zeros(1, np.int64),
    )
    for at in range(2 * room):
        nodes.slots[at, 0] = _EMPTY
    return nodes


@inner
def _with_slots(nodes: LatticeNodes, room: int) -> LatticeNodes:
    """The nodes in tables for twice as many."""
    count = nodes.size[0]
    slots = new_ints(2 * room, 1)
    for at in range(2 * room):
        slots[at, 0] = _EMPTY
    for node in range(count):
        at = _slot_of(slots, nodes.links[node, KEY])
        while slots[at, 0] != _EMPTY:
            at = (at + 1) & (2 * room - 1)
        slots[at, 0] = node
    places = sized_floats(nodes.places, count, room)
    links = sized_ints(nodes.links, count, room)
    return LatticeNodes(places, links, slots, nodes.open, nodes.size)


@inner
def _with_longer_heap(nodes: LatticeNodes) -> LatticeNodes:
    """The nodes with room for twice as many that wait."""
    heap = nodes.open
    room = 2 * heap.keys.size
    keys = np.empty(room)
    items = np.empty(room, np.int64)
    for at in range(heap.size[0]):
        keys[at] = heap.keys[at]
        items[at] = heap.items[at]
    heap = Heap(keys, items, heap.size)
    return LatticeNodes(nodes.places, nodes.links, nodes.slots, heap, nodes.size)


@inner
def with_room(nodes: LatticeNodes) -> LatticeNodes:
    """The nodes with room for those of one more expansion."""
    if nodes.size[0] + _SPARE > nodes.places.shape[0]:
        nodes = _with_slots(nodes, 2 * nodes.places.shape[0])
    if nodes.open.size[0] + _SPARE > nodes.open.keys.size:
        nodes = _with_longer_heap(nodes)
    return nodes
