"""Where things that move as a mission says are, and how far from a robot: with shapely alone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

Mover = dict[str, Any]
Floats = NDArray[np.float64]


def frames(mover: Mover, times: Floats) -> Floats:
    """x, y [m] and heading [rad] of its frame, (n, 3); nan while it isn't there."""
    rows = np.array([[*row, 0.0][:4] for row in mover["motion"]["keyframes"]], np.float64)
    begin, lasts = rows[0, 0], rows[-1, 0] - rows[0, 0]
    after, within = mover["motion"]["after"], times
    if after == "loop":
        within = begin + (times - begin) % lasts
    elif after == "bounce":
        into = (times - begin) % (2.0 * lasts)
        within = begin + np.minimum(into, 2.0 * lasts - into)
    found = np.column_stack([np.interp(within, rows[:, 0], rows[:, k]) for k in (1, 2, 3)])
    found[:, 2] = np.radians(found[:, 2])
    if after == "vanish":
        found[(times < begin) | (times >= begin + lasts)] = np.nan
    return found


def gaps(mover: Mover, times: Floats, places: Floats) -> Floats:
    """Distance of places (n, 2) from it [m], (n,); infinite while it isn't there."""
    x, y, heading = frames(mover, times).T
    east, north = places[:, 0] - x, places[:, 1] - y
    ahead = np.cos(heading) * east + np.sin(heading) * north
    aside = np.cos(heading) * north - np.sin(heading) * east
    there = np.isfinite(x)
    found = np.full(len(times), math.inf)
    at = shapely.points(ahead[there], aside[there])
    if "circle" in mover:
        shape, radius = shapely.Point(mover["circle"]["center"]), mover["circle"]["radius"]
    else:
        shape, radius = shapely.Polygon(mover["polygon"]), 0.0
    found[there] = shapely.distance(shape, at) - radius
    return found


def least_gaps(movers: Sequence[Mover], times: Floats, places: Floats, radius: float) -> Floats:
    """The least distance between a disc and all of them at each time [m], (n,)."""
    found = np.full(len(times), math.inf)
    for mover in movers:
        found = np.minimum(found, gaps(mover, times, places) - radius)
    return found
