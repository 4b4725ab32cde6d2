"""What a robot does about what its motion shows: it tells, keeps more from then on, or stops.

Tested through ``robot/watching/test_renewed_allowance``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from viaspline.robot.navigation.decision import Decision
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.reschedule import rescheduled
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.state import RobotState
from viaspline.robot.watching.gentler_drive import gentler_drive
from viaspline.robot.watching.model_watch import WatchedMotion, told_of_lag
from viaspline.robot.watching.path_deviation import path_deviation
from viaspline.robot.watching.renewed_allowance import renewed_allowance
from viaspline.robot.watching.watch import Watch

GENTLE_FROM = 2
"""From the so manieth time on that it was farther beside its path than was kept, a robot that has
no model goes on more gently; one that has, from the first: its model is wrong."""


@dataclass(frozen=True)
class JudgedMotion:
    """A drive that goes on after its motion was looked at.

    Attributes:
        task: What is asked of it from now on.
        progress: With what its controller is from now on.
        watch: With what was told.
        schedule: What the robot means to do.
        decisions: What there is to note, in order.
        work: What a new path has cost [s of the reference machine].
        moved_by: So much farther along its path it is, which leads to where it was set [m].
    """

    task: DriveTask
    progress: Progress
    watch: Watch
    schedule: Schedule
    decisions: tuple[Decision, ...]
    work: float = 0.0
    moved_by: float = 0.0


def judged_motion(
    task: DriveTask,
    progress: Progress,
    knowledge: Knowledge,
    schedule: Schedule,
    watch: Watch,
    motion: WatchedMotion,
    measured: RobotState,
) -> JudgedMotion:
    """What is to be told of a step's motion, and what a robot does about it.

    Args:
        task: What is asked of the drive.
        progress: How far the robot has come.
        knowledge: All that is known.
        schedule: What it means to do.
        watch: So far.
        motion: Of this step.
        measured: Where it is.
    """
    watch, lags = told_of_lag(watch, progress, schedule, motion)
    told = Decision(schedule, lags)
    if progress.finished or schedule.giving_up is not None:
        return JudgedMotion(task, progress, watch, schedule, (told,))
    watch, deviation = path_deviation(
        task, watch, knowledge, schedule, measured, motion.place, was_set=motion.was_set
    )
    if deviation is None:
        return JudgedMotion(task, progress, watch, schedule, (told,))
    renewed = renewed_allowance(task, progress, knowledge, schedule, deviation)
    task, decision = renewed.task, renewed.decision
    schedule = decision.schedule
    if renewed.progress is not None:
        by = renewed.progress.distance - progress.distance
        watch = replace(
            watch, place=watch.place + by, meant=watch.meant + by, off=0.0, excuse=None, trail=()
        )
        decisions = (told, decision)
        return JudgedMotion(
            task, renewed.progress, watch, schedule, decisions, decision.work, moved_by=by
        )
    if deviation.returns is None and schedule.giving_up is None:
        watch = replace(watch, renewals=watch.renewals + 1)
        if task.model is not None or watch.renewals >= GENTLE_FROM:
            # what it reacts to too late grows with its speed
            task, progress = gentler_drive(task, progress)
            speed = float(schedule.trajectory.state_at(progress.time)[1])
            schedule = rescheduled(task, progress, knowledge, schedule, speed)
    return JudgedMotion(task, progress, watch, schedule, (told, decision), decision.work)
