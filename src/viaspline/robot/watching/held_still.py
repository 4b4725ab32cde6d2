"""A robot that is held still, because it doesn't know what is true now, and how it goes on.

Tested through ``robot/watching/test_fresh_inputs``.
"""

from __future__ import annotations

from dataclasses import replace

from viaspline.errors import GeometryError
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.reschedule import braking_at_once, rescheduled
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.state import Command


def held_still(task: DriveTask, progress: Progress, schedule: Schedule) -> Schedule:
    """The schedule of a robot that brakes as hard as it can, and stands.

    One that stands and isn't to depart yet isn't to do so once it is let on either.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        schedule: What it means to do.
    """
    free = replace(schedule, committed_until=-float("inf"))
    speed = float(schedule.trajectory.state_at(progress.time)[1])
    stop = braking_at_once(task, progress, free, speed)
    held = free if speed > 0.0 else schedule
    return replace(held, trajectory=stop, timed_at=progress.time)


def let_on(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule
) -> Schedule:
    """The schedule of a robot that was held still and goes on.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: All that is known.
        schedule: By which it brakes.
    """
    speed = float(schedule.trajectory.state_at(progress.time)[1])
    try:
        return rescheduled(task, progress, knowledge, schedule, speed)
    except GeometryError:  # it is too fast for what comes: it stands first
        return schedule


def stop_command(task: DriveTask, command: Command) -> Command:
    """The command to stand, with the place of another one.

    Args:
        task: What is asked of the drive.
        command: Of the robot where it is.
    """
    drive = task.mission.robot.drive
    return replace(
        command,
        speed=0.0,
        acceleration=-task.limits.brake if command.speed > 0.0 else 0.0,
        curvature=0.0,
        yaw_rate=0.0,
        velocity=(0.0, 0.0),
        actuators={} if drive is None else drive.kind.actuator_values(0.0, 0.0),
        stopped=True,
    )
