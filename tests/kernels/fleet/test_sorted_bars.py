from __future__ import annotations

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from viaspline.kernels.fleet.sorted_bars import sorted_bars

BAR = st.tuples(*(st.integers(0, most) for most in (3, 3, 4, 3, 3)))


@given(st.lists(BAR, max_size=40))
@example([])
@example([(1, 0, 2, 3, 1), (0, 1, 2, 2, 0), (1, 0, 1, 3, 1), (1, 0, 1, 3, 0)])
def test_bars_are_sorted_as_numpy_sorts_them(bars: list[tuple[int, ...]]) -> None:
    table = np.array(bars, np.int64).reshape(-1, 5)
    who, where = np.ascontiguousarray(table[:, :3]), table[:, 3:].astype(np.float64)
    order = np.lexsort((where[:, 1], who[:, 2], where[:, 0], who[:, 0]))
    first, other, crossing, place, passed = sorted_bars(who, where, 4)
    assert first.tolist() == np.searchsorted(who[order, 0], np.arange(5)).tolist()
    assert np.array_equal(np.column_stack((other, crossing)), who[order, 1:])
    assert np.array_equal(np.column_stack((place, passed)), where[order])
