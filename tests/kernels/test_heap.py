"""The heap, and tables that grow, against Python's own."""

import heapq

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.heap import Heap, pop, push
from viaspline.kernels.jit import kernel

keys = st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=60)


@kernel
def emptied(given_keys: Floats) -> Ints:
    """All items pushed, then all popped."""
    count = given_keys.size
    heap = Heap(np.empty(count), np.empty(count, np.int64), np.zeros(1, np.int64))
    for item in range(count):
        push(heap, given_keys[item], item)
    found = np.empty(count, np.int64)
    for k in range(count):
        found[k] = pop(heap)
    return found


@given(keys)
def test_items_come_out_by_their_keys(given_keys: list[float]) -> None:
    found = emptied(np.array(given_keys))
    assert sorted(found.tolist()) == list(range(len(given_keys)))
    expected = list(given_keys)
    heapq.heapify(expected)
    assert [given_keys[item] for item in found] == [heapq.heappop(expected) for _ in given_keys]
