"""Where a path has to be driven more slowly because it climbs or descends."""

from __future__ import annotations

import math
from collections.abc import Iterator
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
    pieces = [
        piece
        for k, span in enumerate(path.spans)
        for piece in _even_pieces(span, float(k), 1.0, up, down, top, MAX_HALVINGS)
    ]
    ends = np.asarray(path.distance(np.array([low + width for low, width, _ in pieces]))).tolist()
    start = 0.0
    for (_, _, speed), end in zip(pieces, ends, strict=True):
        if speed < top and end > start:
            if found and found[-1].end == start and math.isclose(found[-1].speed, speed):
                found[-1] = Slow(found[-1].start, end, min(speed, found[-1].speed))
            else:
                found.append(Slow(start, end, speed))
        start = end
    return tuple(found)


def _even_pieces(
    span: Floats, low: float, width: float, up: float, down: float, top: float, halvings: int
) -> Iterator[tuple[float, float, float]]:
    """Pieces of a span [parameter, width, speed], halved until each is nearly even."""
    slowest, fastest = _speeds(span, up, down, top)
    if halvings == 0 or fastest <= NEARLY_EVEN * slowest:
        yield low, width, slowest
        return
    a = 0.5 * (span[1:] + span[:-1])
    b = 0.5 * (a[1:] + a[:-1])
    middle = 0.5 * (b[0] + b[1])
    half = 0.5 * width
    first = np.stack((span[0], a[0], b[0], middle))
    last = np.stack((middle, b[1], a[2], span[3]))
    yield from _even_pieces(first, low, half, up, down, top, halvings - 1)
    yield from _even_pieces(last, low + half, half, up, down, top, halvings - 1)


def _speeds(span: Floats, up: float, down: float, top: float) -> tuple[float, float]:
    """The speeds that the steepest and the flattest direction of a piece allow [m/s]."""
    sides = np.diff(span, axis=0)
    sizes = np.linalg.norm(sides, axis=1)
    moving = sizes > 1e-12 * (1.0 + float(sizes.max(initial=0.0)))
    if not moving.any():
        return top, top
    slopes = _slopes(sides[moving])
    if slopes is None:
        return min(top, up, down), top
    allowed = [_allowed(slope, up, down, top) for slope in slopes]
    return min(allowed), top if slopes[0] < 0.0 < slopes[1] else max(allowed)


def _slopes(sides: Floats) -> tuple[float, float] | None:
    """Angles of climb [rad] between which those of all positive sums of directions lie.

    A sum's level part is no shorter than what its parts have along their mean; None where one of
    them points away from that, so that a sum may be upright.
    """
    mean = sides[:, :2].sum(axis=0)
    size = float(np.linalg.norm(mean))
    ahead = sides[:, :2] @ (mean / size) if size > 0.0 else np.zeros(len(sides))
    if (ahead < 0.0).any() or (size == 0.0 and bool(sides[:, :2].any())):
        return None
    slopes = np.arctan2(sides[:, 2], ahead)
    return float(slopes.min()), float(slopes.max())


def _allowed(slope: float, up: float, down: float, top: float) -> float:
    """The largest speed along a way that climbs at an angle [rad]."""
    rise = math.sin(slope)
    if rise > 0.0:
        return min(top, up / rise)
    return min(top, down / -rise) if rise < 0.0 else top
