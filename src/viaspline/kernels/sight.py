"""What beams say: which cells of a lattice they passed, and which points they saw through.

A window is an array of flags, row by row from the lowest, column by column from the leftmost; its
cell (0, 0) has the number ``corner`` in the lattice, and cell (i, j) of the lattice is the square
from (i, j) to (i + 1, j + 1) times ``side``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.packed import Flags, Floats, Ints


@kernel
def mark_disc(window: Flags, corner: Ints, side: float, x: float, y: float, radius: float) -> None:
    """Mark the cells whose middle is within ``radius`` of (x, y) in a window."""
    u = x / side - corner[0]
    v = y / side - corner[1]
    reach = radius / side
    for row in range(max(0, math.floor(v - reach)), min(window.shape[0], math.ceil(v + reach))):
        for column in range(
            max(0, math.floor(u - reach)), min(window.shape[1], math.ceil(u + reach))
        ):
            if math.hypot(column + 0.5 - u, row + 0.5 - v) <= reach:
                window[row, column] = True


@inner
def _mark_beam(window: Flags, u: float, v: float, du: float, dv: float, length: float) -> None:
    """Mark the cells that a beam enters and leaves; (u, v) and its slopes are in cells."""
    column = math.floor(u)
    row = math.floor(v)
    right = 1 if du > 0.0 else -1
    up = 1 if dv > 0.0 else -1
    step_u = 1.0 / abs(du) if du != 0.0 else np.inf
    step_v = 1.0 / abs(dv) if dv != 0.0 else np.inf
    next_u = (column + (1 if du > 0.0 else 0) - u) / du if du != 0.0 else np.inf
    next_v = (row + (1 if dv > 0.0 else 0) - v) / dv if dv != 0.0 else np.inf
    while min(next_u, next_v) <= length:
        if column < 0 or column >= window.shape[1] or row < 0 or row >= window.shape[0]:
            return
        window[row, column] = True
        if next_u <= next_v:
            column += right
            next_u += step_u
        else:
            row += up
            next_v += step_v


@kernel
def mark_beams(
    window: Flags, corner: Ints, side: float, x: float, y: float, first: float, step: float,
    lengths: Floats,
) -> None:  # fmt: skip
    """Mark every cell of a window that one of the beams from (x, y) passes from edge to edge.

    Args:
        window: (h, w), changed in place.
        corner: Number of its first cell in the lattice, (2,).
        side: Of a cell [m].
        x: [m].
        y: [m].
        first: Direction of beam 0 [rad].
        step: From beam to beam [rad].
        lengths: How far each beam is known to be free [m], (n,).
    """
    u = x / side - corner[0]
    v = y / side - corner[1]
    for beam in range(lengths.size):
        angle = first + beam * step
        _mark_beam(window, u, v, math.cos(angle) / side, math.sin(angle) / side, lengths[beam])


@kernel
def count_seen(window: Flags, corner: Ints, side: float, points: Floats, radius: float) -> int:
    """How many of some points (n, 2), from the first on, have only marked cells round them.

    What counts is every cell whose middle is within ``radius`` of the point, and always the cell
    that it is in. Outside of the window nothing is marked.
    """
    height, width = window.shape
    reach = radius / side
    for k in range(points.shape[0]):
        u = points[k, 0] / side - corner[0]
        v = points[k, 1] / side - corner[1]
        low_row = math.floor(min(v, v - reach + 0.5))
        high_row = math.floor(max(v, v + reach - 0.5))
        for row in range(low_row, high_row + 1):
            rise = row + 0.5 - v
            aside = math.sqrt(max(reach * reach - rise * rise, 0.0))
            low = math.ceil(u - aside - 0.5)
            high = math.floor(u + aside - 0.5)
            if row == math.floor(v):
                low = min(low, math.floor(u))
                high = max(high, math.floor(u))
            for column in range(low, high + 1):
                if row < 0 or row >= height or column < 0 or column >= width:
                    return k
                if not window[row, column]:
                    return k
    return points.shape[0]


@kernel
def seen_through(
    points: Floats, x: float, y: float, first: float, step: float, lengths: Floats, finest: float,
    margin: float,
) -> Flags:  # fmt: skip
    """Which points (n, 2) have a beam on either side that goes on well beyond them.

    Args:
        points: [m], (n, 2).
        x: Of the sensor [m].
        y: Of the sensor [m].
        first: Direction of beam 0 [rad].
        step: From beam to beam [rad].
        lengths: How far each beam is known to be free [m], (b,).
        finest: Where the beams are farther apart than this, they say nothing [m].
        margin: How far they have to go on beyond the point [m].
    """
    beams = lengths.size
    turn = 2.0 * math.pi
    around = round(turn / step)
    through = np.zeros(points.shape[0], np.bool_)
    for k in range(points.shape[0]):
        dx = points[k, 0] - x
        dy = points[k, 1] - y
        distance = math.hypot(dx, dy)
        if distance * step > finest:
            continue
        angle = (math.atan2(dy, dx) - first) % turn
        right = math.floor(angle / step)
        left = right + 1
        if beams >= around:
            right %= beams
            left %= beams
        if left >= beams:
            continue
        through[k] = min(lengths[right], lengths[left]) > distance + margin
    return through


@kernel
def spread(points: Floats, gap: float) -> Ints:
    """Indices of points (n, 2), taken in order, that are farther than ``gap`` from those taken."""
    taken = np.empty(points.shape[0], np.int64)
    count = 0
    for k in range(points.shape[0]):
        alone = True
        for other in range(count - 1, -1, -1):
            dx = points[k, 0] - points[taken[other], 0]
            dy = points[k, 1] - points[taken[other], 1]
            if dx * dx + dy * dy <= gap * gap:
                alone = False
                break
        if alone:
            taken[count] = k
            count += 1
    return taken[:count].copy()
