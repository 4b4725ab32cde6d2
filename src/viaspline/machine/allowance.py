"""How far from its path a driven body gets: measured in trial drives, with a margin."""

from __future__ import annotations

import math

import numpy as np

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.robot_model import steers_slowly
from viaspline.machine.trial_drive import follow
from viaspline.mission.robot_parts import RobotSpec
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory

TRIAL_SEEDS = (7001, 7002, 7003)
"""Of the trial drives."""

ERROR_MARGIN = 1.5
"""By which the allowance is larger than what was measured. Errors from noise are about normal; in
drives of some minutes the largest is about four standard deviations, so this covers six."""

SLOW_TRIAL_SEEDS, SLOW_ERROR_MARGIN = (*TRIAL_SEEDS, *range(7004, 7010)), 2.0
"""Those for robots that steer slowly: what throws them off differs more from drive to drive. Of
400 drives with rates from 2 to 90 deg/s 30 were farther off than the others keep, 1 than these."""

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
    reach = 0.0 if robot.footprint is None else robot.outer_radius
    is_slow, largest = steers_slowly(robot), 0.0
    for seed in SLOW_TRIAL_SEEDS if is_slow else TRIAL_SEEDS:
        track = follow(path, trajectory, robot, seed=seed)
        if not track.finished:
            raise GeometryError(
                f"the robot can't follow {what}: in a trial drive it was {track.times[-1]:.0f} s "
                f"under way at {track.tracking.progress[-1]:.1f} m of {path.length:.1f} m; "
                f"give it {tracking_remedy(robot)}"
            )
        largest = max(largest, track.tracking.body_deviation(reach))
    if not math.isfinite(largest):
        raise GeometryError(
            f"the robot can't follow {what} at all; give it {tracking_remedy(robot)}"
        )
    return (SLOW_ERROR_MARGIN if is_slow else ERROR_MARGIN) * largest + UNMEASURED_M


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
