"""Whether a robot that rests stays where it is, and doesn't correct its place there.

A robot with a drive that should stand gets to its place while it turns, and what it measures of
that is noise as well: by centimetres a second it goes to and fro. Where something may come it isn't
to be touched meanwhile, so it leaves that until nothing may touch it for so long as it needs to
stand again. It turns as before: of a body the disc about it is kept clear.
"""

from __future__ import annotations

import math

from viaspline.kernels.tracking.control_law import MAX_SPOT_SPEED_MPS
from viaspline.machine.settling import settling_time
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.yielding.may_come import WhatMayCome, kept_to_what_comes
from viaspline.trajectory.passive_safety import touched_from


def stays_put(task: DriveTask, progress: Progress, schedule: Schedule, coming: WhatMayCome) -> bool:
    """Whether something may touch a robot that rests before it would stand again.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        schedule: What it means to do.
        coming: What may come by this look.

    Returns:
        Never for one that follows exactly, and without passive safety.
    """
    things, controller = task.mission.robot.moving, progress.controller
    if things is None or things.safety == "none" or controller is None:
        return False
    distance, speed, accel = (float(x) for x in schedule.trajectory.state_at(progress.time))
    if speed > 0.0 or accel != 0.0:
        return False
    model, period = controller.model, controller.period
    lasts = model.delay + settling_time(model, MAX_SPOT_SPEED_MPS, period)
    keep = kept_to_what_comes(task)
    premises, begin = coming.premises, coming.sight.time
    return touched_from(schedule.path, distance, begin, lasts, premises, keep) < math.inf
