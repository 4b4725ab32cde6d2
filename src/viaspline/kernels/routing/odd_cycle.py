"""The first link of a row that closes a cycle of odd parity."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Bytes, Ints
from viaspline.kernels.jit import inner, kernel


@inner
def _lift(parent: Ints, parity: Bytes, node: int) -> int:
    """The root of a node's tree; its whole way there is made one step, with the parity of it."""
    root = node
    odd = 0
    while parent[root] != root:
        odd ^= parity[root]
        root = parent[root]
    while parent[node] != root and node != root:
        above = parent[node]
        before = parity[node]
        parent[node] = root
        parity[node] = odd
        odd ^= before
        node = above
    return root


@kernel
def first_odd_cycle(first: Ints, second: Ints, parity: Bytes, count: int) -> int:
    """The first link with which the links up to it hold a cycle of odd parity.

    Union-find, each node with the parity of the way to its root.

    Args:
        first: Node at one end of each link, (k,).
        second: Node at the other end, (k,).
        parity: 1 where a link is odd, else 0, (k,).
        count: Of the nodes.

    Returns:
        The link's number; -1 where all cycles are even.
    """
    parent = np.arange(count)
    to_root = np.zeros(count, np.uint8)
    for link in range(first.size):
        a = _lift(parent, to_root, first[link])
        b = _lift(parent, to_root, second[link])
        odd = to_root[first[link]] ^ to_root[second[link]] ^ parity[link]
        if a != b:
            parent[b] = a
            to_root[b] = odd
        elif odd != 0:
            return link
    return -1
