"""Tables that grow. numba compiles ``np.empty`` anew for every kernel that calls it: here once.

Tested through ``kernels/routing/test_tangent_graph``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Bytes, Floats, Ints, Steps
from viaspline.kernels.jit import inner
from viaspline.kernels.large_pages import in_large_pages


@inner
def new_floats(count: int, columns: int) -> Floats:
    """Rows that are yet to be written."""
    table = np.empty((count, columns))
    in_large_pages(table)
    return table


@inner
def new_ints(count: int, columns: int) -> Ints:
    """Rows that are yet to be written."""
    table = np.empty((count, columns), np.int64)
    in_large_pages(table)
    return table


@inner
def new_steps(count: int, columns: int) -> Steps:
    """Rows that are yet to be written, of four bytes a number."""
    table = np.empty((count, columns), np.int32)
    in_large_pages(table)
    return table


@inner
def new_bytes(count: int) -> Bytes:
    """Numbers up to 255 that are yet to be written."""
    return np.empty(count, np.uint8)


@inner
def sized_floats(rows: Floats, count: int, room: int) -> Floats:
    """The first ``count`` rows in a table of its own with ``room`` of them."""
    other = new_floats(room, rows.shape[1])
    for i in range(count):
        for k in range(rows.shape[1]):
            other[i, k] = rows[i, k]
    return other


@inner
def sized_ints(rows: Ints, count: int, room: int) -> Ints:
    """The first ``count`` rows in a table of its own with ``room`` of them."""
    other = new_ints(room, rows.shape[1])
    for i in range(count):
        for k in range(rows.shape[1]):
            other[i, k] = rows[i, k]
    return other


@inner
def sized_steps(rows: Steps, count: int, room: int) -> Steps:
    """The first ``count`` rows in a table of its own with ``room`` of them."""
    other = new_steps(room, rows.shape[1])
    for i in range(count):
        for k in range(rows.shape[1]):
            other[i, k] = rows[i, k]
    return other
