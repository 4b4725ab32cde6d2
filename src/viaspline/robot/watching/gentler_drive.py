"""A robot that was farther beside its path than was kept is slower then, and steers more gently.

What a machine reacts to later than its model says is corrected too late, and so too much: it swings
about its path, more and more. Gains that are lower, and a speed that is, calm that down.
"""

from __future__ import annotations

from dataclasses import replace

from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.progress import Progress

SLOWER = 0.6
"""Of its greatest speed, with which a robot goes on whose model was wrong,"""

SLOWER_UNMODELLED = 0.8
"""and one that has none: nothing was kept for it, so less is wrong,"""

LEAST_SHARE = 0.25
"""but no less than this of the speed that was asked for."""

GENTLER, MAX_CONVERGENCE_S = 1.6, 4.0
"""By which the time is longer in which a deviation dies out; at most so long [s]."""


def gentler_drive(task: DriveTask, progress: Progress) -> tuple[DriveTask, Progress]:
    """A drive with a lower speed and gentler steering from now on.

    Args:
        task: What is asked of it.
        progress: How far the robot has come, with its controller.

    Example:
        >>> from viaspline.machine.machine_limits import limits_of
        >>> from viaspline.mission.model import Mission
        >>> from viaspline.robot.navigation.drive_task import requirements_under_way
        >>> mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [5, 0]}})
        >>> limits, kept = limits_of(mission.robot), requirements_under_way(mission, 0.0)
        >>> task = DriveTask(mission, kept, limits, reaction=0.1)
        >>> gentler_drive(task, Progress(0.0))[0].limits.max_speed
        1.6
    """
    asked, now = task.mission.robot.max_speed_mps, task.limits.max_speed
    share = SLOWER_UNMODELLED if task.model is None else SLOWER
    speed = max(share * now, min(LEAST_SHARE * asked, now))
    task = replace(task, limits=replace(task.limits, max_speed=speed))
    controller = progress.controller
    if task.model is None or controller is None:
        return task, progress
    longer = min(GENTLER * task.model.convergence_time, MAX_CONVERGENCE_S)
    model = task.model._replace(convergence_time=max(longer, task.model.convergence_time))
    return replace(task, model=model), replace(
        progress, controller=replace(controller, model=model)
    )
