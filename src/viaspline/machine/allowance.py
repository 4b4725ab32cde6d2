"""How far from its path a driven body gets: measured in trial drives, with a margin."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.machine.drive_ahead import is_random
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.robot_model import steers_slowly
from viaspline.machine.steering_reserve import ENOUGH_RESERVE, steering_reserve
from viaspline.machine.tracking import Tracking
from viaspline.machine.trial_drive import follow, trackings
from viaspline.mission.robot_parts import RobotSpec
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory

TRIAL_SEEDS = tuple(range(7001, 7017))
"""Of the trial drives; where nothing is random one drive is as good as all."""

ERROR_MARGIN, UNEVEN_ERROR_MARGIN = 1.3, 1.6
"""By which the allowance is larger than the largest deviation of the trial drives, and that for
robots that steer slowly and for bends that leave steering too little to correct with: there the
largest deviation of drives is several times their median. With so many drives about 0.3 % of others
are farther off; with three, and half as much again, it was 5 %; see benchmarks/README.md."""

STEADY_ERROR_MARGIN, UNEVEN_STEADY_ERROR_MARGIN = 1.5, 2.0
"""Those where nothing is random, for what no trial drive has: commands that come late."""

RESERVE_SLACK = 0.01
"""By which a path that was laid to leave enough steering may leave less, for its rounding."""

SLALOM_BENDS = 6
"""Of the slalom that stands for paths that are laid under way."""

UNMEASURED_M = 0.005
"""What is added for what a trial drive leaves out: the curve through the steps, rounding [m]."""


def allowance(
    path: PiecewiseCubic, trajectory: Trajectory, robot: RobotSpec, what: str = "its path"
) -> float:
    """The tracking error that a robot's clearance has to allow for on a path [m].

    Args:
        path: In the plane.
        trajectory: Its time law.
        robot: Its body, drive and localisation.
        what: What the path is called where the robot can't follow it.

    Raises:
        GeometryError: When the robot doesn't come to the end of the path.

    Example:
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.trajectory.retime import retime
        >>> line = PiecewiseCubic([[[0, 0], [10, 0], [20, 0], [30, 0]]])
        >>> trajectory = retime(line, Limits(max_speed=2.0, max_accel=1.0))
        >>> allowance(line, trajectory, RobotSpec(drive={"differential": {"track_m": 0.5}})) < 0.05
        True
    """
    return kept_for(largest_deviation(path, trajectory, robot, what), path, robot)


def kept_for(largest: float, path: PiecewiseCubic, robot: RobotSpec) -> float:
    """What to keep beyond the clearance where trial drives get so far beside a path [m].

    Args:
        largest: See ``largest_deviation`` [m].
        path: In the plane.
        robot: Its body, drive and localisation.
    """
    even, uneven = (
        (ERROR_MARGIN, UNEVEN_ERROR_MARGIN)
        if is_random(robot)
        else (STEADY_ERROR_MARGIN, UNEVEN_STEADY_ERROR_MARGIN)
    )
    margin = even if _is_even(path, robot) else uneven
    return margin * largest + UNMEASURED_M


def largest_deviation(
    path: PiecewiseCubic, trajectory: Trajectory, robot: RobotSpec, what: str = "its path"
) -> float:
    """How far any point of a robot's body gets beside its path in trial drives [m].

    Args:
        path: In the plane.
        trajectory: Its time law.
        robot: Its body, drive and localisation.
        what: What the path is called where the robot can't follow it.

    Raises:
        GeometryError: When the robot doesn't come to the end of the path.
    """
    reach = 0.0 if robot.footprint is None else robot.outer_radius
    largest = 0.0
    for tracking, finished in _trials(path, trajectory, robot):
        if not finished:
            raise GeometryError(
                f"the robot can't follow {what}: in a trial drive it was {tracking.times[-1]:.0f} "
                f"s under way at {tracking.progress[-1]:.1f} m of {path.length:.1f} m; "
                f"give it {tracking_remedy(robot)}"
            )
        largest = max(largest, tracking.body_deviation(reach))
    if not math.isfinite(largest):
        raise GeometryError(
            f"the robot can't follow {what} at all; give it {tracking_remedy(robot)}"
        )
    return largest


def _trials(
    path: PiecewiseCubic, trajectory: Trajectory, robot: RobotSpec
) -> Iterable[tuple[Tracking, bool]]:
    """What trial drives are off from their path, and whether they came to its end."""
    if is_random(robot):
        return trackings(path, trajectory, robot, TRIAL_SEEDS)
    track = follow(path, trajectory, robot)
    return [(track.tracking, track.finished)]


def _is_even(path: PiecewiseCubic, robot: RobotSpec) -> bool:
    """Whether the largest deviations of a robot's drives along a path are much alike."""
    reserve = steering_reserve(robot, path.max_curvature()[0])
    return reserve >= ENOUGH_RESERVE - RESERVE_SLACK and not steers_slowly(robot)


def allowance_on_bends(robot: RobotSpec, radius: float) -> float:
    """The tracking error to allow for on bends that nobody knows yet [m].

    It is measured on a slalom as tight as a re-planned path may be.

    Args:
        robot: Its body, drive and localisation.
        radius: The least radius of bends that is to be expected [m]; its turning circle if that is
            wider.
    """
    tight = max(radius, 1.2 * (robot.turn_radius or 0.0))
    posts = np.arange(SLALOM_BENDS + 2)
    aside = np.where((posts == 0) | (posts == SLALOM_BENDS + 1), 0.0, (-1.0) ** posts)
    points = tight * np.column_stack((4.0 * posts, aside))
    slalom = CardinalSpline(points, knots="chordal", tangents="continuous")
    bends = f"bends of {tight:.3g} m, which a path that is laid under way may have"
    return allowance(slalom, retime(slalom, limits_of(robot)), robot, bends)


def tracking_remedy(robot: RobotSpec) -> str:
    """What lets a robot follow its path, or what it is planned by where it can't."""
    steered = None if robot.drive is None else robot.drive.ackermann
    slow = steered is not None and steered.max_steer_rate_degps is not None
    faster = ", faster steering (max_steer_rate_degps)" if slow else ""
    return f"{TRACKING_REMEDY}{faster}, or say what to keep by tracking_error_m"


TRACKING_REMEDY = (
    "a lower max_speed_mps, softer limits (max_lateral_accel_mps2), less delay or less noise"
)
