"""Where a path lies in areas with a speed of their own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.mission.world_spec import SpeedZone

ZONE_EDGE_M = 1e-6
"""What is nearer to a zone than this counts as inside [m]."""

MAX_ZONE_HALVINGS = 40  # halvings of a span; then a piece is taken as inside


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


def slow_parts(spans: Floats, zones: Sequence[SpeedZone]) -> list[tuple[float, float, float]]:
    """The parts of a curve that may lie in zones.

    Nothing that lies in a zone is missing; what is farther than ``ZONE_EDGE_M`` from it is not
    there, except that near along the curve to where it enters or leaves. A piece of a span lies in
    the hull of its control points: one whose hull is outside is left out, one whose hull is inside
    is taken, all others are halved. In space the zone stands upright on its polygon.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d), d >= 2.
        zones: Where the reference point of the robot has to be slower.

    Returns:
        First and last parameter (span k runs from k to k + 1) and speed [m/s], in no order.

    Raises:
        GeometryError: For a curve of one dimension, or a polygon that is none.

    Example:
        >>> zone = SpeedZone(polygon=[(1, -1), (2, -1), (2, 1), (1, 1)], max_speed_mps=0.5)
        >>> line = np.array([[[0.0, 0], [1, 0], [2, 0], [3, 0]]])
        >>> [np.round(part, 6).tolist() for part in slow_parts(line, [zone])]
        [[0.333333, 0.666667, 0.5]]
    """
    if not zones:
        return []
    if spans.shape[2] < 2:
        raise GeometryError("a path of one dimension has no speed zones")
    areas = np.array([_area(zone) for zone in zones], dtype=object)
    wide = shapely.buffer(areas, ZONE_EDGE_M, join_style="mitre")
    shapely.prepare(areas)
    shapely.prepare(wide)
    hulls = _hulls(spans[:, :, :2])
    span, zone = (index.ravel() for index in np.indices((len(spans), len(zones))))
    met = shapely.intersects(areas[zone], hulls[span])
    span, zone = span[met], zone[met]
    inside: list[tuple[Floats, Floats, NDArray[np.intp]]] = []
    low, high, pieces = (
        span.astype(np.float64),
        span.astype(np.float64) + 1.0,
        spans[span][:, :, :2],
    )
    for depth in range(MAX_ZONE_HALVINGS + 1):
        hulls = _hulls(pieces)
        taken = shapely.covers(wide[zone], hulls)
        small = np.abs(np.diff(pieces, axis=1)).max(axis=(1, 2), initial=0.0) < 0.3 * ZONE_EDGE_M
        taken |= shapely.intersects(areas[zone], hulls) & (small | (depth == MAX_ZONE_HALVINGS))
        inside.append((low[taken], high[taken], zone[taken]))
        go = ~taken & shapely.intersects(areas[zone], hulls)
        if not go.any():
            break
        pieces, zone = _halved(pieces[go]), np.tile(zone[go], 2)
        middle = 0.5 * (low[go] + high[go])
        low, high = np.concatenate((low[go], middle)), np.concatenate((middle, high[go]))
    return _merged(inside, zones)


def _area(zone: SpeedZone) -> shapely.Polygon:
    area = shapely.Polygon(zone.polygon)
    if not area.is_valid or area.is_empty:
        reason = shapely.is_valid_reason(area)
        raise GeometryError(f"the polygon of speed zone '{zone.name or ''}' is no area: {reason}")
    return area


def _hulls(pieces: Floats) -> NDArray[np.object_]:
    return np.asarray(shapely.convex_hull(shapely.linestrings(pieces)))


def _halved(pieces: Floats) -> Floats:
    """The first halves of pieces and then the second halves, by de Casteljau's construction."""
    a = 0.5 * (pieces[:, 1:] + pieces[:, :-1])
    b = 0.5 * (a[:, 1:] + a[:, :-1])
    c = 0.5 * (b[:, 1] + b[:, 0])
    first = np.stack((pieces[:, 0], a[:, 0], b[:, 0], c), axis=1)
    second = np.stack((c, b[:, 1], a[:, 2], pieces[:, 3]), axis=1)
    return np.concatenate((first, second))


def _merged(
    inside: Sequence[tuple[Floats, Floats, NDArray[np.intp]]], zones: Sequence[SpeedZone]
) -> list[tuple[float, float, float]]:
    """Pieces that touch as one part, zone by zone."""
    low, high, zone = (np.concatenate(column) for column in zip(*inside, strict=True))
    parts = []
    for k, one in enumerate(zones):
        order = np.argsort(low[zone == k])
        starts, ends = low[zone == k][order], high[zone == k][order]
        if not starts.size:
            continue
        new = np.flatnonzero(np.append(True, starts[1:] > ends[:-1]))
        last = np.append(new[1:], starts.size) - 1
        speed = float(one.max_speed_mps)
        parts += [(float(starts[i]), float(ends[j]), speed) for i, j in zip(new, last, strict=True)]
    return parts
