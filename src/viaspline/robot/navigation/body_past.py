"""Whether a body that is no disc keeps clear of what moves: by proof, as it is turned.

Searches take it for the disc around it, which may meet what the body itself passes beside.

Tested through ``robot/simulation/test_body_among_movers``.
"""

from __future__ import annotations

from viaspline.curve.path import Path
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.spacetime.driven_body import driven_body
from viaspline.trajectory.moving_certificate import keeps_from_moving
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles


def body_keeps_clear(
    task: DriveTask, moving: MovingObstacles, path: Path, law: Trajectory, hold: float
) -> bool:
    """Whether it is proven that a polygonal body keeps what is asked from all that moves.

    Args:
        task: What is asked of the drive.
        moving: What moves.
        path: What is driven.
        law: When.
        hold: For how long the robot stands at the end [s].
    """
    needs = task.requirements
    if needs.footprint is None:
        return False
    body = driven_body(needs, task.mission.robot, path, law, hold=hold)
    return keeps_from_moving(body, moving, needs.kept + task.apart)
