"""Hits of a scan that lie close together: what may be one thing."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.robot.perception.lidar import Scan

JOIN_M: Final = 0.15
"""Hits of neighbouring beams are of one thing if they are no farther apart than this [m]"""

JOIN_BEAMS: Final = 2.5
"""and so many distances from beam to beam."""

MAX_SKIPPED: Final = 1
"""Beams between them that may have measured nothing, or something else."""

RIM_M: Final = 0.1
"""What is hit so near to where beams end may go on where they don't reach [m]."""

MAX_BULGE: Final = 1.25
"""The disc of a cluster is no larger than this times half the distance of its ends."""


@dataclass(frozen=True, eq=False)
class HitCluster:
    """Hits that may be of one thing, and a disc that they lie in.

    The disc touches the two outermost beams and the nearest hit, as a disc would that is seen: its
    middle stays where it is when the robot goes round it, which the mean of the hits doesn't.

    Attributes:
        hits: Indices of its hits among those of the scan, in the order of beams, shape (k,).
        points: These [m], shape (k, 2).
        center: The middle of the disc [m], shape (2,).
        radius: Its radius [m].
        is_cut: A part of it may be hidden: by something nearer, at the edge of the field of view,
            or beyond the reach of the beams.
    """

    hits: Ints
    points: Floats
    center: Floats
    radius: float
    is_cut: bool


def clusters_of(scan: Scan, chosen: Flags) -> tuple[HitCluster, ...]:
    """The clusters of some hits of a scan, in the order of beams.

    Args:
        scan: A look round.
        chosen: Which of its hits to take, shape (h,).

    Example:
        >>> ranges = np.full(100, np.inf)
        >>> ranges[20:24], ranges[24:26] = 3.0, 5.0
        >>> scan = Scan((0.0, 0.0), 0.0, -0.5, 0.01, 9.0, ranges)
        >>> [cluster.hits.tolist() for cluster in clusters_of(scan, np.full(6, True))]
        [[0, 1, 2, 3], [4, 5]]
    """
    beams = np.flatnonzero(np.isfinite(scan.ranges))
    taken = np.flatnonzero(chosen)
    if not taken.size:
        return ()
    points, ranges = scan.hits[taken], scan.ranges[beams[taken]]
    following = np.roll(np.arange(taken.size), -1)
    skipped = beams[taken[following]] - beams[taken]
    if _is_full_turn(scan):
        skipped %= len(scan.ranges)
    apart = np.hypot(*(points[following] - points).T)
    most = JOIN_M + JOIN_BEAMS * scan.angle_increment * np.maximum(ranges, ranges[following])
    joined = (skipped > 0) & (skipped <= 1 + MAX_SKIPPED) & (apart <= most)
    return tuple(_cluster(scan, beams, taken[run]) for run in _runs(joined))


def _is_full_turn(scan: Scan) -> bool:
    return len(scan.ranges) >= round(math.tau / scan.angle_increment)


def _runs(joined: Flags) -> list[Ints]:
    """Indices in a round that are joined to the next, run by run; the first begins the first."""
    ends = np.flatnonzero(~joined)
    order = np.arange(joined.size)
    if not ends.size:
        return [order]
    if not joined[-1]:
        return np.split(order, ends[:-1] + 1)
    rolled = np.roll(order, -(int(ends[-1]) + 1))
    return np.split(rolled, np.cumsum(np.diff(ends, prepend=ends[-1] - joined.size))[:-1])


def _cluster(scan: Scan, beams: Ints, hits: Ints) -> HitCluster:
    points = scan.hits[hits]
    ranges = scan.ranges[beams[hits]]
    eye = np.asarray(scan.position[:2])
    width = float(np.hypot(*(points[-1] - points[0])))
    count = (int(beams[hits[-1]]) - int(beams[hits[0]])) % len(scan.ranges)
    half = 0.5 * scan.angle_increment * count
    near = float(ranges.min())
    radius = 0.5 * MAX_BULGE * width
    if half < 0.5 * math.pi and math.sin(half) < 1.0:
        radius = min(radius, near * math.sin(half) / (1.0 - math.sin(half)))
    bearing = scan.first_direction + scan.angle_increment * int(beams[hits[0]]) + half
    center = eye + (near + radius) * np.array((math.cos(bearing), math.sin(bearing)))
    covering = max(radius, float(np.hypot(*(points - center).T).max()))
    return HitCluster(hits, points, center, covering, _is_cut(scan, beams[hits], ranges))


def _is_cut(scan: Scan, beams: Ints, ranges: Floats) -> bool:
    """Whether the beams beside a cluster end before it, or there are none."""
    for edge, step, own in ((int(beams[0]), -1, ranges[0]), (int(beams[-1]), 1, ranges[-1])):
        if own > scan.range_max - RIM_M:
            return True
        beside = edge + step
        if _is_full_turn(scan):
            beside %= len(scan.ranges)
        if not 0 <= beside < len(scan.ranges) or scan.free[beside] < own:
            return True
    return False
