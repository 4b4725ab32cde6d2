"""What the limits of a path ask of stretches of constant change of the acceleration.

Tested through ``trajectory/test_jerk``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.trajectory.cells import Cells, CellSize
from viaspline.trajectory.coupled import caps_of_cells
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.motion_ends import Rows


def rows_of(
    cells: Cells,
    limits: Limits,
    cell_size: CellSize,
    cell: NDArray[np.int64],
    parts: Floats,
    tops: Floats,
) -> Rows:
    """The limits of every stretch as rows over a0, a1, w0, m and w1."""
    n = cell.size
    lines = caps_of_cells(cells, limits, cell_size)[cell]
    caps = lines[:, :1] + parts * (lines[:, 1:] - lines[:, :1])
    caps = np.minimum(caps, tops[:, None])
    misses, pairs = cells.misses[cell], _pairs(cells, limits, cell)
    most = np.full(n, cell_size.accel)
    for _, _, miss, _, limit in pairs:
        most = np.minimum(most, 0.25 * limit / np.maximum(misses[:, miss], 1e-300))
    weights, bounds = [np.zeros((n, 5)) for _ in range(7)], [np.zeros(n) for _ in range(7)]
    levels = (caps[:, 0], 0.5 * (caps[:, 0] + caps[:, 1]), caps[:, 1])
    for k in range(3):
        weights[k][:, 2 + k], bounds[k] = 1.0, levels[k]
    for k, (end, sign) in enumerate(((0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)), start=3):
        weights[k][:, end] = sign
        bounds[k] = np.minimum(most, limits.max_accel if sign > 0.0 else limits.brake)
    for along, across, miss_a, miss_w, limit in pairs:
        room = limit - misses[:, miss_a] * most
        for row, slack in _couple(_part(along, parts), _part(across, parts), misses[:, miss_w]):
            for sign in (1.0, -1.0):
                weights.append(sign * row + slack)
                bounds.append(room)
    return Rows(np.stack(weights, axis=1), np.stack(bounds, axis=1))


def _pairs(
    cells: Cells, limits: Limits, cell: NDArray[np.int64]
) -> list[tuple[Floats, Floats, int, int, float]]:
    """What couples speed and acceleration on stretches: A, B, their misses, and |A a + B w| <=."""
    axes = limits.of_axes("axis_accel", cells.tangents.shape[1])
    pairs = [
        (cells.tangents[cell, j], cells.bends[cell, j], 0, 1, float(axes[j]))
        for j in range(axes.size)
    ]
    if limits.max_yaw_accel is not None and cells.yaws.size:
        pairs.append((cells.yaws[cell, 0], cells.yaws[cell, 1], 2, 3, limits.max_yaw_accel))
    return pairs


def _part(coefficients: Floats, parts: Floats) -> Floats:
    """Bernstein coefficients (n, 3) of quadratics on parts (n, 2) of their cells."""
    x, y = parts[:, :1], parts[:, 1:]
    c = coefficients[:, 0:1], coefficients[:, 1:2], coefficients[:, 2:3]

    def blossom(p: Floats, q: Floats) -> Floats:
        left, right = c[0] + p * (c[1] - c[0]), c[1] + p * (c[2] - c[1])
        return np.asarray(left + q * (right - left))

    return np.concatenate((blossom(x, x), blossom(x, y), blossom(y, y)), axis=1)


def _couple(t: Floats, k: Floats, miss: Floats) -> list[tuple[Floats, Floats]]:
    """T a + K w as five Bernstein coefficients over a0, a1, w0, m, w1, and what K misses."""
    n = t.shape[0]
    cubic = np.zeros((5, n, 2))  # the last one is never used but for its weight of 0
    cubic[0, :, 0] = t[:, 0]
    cubic[1, :, 0], cubic[1, :, 1] = 2.0 * t[:, 1] / 3.0, t[:, 0] / 3.0
    cubic[2, :, 0], cubic[2, :, 1] = t[:, 2] / 3.0, 2.0 * t[:, 1] / 3.0
    cubic[3, :, 1] = t[:, 2]
    shares = np.array([[1, 0, 0], [0.5, 0.5, 0], [1 / 6, 4 / 6, 1 / 6], [0, 0.5, 0.5], [0, 0, 1]])
    found = []
    for j in range(5):
        row, slack = np.zeros((n, 5)), np.zeros((n, 5))
        row[:, :2] = 0.25 * j * cubic[j - 1] + (1.0 - 0.25 * j) * cubic[j]
        for i in range(3):
            if 0 <= j - i <= 2:
                row[:, 2 + i] = shares[j, i] * k[:, j - i]
        slack[:, 2:] = miss[:, None] * shares[j]
        found.append((row, slack))
    return found


def beside_rest(
    rows: Rows, cells: Cells, limits: Limits, cell: NDArray[np.int64], k: int, a: int, w: int
) -> None:
    """Rows of a stretch on which a and w grow from 0, or fall to it: both at their largest."""
    cap, at = rows.limits[k, :3].min(), cell[[k]]
    rows.limits[k, 7:] = np.inf
    rows.weights[k, :3], rows.weights[k, 7:] = 0.0, 0.0
    rows.weights[k, 0, w], rows.limits[k, :3] = 1.0, (cap, np.inf, np.inf)
    misses = cells.misses[cell[k]]
    for i, (along, across, miss_a, miss_w, limit) in enumerate(_pairs(cells, limits, at)):
        row = 7 + 10 * i
        size = np.abs(along).max() + misses[miss_a]
        rows.weights[k, row, a] = size if a == 1 else -size
        rows.weights[k, row, w] = np.abs(across).max() + misses[miss_w]
        rows.limits[k, row] = limit
