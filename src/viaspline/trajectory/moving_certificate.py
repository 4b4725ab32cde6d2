"""The certificate in space-time: a proven distance between a drive and everything that moves."""

from __future__ import annotations

import math
from dataclasses import dataclass

from numpy.typing import ArrayLike

from viaspline.curve.certificate import PROOF_SLACK_M, PROOF_TOLERANCE_M
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.handed_in import check_kind, room_from
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.trajectory.timed_body import TimedBody
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles


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
    body = TimedBody(path, trajectory, radius, footprint, heading, hold)
    return certified_moving(body, moving, clearance)


def certified_moving(
    body: TimedBody, moving: MovingObstacles, clearance: float
) -> MovingCertificate:
    """See ``certify_moving``; for robots that stand nearer to something than they should as well.

    Args:
        body: What is driven, and when.
        moving: The obstacles.
        clearance: What is asked for [m]; below 0 where the body may overlap something by that.
    """
    check_kind("moving", moving, MovingObstacles, "give MovingObstacles([...])")
    least = clearance + body.radius - PROOF_SLACK_M
    lower, _, instant, distance, x, y, facing, index = body.tightest(
        moving, least, PROOF_TOLERANCE_M
    )
    return MovingCertificate(
        clearance=lower - body.radius,
        required=clearance,
        tightest_at_s=instant,
        tightest_at=(x, y),
        tightest_distance=distance,
        obstacle=None if index < 0 else moving.name(index),
        heading=None if math.isnan(facing) else facing,
    )


def keeps_from_moving(body: TimedBody, moving: MovingObstacles, clearance: float) -> bool:
    """Whether a certificate of the same would hold; sooner, for it isn't found out by how much.

    Args:
        body: See ``certified_moving``, and the others.
        moving: Likewise.
        clearance: Likewise.
    """
    least = clearance + body.radius - PROOF_SLACK_M
    return body.tightest(moving, least, math.inf)[0] >= least
