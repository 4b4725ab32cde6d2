"""Sides of a solid on which nothing can pass it, known without a search.

A building that stands on the ground has no way under it, one beside the bounds none between. To
look for such a way takes a search of the whole world, as there is none.

Tested through ``space/routing/test_space_router``.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.routing.side_gates import (
    AHEAD_X,
    AHEAD_Y,
    ALLOWED,
    GATE_X,
    GATE_Y,
    LEAST,
    LEFT,
    MOST,
    OVER,
    RIGHT,
)
from viaspline.mission.shapes.solids import Prism, Solid
from viaspline.space.routing.pass_gates import fills_gate
from viaspline.space.routing.search_room import SearchRoom


def is_shut(
    room: SearchRoom,
    solid: Solid,
    row: Floats,
    ends: tuple[ArrayLike, ArrayLike],
    required: float,
) -> bool:
    """Whether the limits of a room leave no place where a way could pass a solid on one side.

    Args:
        room: Where.
        solid: That is to be passed.
        row: Its gate, with one side allowed; see ``pass_gates.gate``, (8,).
        ends: Of the way [m], (3,) each.
        required: Distance to be kept from everything [m].

    Returns:
        False also where that isn't known.
    """
    ahead = (np.array(ends, np.float64)[:, :2] - row[[GATE_X, GATE_Y]]) @ row[[AHEAD_X, AHEAD_Y]]
    if (ahead[0] < 0.0) == (ahead[1] < 0.0):
        return False  # it needn't come through the plane of the gate at all
    side = int(row[ALLOWED])
    if side in (LEFT, RIGHT):
        return _is_shut_beside(room, row, required + room.body)
    if not isinstance(solid, Prism):
        return False
    if not fills_gate(solid, (row[GATE_X], row[GATE_Y]), (row[AHEAD_X], row[AHEAD_Y])):
        return False
    low, high = solid.low, solid.high
    if side == OVER:
        return bool(high + required > room.limits[5])
    return bool(low - required < room.limits[2])


def _is_shut_beside(room: SearchRoom, row: Floats, kept: float) -> bool:
    """Whether the plane of a gate ends at the bounds before it gets past what it covers."""
    side = 1.0 if int(row[ALLOWED]) == LEFT else -1.0
    way = -side * row[AHEAD_Y], side * row[AHEAD_X]
    farthest = math.inf
    for axis, column in ((0, GATE_X), (1, GATE_Y)):
        if way[axis] != 0.0:
            limit = room.limits[3 + axis] - kept if way[axis] > 0.0 else room.limits[axis] + kept
            farthest = min(farthest, (limit - row[column]) / way[axis])
    return bool(farthest <= (row[MOST] if side > 0.0 else -row[LEAST]))
