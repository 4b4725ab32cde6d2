"""A robot with a lidar stops before what it has not seen, and takes a small step if it sees none.

A sensor with a narrow field of view never shows all that the body is going to touch: a robot that
has stood and seen nothing in its way for a while trusts that it can probe the next cell.
"""

from __future__ import annotations

from dataclasses import replace

from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.law_horizon import is_due
from viaspline.robot.navigation.progress import SAME_PLACE_M, Progress
from viaspline.robot.navigation.reschedule import rescheduled_by_sight
from viaspline.robot.navigation.schedule import Schedule, Wait

PROBE_WAIT_S = 0.5
"""A robot that stands and sees nothing in its way trusts its next step after this time [s]."""


def within_sight(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule, speed: float
) -> Schedule:
    """The schedule that ends where the robot is not certain to be free any more.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: All that is known, by a lidar.
        schedule: What the robot has meant to do so far.
        speed: Of the robot [m/s].
    """
    belief, path, here = knowledge.belief, schedule.path, progress.distance
    assert belief is not None
    if not is_due(task, progress, knowledge, schedule):  # who found no way on still knows of none
        return schedule if schedule.is_blocked else replace(schedule, wait=None)
    schedule = rescheduled_by_sight(task, progress, knowledge, schedule, speed)
    if schedule.is_blocked:
        return schedule
    stuck = speed == 0.0 and float(schedule.trajectory.distances[-1]) <= here + SAME_PLACE_M
    if not stuck or progress.dwell is not None or here >= path.length - SAME_PLACE_M:
        return replace(schedule, wait=None)
    wait = schedule.wait or Wait(progress.time, progress.time + PROBE_WAIT_S)
    if progress.time < wait.again:
        return replace(schedule, wait=wait)
    probed_until = min(here + belief.cell_size, path.length)
    return replace(schedule, probed_until=probed_until, wait=None)
