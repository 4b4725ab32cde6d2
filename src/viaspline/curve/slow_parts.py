"""The parts of a curve that lie in areas with a speed of their own.

Tested through ``trajectory/test_slow_zones``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.kernels.timing.zone_pieces import zone_pieces
from viaspline.mission.world_spec import SpeedZone

ZONE_EDGE_M = 1e-6
"""What is nearer to a zone than this counts as inside [m]."""

MAX_ZONE_HALVINGS = 40  # halvings of a span; then a piece is taken as inside


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
        First and last parameter (span k runs from k to k + 1) and speed [m/s], zone by zone.

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
    areas = [zone.corners for zone in zones]
    ends = np.cumsum([len(area) for area in areas])
    writable = np.array(spans, order="C")  # numba compiles for one kind
    found = zone_pieces(writable, np.concatenate(areas), ends, ZONE_EDGE_M, MAX_ZONE_HALVINGS)
    return [(low, high, float(zones[int(k)].max_speed_mps)) for low, high, k in found.tolist()]
