"""What beams say: where a body can go inside of what they passed, and what they saw through.

Tested through ``robot/perception/test_belief``.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.jit import inner, kernel

SWEPT_SHARE: Final = 1e-3
"""A point of a body that moves outwards by less than this, of how far the body moves, sweeps over
nothing new."""


@inner
def _beam_before(dx: float, dy: float, first: float, step: float) -> int:
    """The last beam of a full turn that points to the right of (dx, dy), or straight at it."""
    return math.floor(((math.atan2(dy, dx) - first) % (2.0 * math.pi)) / step)


@inner
def _sees(
    x: float, y: float, scan: int, origins: Floats, firsts: Floats, step: float, lengths: Floats
) -> bool:
    """Whether in a scan the beams on either side of (x, y) go at least as far as it."""
    beams = lengths.shape[1]
    dx = x - origins[scan, 0]
    dy = y - origins[scan, 1]
    right = _beam_before(dx, dy, firsts[scan], step)
    left = right + 1
    if beams >= round(2.0 * math.pi / step):
        right %= beams
        left %= beams
    if left >= beams:
        return False
    shorter = min(lengths[scan, right], lengths[scan, left])
    return dx * dx + dy * dy <= shorter * shorter


@inner
def _seen_by(
    x: float, y: float, likely: int, origins: Floats, firsts: Floats, step: float, lengths: Floats
) -> int:
    """A scan that sees (x, y), the likely one if that does; -1: none does.

    What saw the last place mostly sees the next one.
    """
    if _sees(x, y, likely, origins, firsts, step, lengths):
        return likely
    for scan in range(origins.shape[0]):
        if scan != likely and _sees(x, y, scan, origins, firsts, step, lengths):
            return scan
    return -1


@kernel
def seen_ahead(
    places: Floats, ahead: Floats, radius: float, gap: float, origins: Floats, firsts: Floats,
    step: float, lengths: Floats,
) -> int:  # fmt: skip
    """How far a disc can go with its front half always on places that a scan has seen.

    All that a disc newly covers on its way has been under its front half at some moment.

    Args:
        places: Of its middle, close together [m], (n, 2).
        ahead: Unit vectors in which it moves there, (n, 2).
        radius: [m].
        gap: From point to point on its rim, at most [m].
        origins: Where scans were taken, (k, 2); the one that is likeliest to tell comes first.
        firsts: Directions of their first beams [rad], (k,).
        step: From beam to beam [rad].
        lengths: How far their beams are known to be free [m], (k, beams).

    Returns:
        How many places it can take, from the first on.
    """
    half = math.ceil(0.5 * math.pi * radius / gap)
    along, aside = np.empty(2 * half + 1), np.empty(2 * half + 1)
    for point in range(along.size):
        angle = 0.5 * math.pi * (point - half) / max(half, 1)
        along[point] = radius * math.cos(angle)
        aside[point] = radius * math.sin(angle)
    likely = 0
    for k in range(places.shape[0]):
        for point in range(along.size):
            x = places[k, 0] + along[point] * ahead[k, 0] - aside[point] * ahead[k, 1]
            y = places[k, 1] + along[point] * ahead[k, 1] + aside[point] * ahead[k, 0]
            seen_by = _seen_by(x, y, likely, origins, firsts, step, lengths)
            if seen_by < 0:
                return k
            likely = seen_by
    return places.shape[0]


@kernel
def body_seen_ahead(
    poses: Floats, moves: Floats, points: Floats, normals: Floats, origins: Floats, firsts: Floats,
    step: float, lengths: Floats,
) -> int:  # fmt: skip
    """How far a body can go with all that it newly covers always on places that a scan has seen.

    Args:
        poses: x, y [m], heading [rad], close together, (n, 3).
        moves: How far it moves ahead [m] and turns [rad] to get into each, (n, 2).
        points: About its outline, in its frame [m], (m, 2).
        normals: Away from it there, (m, 2).
        origins: As for ``seen_ahead``, with all that follows.
        firsts: The same.
        step: The same.
        lengths: The same.

    Returns:
        How many poses it can take, from the first on.
    """
    likely = 0
    for k in range(poses.shape[0]):
        c = math.cos(poses[k, 2])
        s = math.sin(poses[k, 2])
        ahead = moves[k, 0]
        turn = moves[k, 1]
        for point in range(points.shape[0]):
            along = points[point, 0]
            aside = points[point, 1]
            outwards = normals[point, 0] * (ahead - turn * aside) + normals[point, 1] * turn * along
            if outwards <= SWEPT_SHARE * (ahead + abs(turn) * math.hypot(along, aside)):
                continue
            x = poses[k, 0] + along * c - aside * s
            y = poses[k, 1] + along * s + aside * c
            seen_by = _seen_by(x, y, likely, origins, firsts, step, lengths)
            if seen_by < 0:
                return k
            likely = seen_by
    return poses.shape[0]


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
    full = beams >= round(2.0 * math.pi / step)
    through = np.zeros(points.shape[0], np.bool_)
    for k in range(points.shape[0]):
        dx = points[k, 0] - x
        dy = points[k, 1] - y
        distance = math.hypot(dx, dy)
        if distance * step > finest:
            continue
        right = _beam_before(dx, dy, first, step)
        left = right + 1
        if full:
            right %= beams
            left %= beams
        if left < beams:
            through[k] = min(lengths[right], lengths[left]) > distance + margin
    return through


@kernel
def beam_spread(points: Floats, gap: float) -> Ints:
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
