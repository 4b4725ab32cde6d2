"""A robot's body on a drive, as certificates among what moves take it.

Tested through ``spacetime/test_law_on_path``.
"""

from __future__ import annotations

from viaspline.curve.path import Path
from viaspline.mission.robot_parts import RobotSpec
from viaspline.planning.problem.requirements import Requirements
from viaspline.trajectory.timed_body import TimedBody
from viaspline.trajectory.trajectory import Trajectory


def driven_body(
    requirements: Requirements, robot: RobotSpec, path: Path, law: Trajectory, *, hold: float
) -> TimedBody:
    """The body that requirements are of, as it is turned on its way.

    Args:
        requirements: Of which body.
        robot: How that looks as it goes.
        path: What is driven.
        law: When.
        hold: For how long the robot stands at the end [s].
    """
    radius, footprint = requirements.disc_radius, requirements.footprint
    return TimedBody(path, law, radius, footprint, robot.held_heading, hold)
