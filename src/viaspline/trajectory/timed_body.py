"""A body on its way through time: a path, the law along it, and what goes there.

Tested through ``trajectory/test_moving_certificate``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.handed_in import check_kind, number_from
from viaspline.kernels.arrays import Floats
from viaspline.kernels.motion import timed_path as columns
from viaspline.kernels.motion.moving_clearance import moving_tightest
from viaspline.kernels.motion.timed_path import LAW_COLUMNS, TimedPath
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.outline import outline

POINT: Floats = np.zeros((1, 2))
"""The outline of a disc, whose radius comes off at the end."""
Tightest: TypeAlias = tuple[float, float, float, float, float, float, float, int]
"""What ``moving_tightest`` answers: the bounds, when, how far along, x, y, heading, of what."""
OFF_PATH_SHARE = 1e-9
"""Of a path's length, by which a time law may end beyond it by rounding."""


@dataclass(frozen=True)
class TimedBody:
    """A body on its way through time: what a certificate in space-time is of.

    Attributes:
        path: What is driven.
        trajectory: When, by the clock of the obstacles' motions.
        radius: The body, a disc [m]; what a footprint is grown by.
        footprint: The body, a polygon in its own frame, (k, 2) [m]; None: the disc alone.
        heading: The heading that a footprint keeps [rad]; None: it looks the way it goes.
        hold: For how long after the end of the law it stands there [s].
    """

    path: PiecewiseCubic
    trajectory: Trajectory
    radius: float
    footprint: ArrayLike | None
    heading: float | None
    hold: float

    def tightest(self, moving: MovingObstacles, least: float, tolerance: float) -> Tightest:
        """See ``moving_tightest``."""
        timed = timed_path(self.path, self.trajectory)
        body = POINT if self.footprint is None else outline(self.footprint)
        held = math.nan if self.heading is None else number_from("heading", self.heading)
        hold = _checked_hold(self.hold)
        return moving_tightest(timed, moving.packed, body, held, hold, tolerance, least)


def timed_path(path: PiecewiseCubic, trajectory: Trajectory) -> TimedPath:
    """A path and the time law along it as kernels take them.

    Raises:
        GeometryError: The path is not in the plane or in space, or the law leaves it.
    """
    check_kind("path", path, PiecewiseCubic, "give a CardinalSpline, or the path of a plan")
    check_kind("trajectory", trajectory, Trajectory, "give what retime answers")
    if path.dimension not in (2, 3):
        raise GeometryError(f"a curve of dimension {path.dimension} can't be certified; 2 or 3 can")
    last = float(trajectory.distances[-1])
    beyond = not path.closed and last > path.length + OFF_PATH_SHARE * (1.0 + path.length)
    if beyond or trajectory.distances[0] < -OFF_PATH_SHARE:
        raise GeometryError(
            f"the time law runs from {trajectory.distances[0]:g} m to {last:g} m and the path from "
            f"0 to {path.length:g} m; give the law of this path"
        )
    law = np.zeros((len(trajectory.times), LAW_COLUMNS))
    law[:, columns.TIME] = trajectory.times
    law[:, columns.DISTANCE] = trajectory.distances
    law[:, columns.SPEED] = trajectory.speeds
    law[:-1, columns.ACCELERATION] = trajectory.accelerations
    if trajectory.changes is not None and trajectory.jerks is not None:
        law[:-1, columns.CHANGE] = trajectory.changes
        law[:-1, columns.JERK] = trajectory.jerks
    return TimedPath(*path.packed_length, path.closed, law)


def _checked_hold(hold: float) -> float:
    hold = number_from("hold", hold)
    if not 0.0 <= hold < math.inf:
        raise GeometryError(f"hold is {hold} s; give a finite time of 0 or more")
    return hold
