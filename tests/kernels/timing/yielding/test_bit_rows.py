"""Sets of places as bits."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.kernels.arrays import Flags
from viaspline.kernels.jit import kernel
from viaspline.kernels.timing.yielding.bit_rows import (
    Words,
    add_places,
    has_place,
    remove_places,
)

WORDS = 3
RUNS = st.lists(
    st.tuples(st.booleans(), st.integers(-70, 64 * WORDS + 70), st.integers(-5, 200)), max_size=8
)


@kernel
def add(rows: Words, first: int, last: int) -> None:
    add_places(rows, 0, first, last)


@kernel
def remove(rows: Words, first: int, last: int) -> None:
    remove_places(rows, 0, first, last)


@kernel
def members(words: Words) -> Flags:
    found = np.zeros(64 * words.size, np.bool_)
    for place in range(found.size):
        found[place] = has_place(words, place)
    return found


@given(RUNS)
def test_runs_are_added_and_removed_as_in_a_row_of_flags(runs: list[tuple[bool, int, int]]) -> None:
    rows = np.zeros((1, WORDS), np.uint64)
    flags = np.zeros(64 * WORDS, bool)
    for is_added, first, length in runs:
        (add if is_added else remove)(rows, first, first + length)
        flags[max(first, 0) : max(first + length + 1, 0)] = is_added
    assert (members(rows[0]) == flags).all()
