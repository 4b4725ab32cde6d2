"""What a robot under way would meet that moves.

Tested through ``robot/yielding/test_give_way``.
"""

from __future__ import annotations

from viaspline.curve.path import Path
from viaspline.robot.navigation.body_past import body_keeps_clear
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.spacetime.meetings import Meeting, first_meeting
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles

LOOK_S = 8.0
"""It looks at least so far ahead [s]."""


def meeting_ahead(
    task: DriveTask, moving: MovingObstacles, path: Path, law: Trajectory, now: float
) -> Meeting | None:
    """What a law meets from now on, and a robot that stands at its end."""
    span = (now, max(law.end_time, now + LOOK_S))
    meeting = first_meeting(path, law, moving, task.kept_to_moving, span)
    if meeting is None or body_keeps_clear(task, moving, path, law, span[1] - law.end_time):
        return None
    return meeting
