"""A way that is being pulled taut: a row of vertices that grows and shrinks.

Tested through ``kernels/space/routing/test_pull_taut``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner


class TautString(NamedTuple):
    """A way that is being pulled.

    Attributes:
        rows: Its vertices [m], (room, 3).
        size: How many there are, (1,).
        planes: Room for what a vertex touches, (p, 5).
        best: Room for a place, (3,).
        reach: What is no further beyond the radius counts as touched [m].
    """

    rows: Floats
    size: Ints
    planes: Floats
    best: Floats
    reach: float


@inner
def drop_vertex(string: TautString, here: int) -> None:
    """Take a vertex away."""
    for row in range(here, string.size[0] - 1):
        for axis in range(3):
            string.rows[row, axis] = string.rows[row + 1, axis]
    string.size[0] -= 1


@inner
def insert_vertex(string: TautString, here: int, x: float, y: float, z: float) -> None:
    """Put a further vertex before one; there has to be room."""
    for row in range(string.size[0], here, -1):
        for axis in range(3):
            string.rows[row, axis] = string.rows[row - 1, axis]
    string.size[0] += 1
    string.rows[here, 0] = x
    string.rows[here, 1] = y
    string.rows[here, 2] = z


@inner
def line_length(rows: Floats, i: int, j: int) -> float:
    """Length of the line from one row to another [m]."""
    dx = rows[j, 0] - rows[i, 0]
    dy = rows[j, 1] - rows[i, 1]
    dz = rows[j, 2] - rows[i, 2]
    return math.sqrt(dx * dx + dy * dy + dz * dz)
