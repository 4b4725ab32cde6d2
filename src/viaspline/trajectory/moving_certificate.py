"""The certificate in space-time: a proven distance between a drive and everything that moves."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viaspline.curve.certificate import PROOF_SLACK_M, PROOF_TOLERANCE_M
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.handed_in import check_kind, number_from, room_from
from viaspline.kernels.arrays import Floats
from viaspline.kernels.motion import timed_path as columns
from viaspline.kernels.motion.moving_clearance import moving_tightest
from viaspline.kernels.motion.timed_path import LAW_COLUMNS, TimedPath
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.outline import outline

POINT: Floats = np.zeros((1, 2))
"""The outline of a disc, whose radius comes off at the end."""
OFF_PATH_SHARE = 1e-9
"""Of a path's length, by which a time law may end beyond it by rounding."""


@told_in_lines
@dataclass(frozen=True)
class MovingCertificate:
    """What is proven of a drive's distance from all that moves.

    Attributes:
        clearance: Proven lower bound of the distance between the robot's body and every moving
            obstacle, wherever within its error that is, from the first instant of the time law to
            the last one, and for as long as the robot was to stand there [m]; never above the true
            one, and within 1 mm of it. Infinite when nothing moves.
        required: The clearance that was asked for [m].
        tightest_at_s: When it is tightest [s].
        tightest_at: Where the robot is then [m], (x, y) or in space (x, y, z).
        tightest_distance: How far along the path that is [m].
        obstacle: The name of the obstacle that is nearest then; None when there is none.
        heading: The heading of a polygonal body then [rad]; None for a disc.
    """

    clearance: float
    required: float
    tightest_at_s: float
    tightest_at: tuple[float, ...]
    tightest_distance: float
    obstacle: str | None
    heading: float | None = None

    @property
    def holds(self) -> bool:
        """Whether the proven clearance is the one that was asked for, to a micrometre."""
        return self.clearance >= self.required - PROOF_SLACK_M


def certify_moving(
    path: PiecewiseCubic,
    trajectory: Trajectory,
    moving: MovingObstacles,
    clearance: float,
    *,
    radius: float = 0.0,
    footprint: ArrayLike | None = None,
    heading: float | None = None,
    hold: float = 0.0,
) -> MovingCertificate:
    """Prove how far the body stays from all that moves, over continuous time.

    The robot is on the exact curve when the exact law has it there, and every obstacle where its
    motion has it, or as far from there as its error may be. Both are taken as going straight on for
    a while, which makes the least distance that of a segment; how far they bow out from that is
    bounded, and what may be tightest is halved in time until it is known to a millimetre.

    Args:
        path: What is driven: any piecewise cubic; of a curve in space, its ground track counts.
        trajectory: Its time law, by the clock of the obstacles' motions.
        moving: The obstacles.
        clearance: What is to be kept free between the body and everything that moves [m].
        radius: The robot's body, a disc [m]; what a footprint is grown by.
        footprint: The robot's body, a polygon in its own frame, x forward and y left, (k, 2) [m].
            Where the path has a corner it turns the short way, at any time while it is there; at a
            cusp it may turn either way.
        heading: The heading that a footprint keeps [rad]; None: it looks the way it goes.
        hold: For how long after the end of the law the robot stands there [s].

    Returns:
        A certificate, whether it holds or not: see ``MovingCertificate.holds``. Where a disc
        overlaps something the clearance is negative by how deep; where a footprint does, by
        ``radius`` and the error.

    Raises:
        GeometryError: The curve is of another dimension, the law leaves it, the footprint is no
            polygon about the reference point, or a number is not finite, or a length of time,
            the clearance or the radius below 0.

    Example:
        >>> from viaspline.curve.cardinal import CardinalSpline
        >>> from viaspline.mission.shapes.obstacle import Obstacle
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.trajectory.retime import retime
        >>> cart = Obstacle(
        ...     name="cart",
        ...     circle={"center": (0, 0), "radius": 1},
        ...     motion={"from": (10, -9), "velocity_mps": (0, 1)},
        ... )
        >>> path = CardinalSpline([(0, 0), (10, 0), (20, 0)])
        >>> law = retime(path, Limits(max_speed=2, max_accel=1))
        >>> proven = certify_moving(path, law, MovingObstacles([cart]), 0.5, radius=0.25)
        >>> proven.obstacle, round(proven.clearance, 2), proven.holds
        ('cart', 1.43, True)
        >>> round(proven.tightest_at_s, 1), round(proven.tightest_distance, 1)
        (6.6, 11.2)
    """
    clearance, radius = room_from(clearance, radius)
    return certified_moving(
        path, trajectory, moving, clearance, radius, footprint, heading=heading, hold=hold
    )  # fmt: skip


def certified_moving(
    path: PiecewiseCubic,
    trajectory: Trajectory,
    moving: MovingObstacles,
    clearance: float,
    radius: float,
    footprint: ArrayLike | None,
    *,
    heading: float | None,
    hold: float,
) -> MovingCertificate:
    """See ``certify_moving``; for robots that stand nearer to something than they should as well.

    Args:
        path: See there, and the others.
        trajectory: Likewise.
        moving: Likewise.
        clearance: Below 0 where the body may overlap something by that [m].
        radius: Likewise.
        footprint: Likewise.
        heading: Likewise.
        hold: Likewise.
    """
    check_kind("moving", moving, MovingObstacles, "give MovingObstacles([...])")
    lower, _, instant, distance, x, y, facing, index = _tightest(
        path, trajectory, moving, clearance + radius, footprint, heading, hold, PROOF_TOLERANCE_M
    )
    return MovingCertificate(
        clearance=lower - radius,
        required=clearance,
        tightest_at_s=instant,
        tightest_at=(x, y),
        tightest_distance=distance,
        obstacle=None if index < 0 else moving.name(index),
        heading=None if math.isnan(facing) else facing,
    )


def keeps_from_moving(
    path: PiecewiseCubic,
    trajectory: Trajectory,
    moving: MovingObstacles,
    clearance: float,
    radius: float,
    footprint: ArrayLike | None,
    *,
    heading: float | None,
    hold: float,
) -> bool:
    """Whether a certificate of the same would hold; sooner, for it isn't found out by how much.

    Args:
        path: See ``certified_moving``, and the others.
        trajectory: Likewise.
        moving: Likewise.
        clearance: Likewise.
        radius: Likewise.
        footprint: Likewise.
        heading: Likewise.
        hold: Likewise.
    """
    required = clearance + radius
    lower = _tightest(path, trajectory, moving, required, footprint, heading, hold, math.inf)[0]
    return lower >= required - PROOF_SLACK_M


def _tightest(
    path: PiecewiseCubic,
    trajectory: Trajectory,
    moving: MovingObstacles,
    required: float,
    footprint: ArrayLike | None,
    heading: float | None,
    hold: float,
    tolerance: float,
) -> tuple[float, float, float, float, float, float, float, int]:
    """See ``moving_tightest``."""
    timed = timed_path(path, trajectory)
    body = POINT if footprint is None else outline(footprint)
    held = math.nan if heading is None else number_from("heading", heading)
    least = required - PROOF_SLACK_M
    return moving_tightest(
        timed, moving.packed, body, held, _checked_hold(hold), tolerance, least
    )  # fmt: skip


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
