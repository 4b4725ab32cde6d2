"""Does something move? It does if it is where nothing was, or nothing is where it was.

Unlike a velocity this isn't fooled by a wall of which ever more comes into sight.

Tested through ``robot/perception/moving/test_track_hits``.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.sensing.visible_region import seen_through
from viaspline.robot.perception.lidar import MAX_NOISE_SIGMAS, Scan

CLEARLY_M: Final = 0.05
"""So far beyond a point beams have to go for nothing to be there [m]."""

FINEST_M: Final = 0.2
"""Beams may be so far apart where they are to show that nothing is left of a small thing [m]."""

LEAST_SHARE: Final = 0.15
"""Of the points of a thing, so many say whether it moves."""


@dataclass(frozen=True, eq=False)
class Glimpse:
    """A thing as it was seen once: what a later look is compared with.

    Attributes:
        time: When [s].
        scan: The whole look.
        points: The hits that were of the thing [m], shape (k, 2).
        radius: Of the disc that they lay in [m].
    """

    time: float
    scan: Scan
    points: Floats
    radius: float


def has_moved(before: Glimpse, now: Glimpse, noise: float) -> bool:
    """Whether a thing that was seen twice has moved between.

    Args:
        before: The earlier look.
        now: The later one.
        noise: Standard deviation of a measured distance [m].
    """
    finest = max(min(before.radius, now.radius), 0.0)
    return (
        _share_seen_through(before.points, now.scan, finest, noise) >= LEAST_SHARE
        or _share_seen_through(now.points, before.scan, finest, noise) >= LEAST_SHARE
    )


def has_come(now: Glimpse, looks: Iterable[Scan], noise: float) -> bool:
    """Whether something is where an earlier look saw that nothing was.

    Args:
        now: The thing as it is seen.
        looks: Earlier ones.
        noise: Standard deviation of a measured distance [m].
    """
    return any(
        _share_seen_through(now.points, scan, now.radius, noise) >= LEAST_SHARE for scan in looks
    )


def is_seen_through(place: Floats, radius: float, scan: Scan, noise: float) -> bool:
    """Whether a look shows that nothing is left of a disc.

    Args:
        place: Its middle [m], shape (2,).
        radius: [m].
        scan: The look.
        noise: Standard deviation of a measured distance [m].
    """
    angles = 0.25 * np.pi * np.arange(8)
    rim = place + 0.7 * radius * np.column_stack((np.cos(angles), np.sin(angles)))
    points = np.concatenate((place[None], rim))
    return _share_seen_through(points, scan, max(radius, FINEST_M), noise) >= 1.0


def _share_seen_through(points: Floats, scan: Scan, finest: float, noise: float) -> float:
    """The share of points (k, 2) that beams on either side go clearly beyond."""
    x, y = (float(value) for value in scan.position[:2])
    margin = CLEARLY_M + 2.0 * MAX_NOISE_SIGMAS * noise
    through = seen_through(
        np.ascontiguousarray(points), x, y, scan.first_direction, scan.angle_increment, scan.free,
        finest, margin,
    )  # fmt: skip
    return float(np.mean(through))
