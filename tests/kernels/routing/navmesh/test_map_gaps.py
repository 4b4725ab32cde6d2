from __future__ import annotations

import math

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.ndimage import distance_transform_edt, minimum_filter

from viaspline.kernels.routing.navmesh.map_gaps import close_gaps

Cells = np.ndarray


def closed_by_all_pairs(
    blocked: Cells, width: float, row0: int, column0: int, parts: int, cells: Cells
) -> Cells:
    """What is left open when every pair of blocked cells has been looked at, one by one."""
    cells = cells.copy()
    places = [(int(row), int(column)) for row, column in np.argwhere(blocked)]
    for row, column in places:
        for other, partner in places:
            dy, dx = other - row - 1, partner - column
            aside = max(abs(dx) - 1, 0)
            if dy >= 0 and aside**2 + dy**2 < width**2 and abs(dx) <= math.ceil(width):
                x = column + 0.5 if dx == 0 else column + float(dx > 0)
                begin = (x, row + 1.0)
                end = (x + math.copysign(aside, dx), row + 1.0 + dy)
            elif dy == -1 and 1 <= dx - 1 < width:
                begin, end = (column + 1.0, row + 0.5), (float(partner), row + 0.5)
            else:
                continue
            a, b = (np.array((column0 + parts * x, row0 + parts * y)) for x, y in (begin, end))
            close(cells, a, b)
    return cells


def close(cells: Cells, a: Cells, b: Cells) -> None:
    """Block what a segment from a to b passes through, unless all round its middle is blocked."""
    column, row = np.floor((a + b) / 2).astype(int)
    if cells[max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2].all():
        return
    steps = max(1, math.ceil(4.0 * np.abs(b - a).max()))
    last = None
    for k in range(steps + 1):
        here = np.floor(a + (b - a) * k / steps).astype(int)
        x, y = np.clip(here, 0, np.array(cells.shape[::-1]) - 1)
        cells[y, x] = 1
        if last not in (None, (x, y)):
            cells[last[1], x] = 1
        last = (x, y)


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1), share=st.sampled_from([0.02, 0.1, 0.4, 0.8]),
    width=st.floats(0.3, 7.0), parts=st.integers(1, 3), grown=st.integers(0, 2),
)  # fmt: skip
@example(seed=0, share=0.02, width=6.5, parts=1, grown=2)
@example(seed=3, share=0.8, width=2.0, parts=3, grown=0)
def test_the_gaps_that_are_closed_are_those_of_all_pairs_of_cells(
    seed: int, share: float, width: float, parts: int, grown: int
) -> None:
    random = np.random.default_rng(seed)
    blocked = random.random(random.integers(3, 14, 2)) < share
    blocked = ~minimum_filter(~blocked, 1 + 2 * grown)  # walls of many cells, and their insides
    row0, column0 = random.integers(0, 4, 2).tolist()
    inside = np.kron(blocked, np.ones((parts, parts))) > 0.0
    cells = np.zeros((row0 + inside.shape[0] + 2, column0 + inside.shape[1] + 2), np.uint8)
    near = inside
    if inside.any():
        near = distance_transform_edt(~inside) < 0.5 * width * parts - 0.7
    cells[row0 : row0 + inside.shape[0], column0 : column0 + inside.shape[1]] = near | inside
    asked = (blocked.astype(np.uint8), width, row0, column0, parts)
    expected = closed_by_all_pairs(*asked, cells)
    close_gaps(*asked, cells)
    np.testing.assert_array_equal(cells, expected)
