"""Gaps that are too narrow to go through, where a guide goes through them nevertheless."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.growable import new_floats, sized_floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld

TOUCH_RADII = 1e-3  # distance from an obstacle at which a chord ends, in radii
MOST_CHORDS, MOST_PLACES = 1000, 20_000  # along a guide beside its corners, all of which is near
GRADIENT_STEP_RADII = (
    1e-6  # step of the gradient in radii: in the middle of a gap either side is the nearest
)
MAX_CHORD_STEPS = 64  # of a chord to either side: along a wall it would crawl


@inner
def _away(world: PackedWorld, x: float, y: float, step: float) -> float:
    """The direction that leads away from what is nearest to (x, y) [rad]."""
    here = 0.0
    dx = 0.0
    dy = 0.0
    for probe in range(3):
        px = x + step if probe == 1 else x
        py = y + step if probe == 2 else y
        distance, _ = nearest(world, px, py, np.inf)
        if probe == 0:
            here = distance
        elif probe == 1:
            dx = distance - here
        else:
            dy = distance - here
    return math.atan2(dy, dx)


@inner
def _write_chord(
    world: PackedWorld, x: float, y: float, rho: float, chords: Floats, row: int
) -> float:
    """Write the segment from the nearest obstacle through (x, y) to what is opposite.

    Returns:
        Its length, and at both ends how far it is from touching [m]. Where that is less than
        2 rho nothing that keeps rho crosses it: no place on it is farther than half of that from
        the world.
    """
    heading = _away(world, x, y, max(GRADIENT_STEP_RADII * rho, 1e-9))
    width = 0.0
    for end in range(2):
        sense = 2.0 * end - 1.0
        along = 0.0
        left = np.inf
        for _ in range(MAX_CHORD_STEPS):
            px = x + sense * along * math.cos(heading)
            py = y + sense * along * math.sin(heading)
            left, _ = nearest(world, px, py, np.inf)
            if left <= TOUCH_RADII * rho or along > 4.0 * rho:
                break
            along += left
        chords[row, 2 * end] = px
        chords[row, 2 * end + 1] = py
        width += along + max(left, 0.0)
    return width


@kernel
def narrow_places(world: PackedWorld, guide: Floats, rho: float) -> Floats:
    """Segments across a guide where it goes between two things less than 2 rho apart.

    No path that keeps ``rho`` crosses such a segment: every place on it is nearer to one of its
    two ends.

    Args:
        world: PackedWorld.
        guide: (k, 2) [m].
        rho: Distance to keep [m]; if that is nothing, no gap is too narrow.

    Returns:
        Segments x0, y0, x1, y1 [m], (n, 4).
    """
    chords = new_floats(16, 4)
    count = 0
    if rho <= 0.0:
        return sized_floats(chords, 0, 0)
    length = 0.0
    for k in range(guide.shape[0] - 1):
        length += math.hypot(guide[k + 1, 0] - guide[k, 0], guide[k + 1, 1] - guide[k, 1])
    step = max(0.25 * rho, length / MOST_CHORDS)
    finest = max(1e-3 * rho, length / MOST_PLACES)
    for k in range(guide.shape[0] - 1):
        dx = guide[k + 1, 0] - guide[k, 0]
        dy = guide[k + 1, 1] - guide[k, 1]
        size = math.hypot(dx, dy)
        travelled = 0.0
        while travelled < size:
            x = guide[k, 0] + travelled / size * dx
            y = guide[k, 1] + travelled / size * dy
            distance, _ = nearest(world, x, y, 4.0 * rho)
            if not 0.0 < distance < rho:
                travelled += max(distance - rho, -distance, 0.02 * rho, finest)
                continue
            if count == chords.shape[0]:
                chords = sized_floats(chords, count, 2 * count)
            width = _write_chord(world, x, y, rho, chords, count)
            if width < 2.0 * rho:
                count += 1
                travelled += step + 0.75 * rho
            else:
                travelled += min(step, max(0.25 * (width - 2.0 * rho), finest))
    return sized_floats(chords, count, count)
