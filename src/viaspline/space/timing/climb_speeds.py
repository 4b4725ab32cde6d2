"""Where a path has to be driven more slowly because it climbs or descends."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.trajectory.slow_zones import Slow

NEARLY_EVEN: Final = 1.02
"""A piece is halved until the fastest and the slowest place of it differ by no more."""

MAX_HALVINGS: Final = 7
"""Of a span."""


def climb_speeds(
    path: PiecewiseCubic, top: float, climb: float | None, descent: float | None
) -> tuple[Slow, ...]:
    """The stretches of a path on which climb and descent allow less than the largest speed.

    On a piece of the curve the direction is a positive sum of the sides of its control polygon,
    which bounds how steep it gets: no place is faster than it may be.

    Args:
        path: In space.
        top: Largest speed along the path [m/s].
        climb: Largest speed upward [m/s]; None: no limit.
        descent: Largest speed downward [m/s]; None: no limit.

    Returns:
        In order along the path.

    >>> up = PiecewiseCubic([[[0, 0, 0], [3, 0, 4], [6, 0, 8], [9, 0, 12]]])
    >>> climb_speeds(up, 10.0, 2.0, None)
    (Slow(start=0.0, end=15.0, speed=2.5),)
    """
    if climb is None and descent is None:
        return ()
    up = math.inf if climb is None else climb
    down = math.inf if descent is None else descent
    found: list[Slow] = []
    pieces, speeds = _even_pieces(np.asarray(path.spans), up, down, top)
    ends = np.asarray(path.distance(pieces)).tolist()
    start = 0.0
    for speed, end in zip(speeds.tolist(), ends, strict=True):
        if speed < top and end > start:
            if found and found[-1].end == start and math.isclose(found[-1].speed, speed):
                found[-1] = Slow(found[-1].start, end, min(speed, found[-1].speed))
            else:
                found.append(Slow(start, end, speed))
        start = end
    return tuple(found)


def _even_pieces(spans: Floats, up: float, down: float, top: float) -> tuple[Floats, Floats]:
    """Pieces of spans (n, 4, 3), halved until each is nearly even, in order along the path.

    Returns:
        (parameters at which they end, their speeds [m/s]), each of shape (p,).
    """
    lows, width = np.arange(float(len(spans))), 1.0
    ends: list[Floats] = []
    speeds: list[Floats] = []
    for halvings in range(MAX_HALVINGS, -1, -1):
        slowest, fastest = _speeds(spans, up, down, top)
        even = (fastest <= NEARLY_EVEN * slowest) | (halvings == 0)
        ends.append(lows[even] + width)
        speeds.append(slowest[even])
        width *= 0.5
        if even.all():
            break
        spans, lows = _halved(spans[~even]), np.repeat(lows[~even], 2)
        lows[1::2] += width
    every = np.concatenate(ends)
    order = np.argsort(every, kind="stable")
    return every[order], np.concatenate(speeds)[order]


def _halved(spans: Floats) -> Floats:
    """Both halves of each of (n, 4, 3) spans, (2 n, 4, 3)."""
    a = 0.5 * (spans[:, 1:] + spans[:, :-1])
    b = 0.5 * (a[:, 1:] + a[:, :-1])
    middle = 0.5 * (b[:, 0] + b[:, 1])
    first = np.stack((spans[:, 0], a[:, 0], b[:, 0], middle), axis=1)
    last = np.stack((middle, b[:, 1], a[:, 2], spans[:, 3]), axis=1)
    return np.stack((first, last), axis=1).reshape(-1, 4, 3)


def _speeds(spans: Floats, up: float, down: float, top: float) -> tuple[Floats, Floats]:
    """The speeds [m/s] that the steepest and the flattest directions of spans (n, 4, 3) allow.

    The angles of climb of all positive sums of a control polygon's sides lie between those of the
    sides, each with as much of a level part as it has along their mean: a sum's level part is no
    shorter. Where a side points away from that mean, a sum may be upright.
    """
    sides = np.diff(spans, axis=1)
    sizes = np.linalg.norm(sides, axis=2)
    moving = sizes > 1e-12 * (1.0 + sizes.max(axis=1, initial=0.0))[:, None]
    level = np.where(moving[:, :, None], sides[:, :, :2], 0.0)
    mean = level.sum(axis=1)
    size = np.linalg.norm(mean, axis=1)
    unit = mean / np.where(size > 0.0, size, 1.0)[:, None]
    ahead = (level * unit[:, None]).sum(axis=2)
    upright = (ahead < 0.0).any(axis=1) | ((size == 0.0) & level.any(axis=(1, 2)))
    slopes = np.arctan2(sides[:, :, 2], ahead)
    least = np.where(moving, slopes, np.inf).min(axis=1)
    most = np.where(moving, slopes, -np.inf).max(axis=1)
    allowed = np.stack([_allowed(slope, up, down, top) for slope in (least, most)])
    slowest = np.where(upright, min(top, up, down), allowed.min(axis=0))
    fastest = np.where(upright | ((least < 0.0) & (most > 0.0)), top, allowed.max(axis=0))
    stays = ~moving.any(axis=1)
    return np.where(stays, top, slowest), np.where(stays, top, fastest)


def _allowed(slopes: Floats, up: float, down: float, top: float) -> Floats:
    """The largest speeds [m/s] along ways that climb at angles [rad]."""
    rises = np.sin(np.where(np.isfinite(slopes), slopes, 0.0))
    limits = np.where(rises > 0.0, up, down)
    return np.minimum(top, limits / np.maximum(np.abs(rises), 1e-300))
