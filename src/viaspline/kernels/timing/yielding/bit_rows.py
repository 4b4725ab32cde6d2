"""Rows of bits, 64 a word: sets of places, bit p for place p.

Tested through ``kernels/timing/yielding/test_bit_rows``.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.jit import inlined

Words: TypeAlias = NDArray[np.uint64]
"""Sets of places."""

ALL = np.uint64(0xFFFFFFFFFFFFFFFF)
NONE = np.uint64(0)
ONE = np.uint64(1)


@inlined
def add_places(rows: Words, row: int, first: int, last: int) -> None:
    """Add places first to last to a row of (n, w), as far as it has them."""
    first = max(first, 0)
    last = min(last, 64 * rows.shape[1] - 1)
    if first > last:
        return
    a = first >> 6
    b = last >> 6
    head = ALL << np.uint64(first & 63)
    tail = ALL >> np.uint64(63 - (last & 63))
    if a == b:
        rows[row, a] |= head & tail
        return
    rows[row, a] |= head
    for w in range(a + 1, b):
        rows[row, w] = ALL
    rows[row, b] |= tail


@inlined
def remove_places(rows: Words, row: int, first: int, last: int) -> None:
    """Take places first to last off a row of (n, w)."""
    first = max(first, 0)
    last = min(last, 64 * rows.shape[1] - 1)
    if first > last:
        return
    a = first >> 6
    b = last >> 6
    head = ALL << np.uint64(first & 63)
    tail = ALL >> np.uint64(63 - (last & 63))
    if a == b:
        rows[row, a] &= ~(head & tail)
        return
    rows[row, a] &= ~head
    for w in range(a + 1, b):
        rows[row, w] = NONE
    rows[row, b] &= ~tail


@inlined
def has_place(words: Words, place: int) -> bool:
    """Whether a row (w,) has a place."""
    if place < 0 or place >= 64 * words.shape[0]:
        return False
    return (words[place >> 6] >> np.uint64(place & 63)) & ONE != NONE
