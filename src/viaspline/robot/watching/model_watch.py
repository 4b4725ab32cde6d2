"""A robot's steps, watched: what its machine does beside what its model says."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.run import Event
from viaspline.robot.state import RobotState
from viaspline.robot.watching.measured_motion import (
    lagging,
    meant_speed,
    pose_jump,
    slipping,
    waits_for,
)
from viaspline.robot.watching.true_place import (
    TruePlace,
    is_held_at_turn,
    is_just_past_turn,
    is_there,
    true_place,
)
from viaspline.robot.watching.turned_first import turned_first
from viaspline.robot.watching.watch import Watch

LEAST_SPEED_MPS = 0.1
"""With which a distance is taken for a time where the robot is to be slower [m/s]."""


@dataclass(frozen=True)
class WatchedMotion:
    """What a step shows of a robot's motion.

    Attributes:
        watch: With that.
        schedule: With the time law of a robot without a drive, which waits if it is far behind.
        place: Where the robot is on its path, as measured.
        waited: For how long the time law waits in this step [s].
        was_set: Whether it was set where it is, and has not driven there.
        events: What is to be told.
    """

    watch: Watch
    schedule: Schedule
    place: TruePlace
    waited: float
    was_set: bool
    events: tuple[Event, ...]


def watched_motion(
    task: DriveTask,
    before: Watch,
    watch: Watch,
    progress: Progress,
    schedule: Schedule,
    measured: RobotState,
    time: float,
) -> WatchedMotion:
    """What a robot has done since its last step.

    Args:
        task: What is asked of the drive.
        before: The watch of the step before.
        watch: With what was handed in now.
        progress: As of the step before.
        schedule: What the robot means to do.
        measured: Where it is now.
        time: Now [s].
    """
    last = before.measured
    seconds = 0.0 if last is None else max(time - before.time, 0.0)
    watch, turns = turned_first(task, before, watch, schedule, measured, time)
    if turns > 0.0:
        schedule = replace(schedule, trajectory=schedule.trajectory.delayed(turns))
    should = float(schedule.trajectory.distance_at(time))
    was_at = should if last is None else before.place - schedule.driven
    jump, now = None, watch.measured
    is_new = last is not None and now is not None and (watch.at > before.at or time > before.time)
    if is_new and not is_there(schedule, measured, should):
        assert last is not None
        assert now is not None
        jump = pose_jump(task, before, last, now, max(watch.at - before.at, 0.0))
    around = 0.0 if jump is None else jump[0]
    place = true_place(task.mission.robot, schedule, measured, should, was_at, around)
    total = schedule.driven + place.distance
    if place == TruePlace(should, 0.0, 0.0):  # it does as it was told, however long ago that was
        meant = before.meant + max(total - before.place, 0.0)
        watch = replace(watch, meant=meant, place=total, off=0.0)
        return WatchedMotion(watch, schedule, place, turns, last is None, ())
    speed = meant_speed(task, before, time, seconds)
    meant = before.meant + speed * seconds
    watch = replace(watch, speed=speed, meant=meant, place=total, off=place.off)
    events: tuple[Event, ...] = ()
    if jump is not None:
        watch, events = replace(watch, trail=()), (_jumped(jump, measured, time),)
    if is_held_at_turn(schedule, place, should):
        watch = replace(watch, trail=())
    watch, slips = slipping(task, watch, measured.position)
    waited = turns
    may_wait = task.model is None and last is not None and schedule.giving_up is None
    if turns == 0.0 and may_wait and not is_just_past_turn(schedule, should):
        waited = waits_for(watch, schedule.driven + progress.distance, seconds)
        if waited > 0.0:
            schedule = replace(schedule, trajectory=schedule.trajectory.delayed(waited))
    was_set = last is None or jump is not None
    return WatchedMotion(watch, schedule, place, waited, was_set, (*events, *slips))


def told_of_lag(
    watch: Watch, progress: Progress, schedule: Schedule, motion: WatchedMotion
) -> tuple[Watch, tuple[Event, ...]]:
    """Whether a robot is farther behind its time law than was told.

    Args:
        watch: So far.
        progress: How far the robot has come.
        schedule: What it means to do.
        motion: Of this step.
    """
    should = float(schedule.trajectory.distance_at(watch.time))
    behind = max(should - motion.place.distance, -progress.along_track, 0.0)
    waited = motion.waited
    if progress.controller is not None:
        waited = progress.controller.late
    elif progress.along_track != 0.0:  # it got a new time law, from where it is
        waited -= progress.along_track / max(watch.speed, LEAST_SPEED_MPS)
    return lagging(watch, waited, schedule.place(motion.place.distance), behind)


def _jumped(jump: tuple[float, float], measured: RobotState, time: float) -> Event:
    far, turned = jump
    words = f"finds itself {far:.2f} m and {math.degrees(turned):.0f}° from where it has driven"
    data = {"jump_m": far, "turned_rad": turned}
    return Event("pose_jump", time, measured.position, words, data)
