"""How near a driven robot was to its path, and its exact motion from step to step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.closed_loop import deviations
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.kernels.tracking.reference_path import ReferencePath
from viaspline.presentable.compared_by_value import ComparedByValue


class Percentiles(NamedTuple):
    """The median, the 99th percentile and the greatest of the sizes of an error."""

    p50: float
    p99: float
    max: float


@dataclass(frozen=True, eq=False)
class Tracking(ComparedByValue):
    """What a robot's true state was off from what its path and its time law asked.

    Attributes:
        times: [s], shape (n,).
        progress: Distance along the path of the place that is nearest to the robot [m], (n,).
        cross_track: How far beside that place it was, left is positive [m], (n,).
        heading_error: Its heading less the one that it should have there [rad], (n,).
        along_track: How far behind the place was where it should have been [m], (n,).
        moving: Whether it should have been on its way, (n,). At rest it may turn on the spot, and
            what it is off is still what it was off when it stopped.
    """

    times: Floats
    progress: Floats
    cross_track: Floats
    heading_error: Floats
    along_track: Floats
    moving: NDArray[np.bool_]

    @classmethod
    def of(
        cls, model: DriveModel, reference: ReferencePath, notes: Floats, rows: Floats
    ) -> Tracking:
        """The errors of a drive.

        Args:
            model: What drove.
            reference: The path.
            notes: Of every period of the controller, shape (m, NOTES), m >= 1.
            rows: Of every step of the motion: time, x, y, heading, …, shape (n, ROW).
        """
        off = deviations(model, reference, notes, rows)
        return cls(rows[:, 0], off[:, 0], off[:, 1], off[:, 2], off[:, 3], off[:, 4] == 0.0)

    @property
    def cross(self) -> Percentiles:
        """Of the offset to the side, while it was on its way [m]."""
        return self._percentiles(self.cross_track)

    @property
    def heading(self) -> Percentiles:
        """Of the heading error, while it was on its way [rad]."""
        return self._percentiles(self.heading_error)

    @property
    def along(self) -> Percentiles:
        """Of the error along the path, while it was on its way [m]."""
        return self._percentiles(self.along_track)

    def body_deviations(self, reach: float) -> Floats:
        """How far any point of the body was from where it would have been on the path [m], (n,).

        A point that lies R from the reference point is off by the offset to the side and, through
        the heading error h, by 2 R sin(h/2) at most. A disc is not turned by anything.

        Args:
            reach: R of the farthest corner; 0 for a disc [m].
        """
        turned = np.where(self.moving, np.abs(self.heading_error), 0.0)
        off: Floats = np.abs(self.cross_track) + 2.0 * reach * np.sin(0.5 * turned)
        return off

    def body_deviation(self, reach: float) -> float:
        """The greatest of these in all of the drive [m]; see ``body_deviations``."""
        return float(self.body_deviations(reach).max(initial=0.0))

    def _percentiles(self, errors: Floats) -> Percentiles:
        sizes = np.abs(errors[self.moving])
        if not sizes.size:
            return Percentiles(0.0, 0.0, 0.0)
        return Percentiles(*(float(x) for x in np.percentile(sizes, [50.0, 99.0, 100.0])))
