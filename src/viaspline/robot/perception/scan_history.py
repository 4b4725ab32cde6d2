"""The looks round that a robot remembers, and how far it can go inside of what they show.

Tested through ``robot/perception/test_belief``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.sensing.visible_region import body_seen_ahead, seen_ahead
from viaspline.robot.perception.body_front import BodyMotion, BodyRim
from viaspline.robot.perception.lidar import Scan

MIN_TURN_RAD = math.radians(20.0)
"""A look at the same place tells more if it was turned by so much [rad]."""


@dataclass(frozen=True, eq=False)
class ScanHistory:
    """The latest scan and older ones from other places near the robot.

    What was only seen from far behind is forgotten: so there are never many, however far the
    robot drives.

    Attributes:
        near: Scans farther away than this are forgotten [m].
        apart: From one to the next that is remembered, if the robot has not turned [m].
        noise: How much shorter than measured a beam may be [m].
        scans: The latest comes first.

    Example:
        >>> scan = Scan((0.0, 0.0), 0.0, -2.0, 0.01, 9.0, np.full(401, 2.0))
        >>> history = ScanHistory(near=5.0, apart=0.5).with_scan(scan)
        >>> places, ahead = np.array([(x, 0.0) for x in range(4)]), np.array([(1.0, 0.0)] * 4)
        >>> history.count(places, ahead, radius=0.5, gap=0.1)
        2
    """

    near: float
    apart: float
    noise: float = 0.0
    scans: tuple[Scan, ...] = ()

    def with_scan(self, scan: Scan) -> ScanHistory:
        """The history with one more look."""
        latest, older = self.scans[:1], self.scans[1:]
        if any(self._is_like(latest[0], other) for other in older):
            latest = ()
        kept = (
            other
            for other in latest + older
            if _gap(other, scan) <= self.near and other.has_beams_of(scan)
        )
        return replace(self, scans=(scan, *kept))

    def _is_like(self, one: Scan, other: Scan) -> bool:
        turned = abs(math.remainder(one.heading - other.heading, math.tau))
        return _gap(one, other) < self.apart and turned < MIN_TURN_RAD

    def count(self, places: Floats, ahead: Floats, radius: float, gap: float) -> int:
        """How many places of a disc's way it can take, from the first on, inside of what was seen.

        Args:
            places: Of its middle, close together [m], shape (n, 2).
            ahead: Unit vectors in which it moves there, shape (n, 2).
            radius: Of the disc [m].
            gap: Things smaller than this may be missed [m].
        """
        return int(seen_ahead(places, ahead, radius, gap, *self._packed)) if self.scans else 0

    def body_count(self, motion: BodyMotion, rim: BodyRim) -> int:
        """How many poses of a body's way it can take, from the first on, inside of what was seen.

        Args:
            motion: Of the body.
            rim: Where it has to be free; things between its points may be missed.
        """
        if not self.scans:
            return 0
        poses, moves, _ = motion
        return int(body_seen_ahead(poses, moves, rim.points, rim.normals, *self._packed))

    @cached_property
    def _packed(self) -> tuple[Floats, Floats, float, Floats]:
        """All scans for kernels; there is one."""
        origins = np.array([scan.position[:2] for scan in self.scans], np.float64)
        firsts = np.array([scan.first_direction for scan in self.scans])
        lengths = np.maximum([scan.free for scan in self.scans], self.noise) - self.noise
        return origins, firsts, float(self.scans[0].angle_increment), lengths


def _gap(one: Scan, other: Scan) -> float:
    return math.dist(one.position[:2], other.position[:2])
