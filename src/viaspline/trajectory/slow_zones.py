"""Stretches of a path with a lower speed.

Their beginnings and ends come from ``curve.slow_parts``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple


class Slow(NamedTuple):
    """A stretch of a path with a lower speed: from where to where [m], and how fast [m/s]."""

    start: float
    end: float
    speed: float


def slow_between(parts: Sequence[Slow], start: float, end: float) -> tuple[Slow, ...]:
    """What of some stretches lies between two distances along a path [m].

    Example:
        >>> slow_between([Slow(0, 2, 0.5), Slow(2, 3, 0.7)], 1.0, 2.0)
        (Slow(start=1.0, end=2, speed=0.5),)
    """
    inside = (Slow(max(p.start, start), min(p.end, end), p.speed) for p in parts)
    return tuple(part for part in inside if part.start < part.end)
