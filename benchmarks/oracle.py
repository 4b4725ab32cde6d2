"""Whether there is a way at all, told without the planner: a flood over samples of the distance.

Distances change by no more than one moves, so a lattice of samples proves something between them.
Where two neighbours are both half a step farther off than required, all of the step between them
is clear: their flood says that there *is* a way. Every place that is clear has a sample within
half a diagonal that misses the required distance by no more than that: where the flood over those
doesn't get through either, there is *none*. In between the lattice can't tell.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.ndimage import label

Box = tuple[float, float, float, float]


def samples(box: Box, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates of a lattice that covers a box [m], (width,), (height,)."""
    x0, y0, x1, y1 = box
    return (
        x0 + step * np.arange(math.ceil((x1 - x0) / step) + 1),
        y0 + step * np.arange(math.ceil((y1 - y0) / step) + 1),
    )


def distances_to(shapes: list, reach: float, box: Box, step: float) -> np.ndarray:
    """Distance of every sample to the nearest disc or convex ring [m], (height, width).

    Args:
        shapes: Discs ``(x, y, radius)`` and rings (n, 2).
        reach: No distance is told beyond this [m].
        box: What the lattice covers [m].
        step: Between samples [m].
    """
    x, y = samples(box, step)
    found = np.full((len(y), len(x)), reach)
    for shape in shapes:
        disc = isinstance(shape, tuple)
        low = np.subtract(shape[:2], shape[2]) if disc else shape.min(axis=0)
        high = np.add(shape[:2], shape[2]) if disc else shape.max(axis=0)
        i, j = (slice(*np.searchsorted(a, (p - reach, q + reach))) for a, p, q in
                zip((x, y), low, high, strict=True))  # fmt: skip
        there = np.meshgrid(x[i], y[j])
        if disc:
            gap = np.hypot(there[0] - shape[0], there[1] - shape[1]) - shape[2]
        else:
            gap = _distance_to_ring(shape, *there)
        found[j, i] = np.minimum(found[j, i], gap)
    return found


def _distance_to_ring(ring: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Distance to a convex polygon [m], negative inside."""
    gap = np.full(x.shape, np.inf)
    inside = np.ones(x.shape, bool)
    turn = 0.0
    for (ax, ay), (bx, by) in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        turn += ax * by - bx * ay
    for (ax, ay), (bx, by) in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        dx, dy = bx - ax, by - ay
        along = np.clip(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0)
        gap = np.minimum(gap, np.hypot(ax + along * dx - x, ay + along * dy - y))
        inside &= (dx * (y - ay) - dy * (x - ax)) * turn > 0.0
    return np.where(inside, -gap, gap)


def inside_bounds(distances: np.ndarray, box: Box, step: float) -> np.ndarray:
    """The same where the edge of the box has to be kept clear of as well."""
    x, y = samples(box, step)
    across = np.minimum(x - box[0], box[2] - x)
    return np.minimum(distances, np.minimum(across, np.minimum(y - box[1], box[3] - y)[:, None]))


def verdict(distances, box: Box, step: float, start, goal, required: float) -> str:
    """``open``: there is a way; ``closed``: there is none; ``unsure``: the lattice can't tell.

    Args:
        distances: Of every sample from what is to be kept clear of [m], (height, width).
        box: What the lattice covers [m].
        step: Between samples [m].
        start: x, y [m].
        goal: x, y [m].
        required: Distance to keep [m].
    """
    if _joined(distances >= required + 0.5 * step, box, step, start, goal, 4):
        return "open"
    if not _joined(distances >= required - math.sqrt(0.5) * step, box, step, start, goal, 8):
        return "closed"
    return "unsure"


def _joined(free: np.ndarray, box: Box, step: float, start, goal, neighbours: int) -> bool:
    areas, _ = label(free, np.ones((3, 3)) if neighbours == 8 else None)
    a, b = (areas[round((y - box[1]) / step), round((x - box[0]) / step)] for x, y in (start, goal))
    return bool(a and a == b)
