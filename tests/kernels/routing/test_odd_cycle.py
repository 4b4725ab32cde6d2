"""Odd cycles, held against a search of all cycles."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from viaspline.kernels.routing.odd_cycle import first_odd_cycle

COUNT = 8
links = st.lists(
    st.tuples(st.integers(0, COUNT - 1), st.integers(0, COUNT - 1), st.integers(0, 1)), max_size=20
)


def first_found(rows: list[tuple[int, int, int]]) -> int:
    first, second, parity = np.array(rows, np.int64).reshape(-1, 3).T
    ends = np.ascontiguousarray(first), np.ascontiguousarray(second)
    return int(first_odd_cycle(*ends, parity.astype(np.uint8), COUNT))


def has_odd_cycle(rows: list[tuple[int, int, int]]) -> bool:
    """Whether some node is joined with itself, where every node stands twice: even and odd."""
    pairs = [(a + COUNT * k, b + COUNT * (k ^ p)) for a, b, p in rows for k in (0, 1)]
    left, right = np.array(pairs).reshape(-1, 2).T
    graph = coo_array((np.ones(len(pairs)), (left, right)), shape=(2 * COUNT, 2 * COUNT))
    labels = connected_components(graph, directed=False)[1]
    return bool((labels[:COUNT] == labels[COUNT:]).any())


@pytest.mark.long_without_jit
@settings(max_examples=200)
@given(links)
@example([(0, 1, 1), (1, 2, 0), (2, 0, 1)])
@example([(3, 3, 1)])
def test_the_first_odd_cycle_is_closed_by_the_link_that_is_told(rows) -> None:
    last = first_found(rows)
    if last < 0:
        assert not rows or not has_odd_cycle(rows)
    else:
        assert has_odd_cycle(rows[: last + 1])
        assert last == 0 or not has_odd_cycle(rows[:last])


def test_long_rows_are_followed_to_their_roots() -> None:
    ring = [(k, (k + 1) % COUNT, int(k == 3)) for k in range(COUNT)]
    assert first_found(ring) == COUNT - 1
    assert first_found([(a, b, 0) for a, b, _ in ring]) == -1
