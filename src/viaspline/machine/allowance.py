"""How far from its path a driven body gets: measured in trial drives, with a margin."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

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

TRIAL_STAY_S = 600.0
"""A trial drive stays nowhere for longer: who stands gets no farther beside its path [s]."""

MOST_TRIAL_S = 200_000.0
"""Longer ones aren't driven: one of two days takes half a minute, and a gigabyte [s]."""

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
    return TrialDrives(path, trajectory, robot, what).allowance


@dataclass(frozen=True)
class TrialDrives:
    """Simulated drives of a robot along a path: driven when their outcome is first asked for.

    Attributes:
        path: In the plane.
        trajectory: Its time law.
        robot: Its body, drive and localisation.
        what: What the path is called where the robot can't follow it.
    """

    path: PiecewiseCubic
    trajectory: Trajectory
    robot: RobotSpec
    what: str = "its path"

    @cached_property
    def allowance(self) -> float:
        """What to keep beyond the clearance for the robot's tracking error [m].

        Raises:
            GeometryError: When the robot doesn't come to the end of the path.
        """
        even, uneven = (
            (ERROR_MARGIN, UNEVEN_ERROR_MARGIN)
            if is_random(self.robot)
            else (STEADY_ERROR_MARGIN, UNEVEN_STEADY_ERROR_MARGIN)
        )
        margin = even if self._are_even else uneven
        return margin * self.largest_deviation + UNMEASURED_M

    @cached_property
    def largest_deviation(self) -> float:
        """How far any point of the robot's body gets beside the path [m].

        Raises:
            GeometryError: When the robot doesn't come to the end of the path.
        """
        robot = self.robot
        reach = 0.0 if robot.footprint is None else robot.outer_radius
        largest = 0.0
        for tracking, finished in self._drives():
            if not finished:
                raise GeometryError(
                    f"the robot can't follow {self.what}: in a trial drive it was "
                    f"{tracking.times[-1]:.0f} s under way at {tracking.progress[-1]:.1f} m of "
                    f"{self.path.length:.1f} m; give it {tracking_remedy(robot)}"
                )
            largest = max(largest, tracking.body_deviation(reach))
        if not math.isfinite(largest):
            raise GeometryError(
                f"the robot can't follow {self.what} at all; give it {tracking_remedy(robot)}"
            )
        return largest

    def _drives(self) -> Iterable[tuple[Tracking, bool]]:
        """What each is off from the path, and whether it came to its end."""
        law = self.trajectory.staying_at_most(TRIAL_STAY_S)
        if law.duration > MOST_TRIAL_S:
            raise GeometryError(
                f"the robot would be {law.duration:.3g} s under way on {self.what}, and a trial "
                f"drive takes {MOST_TRIAL_S:g} s at most; raise the limits that make it so slow, "
                "or leave out its drive and localisation"
            )
        if is_random(self.robot):
            return trackings(self.path, law, self.robot, TRIAL_SEEDS)
        track = follow(self.path, law, self.robot)
        return [(track.tracking, track.finished)]

    @property
    def _are_even(self) -> bool:
        """Whether the largest deviations of the drives are much alike."""
        reserve = steering_reserve(self.robot, self.path.max_curvature()[0])
        return reserve >= ENOUGH_RESERVE - RESERVE_SLACK and not steers_slowly(self.robot)


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
