"""The proof that a robot's body keeps clear of what moves, whoever asks for it.

Tested through ``spacetime/test_law_on_path``.
"""

from __future__ import annotations

from viaspline.curve.path import Path
from viaspline.mission.robot_parts import RobotSpec
from viaspline.planning.problem.requirements import Requirements
from viaspline.trajectory.moving_certificate import (
    MovingCertificate,
    certified_moving,
    keeps_from_moving,
)
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles


def certify_body(
    requirements: Requirements,
    robot: RobotSpec,
    path: Path,
    law: Trajectory,
    moving: MovingObstacles,
    *,
    hold: float,
    apart: float = 0.0,
) -> MovingCertificate:
    """What is proven of a drive's distance from all that moves, of the body as it is turned.

    Args:
        requirements: What it keeps, and of which body.
        robot: How that looks as it goes.
        path: What is driven.
        law: When.
        moving: What moves.
        hold: For how long the robot stands at the end [s].
        apart: What is kept beyond what is required [m].
    """
    return certified_moving(
        path, law, moving, requirements.kept + apart, requirements.disc_radius,
        requirements.footprint, heading=robot.held_heading, hold=hold,
    )  # fmt: skip


def keeps_past_moving(
    requirements: Requirements,
    robot: RobotSpec,
    path: Path,
    law: Trajectory,
    moving: MovingObstacles,
    *,
    hold: float,
    apart: float = 0.0,
) -> bool:
    """Whether that proof holds, which is told sooner than how much is kept.

    Args:
        requirements: See ``certify_body``, and the others.
        robot: Likewise.
        path: Likewise.
        law: Likewise.
        moving: Likewise.
        hold: Likewise.
        apart: Likewise.
    """
    return keeps_from_moving(
        path, law, moving, requirements.kept + apart, requirements.disc_radius,
        requirements.footprint, heading=robot.held_heading, hold=hold,
    )  # fmt: skip
