"""Where along a guide a feature lies, and on which side.

Tested through ``kernels/routing/string_pulling/test_pull``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined
from viaspline.kernels.world.ring_features import FEATURE_RADIUS, FEATURE_X, FEATURE_Y, OUT_X, OUT_Y

ALONG_SLACK = 1e-9  # as a share of a piece


@inlined
def _left_of(guide: Floats, k: int, x: float, y: float) -> float:
    """Twice the area of (x, y) and piece k of the guide; above 0 to the left of it."""
    dx = guide[k + 1, 0] - guide[k, 0]
    dy = guide[k + 1, 1] - guide[k, 1]
    return dx * (y - guide[k, 1]) - dy * (x - guide[k, 0])


@inlined
def foot(guide: Floats, first: int, last: int, x: float, y: float) -> float:
    """Where on the pieces first:last of the guide the nearest place to (x, y) is."""
    best = np.inf
    place = float(first)
    for k in range(first, last):
        dx = guide[k + 1, 0] - guide[k, 0]
        dy = guide[k + 1, 1] - guide[k, 1]
        squared = dx * dx + dy * dy
        w = 0.0
        if squared > 0.0:
            w = min(max(((x - guide[k, 0]) * dx + (y - guide[k, 1]) * dy) / squared, 0.0), 1.0)
        gx = guide[k, 0] + w * dx - x
        gy = guide[k, 1] + w * dy - y
        if gx * gx + gy * gy < best:
            best = gx * gx + gy * gy
            place = k + w
    return place


@inlined
def side_of(guide: Floats, place: float, found: Floats, j: int) -> float:
    """On which side of the guide feature j lies: +1 to the left, -1 to the right."""
    x = found[j, FEATURE_X]
    y = found[j, FEATURE_Y]
    pieces = guide.shape[0] - 1
    k = min(int(place), pieces - 1)
    w = place - k
    size = math.hypot(guide[k + 1, 0] - guide[k, 0], guide[k + 1, 1] - guide[k, 1])
    area = _left_of(guide, k, x, y)
    other = k
    if w <= ALONG_SLACK and k > 0:
        other = k - 1
    elif w >= 1.0 - ALONG_SLACK and k + 1 < pieces:
        other = k + 1
    if other != k:
        first = min(k, other)
        turn = _left_of(guide, first, guide[first + 2, 0], guide[first + 2, 1])
        second = _left_of(guide, other, x, y)
        area = min(area, second) if turn > 0.0 else max(area, second)
    if abs(area) <= 1e-7 * size * (1.0 + size) and found[j, FEATURE_RADIUS] == 0.0:
        # on the guide itself: what is blocked lies against its corner's direction
        dx = guide[k + 1, 0] - guide[k, 0]
        dy = guide[k + 1, 1] - guide[k, 1]
        area = dy * found[j, OUT_X] - dx * found[j, OUT_Y]
    return 1.0 if area > 0.0 else -1.0
