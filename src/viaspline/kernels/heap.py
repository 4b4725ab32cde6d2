"""A heap of numbered items, the least key on top."""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined


class Heap(NamedTuple):
    """A binary heap.

    Attributes:
        keys: (n,).
        items: (n,).
        size: How many there are, (1,).
    """

    keys: Floats
    items: Ints
    size: Ints


@inlined
def push(heap: Heap, key: float, item: int) -> None:
    """Add an item; there has to be room for it."""
    k = heap.size[0]
    while k > 0:
        parent = (k - 1) >> 1
        if heap.keys[parent] <= key:
            break
        heap.keys[k] = heap.keys[parent]
        heap.items[k] = heap.items[parent]
        k = parent
    heap.keys[k] = key
    heap.items[k] = item
    heap.size[0] += 1


@inlined
def pop(heap: Heap) -> int:
    """Take the item with the least key away; there has to be one."""
    top = heap.items[0]
    heap.size[0] -= 1
    size = heap.size[0]
    key = heap.keys[size]
    k = 0
    while True:
        child = 2 * k + 1
        if child >= size:
            break
        if child + 1 < size and heap.keys[child + 1] < heap.keys[child]:
            child += 1
        if heap.keys[child] >= key:
            break
        heap.keys[k] = heap.keys[child]
        heap.items[k] = heap.items[child]
        k = child
    heap.keys[k] = key
    heap.items[k] = heap.items[size]
    return top
