"""Where the robot's sensor has looked: a lattice of cells round the robot."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.kernels import sight
from viaspline.robot.lidar import Scan

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class SeenArea:
    """The cells round the robot that a beam has passed from edge to edge, and nothing beyond.

    The window moves with the robot; what falls behind is forgotten. So its size depends on how
    far ahead the robot has to look to stop, and not on how far it drives.

    Attributes:
        side: Of a cell [m].
        reach: How far from the robot the window extends [m].
        corner: Number of the window's first cell in the lattice, shape (2,).
        window: Which cells were seen, rows from below, shape (n, n), read-only.

    Example:
        >>> area = SeenArea.around((0.0, 0.0), side=0.1, reach=2.0)
        >>> beams = np.linspace(-np.pi, np.pi, 721)[:-1]
        >>> scan = Scan((0.0, 0.0), 0.0, -np.pi, beams[1] - beams[0], 1.0, np.full(720, np.inf))
        >>> area.with_scan(scan).count([(0.0, 0.0), (0.5, 0.5), (1.5, 0.0)], radius=0.2)
        2
    """

    side: float
    reach: float
    corner: NDArray[np.int64]
    window: Flags

    @classmethod
    def around(cls, position: ArrayLike, *, side: float, reach: float) -> SeenArea:
        """Nothing seen yet, round a position [m]."""
        half = int(np.ceil(reach / side))
        window = np.zeros((2 * half + 1, 2 * half + 1), np.bool_)
        return cls(side, reach, _corner(position, side, half), _frozen(window))

    def with_scan(self, scan: Scan, noise: float = 0.0) -> SeenArea:
        """The same with the window round a scan's place and with what its beams passed.

        Args:
            scan: The look round.
            noise: How much shorter than measured a beam may be [m].
        """
        area = self._moved_to(scan.position)
        window = area.window.copy()
        x, y = (float(value) for value in scan.position[:2])
        lengths = np.minimum(np.maximum(scan.free - noise, 0.0), self.reach)
        sight.mark_beams(
            window, area.corner, self.side, x, y, scan.first_direction, scan.angle_increment,
            lengths,
        )  # fmt: skip
        return replace(area, window=_frozen(window))

    def with_disc(self, position: ArrayLike, radius: float) -> SeenArea:
        """The same with a disc [m] that is known to be free: the robot stands in it."""
        window = self.window.copy()
        x, y = np.asarray(position, np.float64)[:2].tolist()
        sight.mark_disc(window, self.corner, self.side, x, y, radius)
        return replace(self, window=_frozen(window))

    def count(self, points: ArrayLike, radius: float) -> int:
        """How many of some points, from the first on, have only seen cells round them.

        A cell counts if it lies within ``radius`` of the point as a whole, and the cell that the
        point is in always does.

        Args:
            points: [m], shape (n, 2).
            radius: [m].
        """
        places = np.ascontiguousarray(np.asarray(points, np.float64)[:, :2])
        within = max(radius - np.sqrt(0.5) * self.side, 0.0)
        return int(sight.count_seen(self.window, self.corner, self.side, places, within))

    def _moved_to(self, position: ArrayLike) -> SeenArea:
        size = len(self.window)
        corner = _corner(position, self.side, size // 2)
        dx, dy = (corner - self.corner).tolist()
        if dx == dy == 0:
            return self
        window = np.zeros_like(self.window)
        if max(abs(dx), abs(dy)) < size:
            window[max(-dy, 0) : size - max(dy, 0), max(-dx, 0) : size - max(dx, 0)] = self.window[
                max(dy, 0) : size - max(-dy, 0), max(dx, 0) : size - max(-dx, 0)
            ]
        return replace(self, corner=corner, window=_frozen(window))


def _corner(position: ArrayLike, side: float, half: int) -> NDArray[np.int64]:
    here = np.floor(np.asarray(position, np.float64)[:2] / side).astype(np.int64)
    return here - half


def _frozen(window: Flags) -> Flags:
    window.flags.writeable = False
    return window
