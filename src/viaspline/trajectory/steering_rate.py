"""How fast a steered robot may be, so that its wheels turn in time.

The wheels' angle is atan(L κ) with the wheelbase L, so it changes by L κ' / (1 + L² κ²) per
distance. On a cell κ and κ' lie between their Bernstein coefficients, but for what these miss; so
the largest change is proven.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.trajectory.cells import Cells
from viaspline.trajectory.limits import YAW_SETTLE_S, Limits

_MIN_CURVATURE_1PM = 1e-12


def steered_caps(cells: Cells, limits: Limits) -> Floats:
    """The largest v² on every cell that the steering allows [m²/s²], shape (n,)."""
    count = cells.along.size - 1
    if limits.max_steer_rate is None or limits.wheelbase is None or not cells.yaws.size:
        return np.full(count, np.inf)
    bends, changes = cells.yaws[:, 0], cells.yaws[:, 1]
    most = np.abs(changes).max(axis=1) + cells.misses[:, 3]
    one_way = bends.min(axis=1) * bends.max(axis=1) > 0.0
    least = np.where(one_way, np.abs(bends).min(axis=1) - cells.misses[:, 2], 0.0)
    flat = 1.0 + (limits.wheelbase * np.maximum(least, 0.0)) ** 2
    speed = limits.max_steer_rate * flat / np.maximum(limits.wheelbase * most, _MIN_CURVATURE_1PM)
    return np.asarray(speed * speed)


def jump_speeds(before: Floats, after: Floats, limits: Limits) -> Floats:
    """The largest speeds where the curvature jumps [m/s].

    While the wheels turn the robot rolls no farther than at full speed in ``YAW_SETTLE_S``.

    Args:
        before: Curvature before each jump [1/m], shape (n,).
        after: Curvature after it [1/m], shape (n,).
        limits: With the steering rate and the wheelbase, or without.
    """
    if limits.max_steer_rate is None or limits.wheelbase is None:
        return np.full(before.size, np.inf)
    turn = np.abs(np.arctan(limits.wheelbase * after) - np.arctan(limits.wheelbase * before))
    room = limits.max_speed * YAW_SETTLE_S * limits.max_steer_rate
    return np.asarray(room / np.maximum(turn, _MIN_CURVATURE_1PM))
