"""A new trajectory for what lies ahead, as far as the robot has seen it, with the stops to come.

Tested through ``robot/test_navigator`` and ``robot/replanning/test_sight_limit``.
"""

from __future__ import annotations

import math
from dataclasses import replace

from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.machine.turns_on_spot import with_turns
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import SAME_PLACE_M, Progress
from viaspline.robot.navigation.schedule import Schedule, vias_after
from viaspline.robot.perception.belief import Belief
from viaspline.trajectory.limits import Station
from viaspline.trajectory.retime import braking, retime
from viaspline.trajectory.trajectory import Trajectory


def caught_up(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule, speed: float
) -> Schedule:
    """The schedule of a robot that is ahead or behind, from where it is; else as it was.

    Args:
        task: What is asked of the drive.
        progress: How far it has come, and how far that is from where it should be.
        knowledge: All that is known.
        schedule: What the robot means to do.
        speed: As measured [m/s].
    """
    if progress.along_track == 0.0:
        return schedule
    allowed = float(schedule.trajectory.speed_at(progress.distance))
    return rescheduled(task, progress, knowledge, schedule, min(speed, allowed))


def rescheduled(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule, speed: float
) -> Schedule:
    """The schedule with a trajectory that begins here and now, at this speed [m/s].

    It ends, at rest, where the robot is not certain to be free any more. Where the robot can't
    stop in time, because what was certain is not so now, it brakes as hard as it can.
    """
    path, turns, probed = schedule.path, schedule.turns, schedule.probed_until
    try:
        trajectory = trajectory_within_sight(
            task, progress, knowledge, schedule, speed, path=path, turns=turns, at_least=probed
        )
    except GeometryError:
        if knowledge.belief is None and schedule.held_at >= path.length:
            raise
        trajectory = braking_at_once(task, progress, schedule, speed)
    return replace(schedule, trajectory=trajectory)


def braking_at_once(
    task: DriveTask, progress: Progress, schedule: Schedule, speed: float
) -> Trajectory:
    """The trajectory of a robot that brakes as hard as it can, from here or where it may first.

    Args:
        task: What is asked of the drive.
        progress: Where the robot is on the path, and when.
        schedule: What it means to do up to now, and how long it is committed to that.
        speed: Of the robot where it begins to brake [m/s].
    """
    old, until = schedule.trajectory, schedule.committed_until
    if until <= progress.time:
        return braking(progress.distance, speed, task.limits.brake, progress.time)
    distance = max(float(old.state_at(until)[0]), progress.distance)
    return old.followed_by(braking(distance, speed, task.limits.brake, until), progress.time)


def rescheduled_by_sight(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule, speed: float
) -> Schedule:
    """The schedule after one more look of a lidar: how far it has seen, and when it is there."""
    assert knowledge.belief is not None
    required = task.requirements.required
    sighted = _sighted_until(knowledge.belief, progress.distance, schedule, schedule.path, required)
    seen = replace(schedule, sighted_until=sighted)
    return rescheduled(task, progress, knowledge, seen, speed)


def trajectory_within_sight(
    task: DriveTask,
    progress: Progress,
    knowledge: Knowledge,
    schedule: Schedule,
    speed: float,
    *,
    path: Path,
    turns: tuple[float, ...],
    shared: float = math.inf,
    at_least: float = 0.0,
) -> Trajectory:
    """The trajectory of a path, from here and now to where the robot is certain to be free.

    A stay that is under way goes on.

    Args:
        task: What is asked of the drive.
        progress: Where the robot is on the path, and when.
        knowledge: All that is known.
        schedule: What the robot means to do up to now.
        speed: Of the robot [m/s].
        path: What is driven.
        turns: Distances along it where the robot turns on the spot [m].
        shared: Up to this distance the path is the schedule's own [m].
        at_least: The trajectory goes up to this distance, however little was seen [m].

    Raises:
        GeometryError: When the robot is too fast to stop where it has to.
    """
    distance, time, accel = progress.distance, progress.time, None
    if time < schedule.committed_until:
        time = schedule.committed_until
        distance, speed, accel = (float(x) for x in schedule.trajectory.state_at(time))
    required = task.requirements.required
    certain = _certain_until(knowledge.belief, distance, schedule, path, required, shared)
    end = max(min(certain, schedule.held_at), at_least)
    stops = [Station(turn) for turn in turns if turn > distance + SAME_PLACE_M]
    stops += [
        Station(max(at, distance), via.dwell, via.name)
        for via, at in vias_after(path, progress.last_via)
        if via.dwell > 0.0
    ]
    if progress.dwell is not None:
        stops.append(Station(distance, max(progress.dwell.until - time, 0.0), progress.dwell.name))
        speed = 0.0
    if end < path.length:
        stops = [*(stop for stop in stops if stop.distance < end), Station(end)]
    if task.model is not None:
        stops = with_turns(path, task.model, stops, distance)
    trajectory = retime(
        path,
        task.limits,
        stops,
        zones=task.mission.world.speed_zones,
        start=min(distance, path.length),
        start_speed=speed,
        start_accel=float(schedule.trajectory.state_at(time)[2]) if accel is None else accel,
        start_time=time,
        replaces=schedule.trajectory,
    )
    trajectory = trajectory if end >= path.length else trajectory.until(end)
    if time == progress.time:
        return trajectory
    return schedule.trajectory.followed_by(trajectory, progress.time)


def _certain_until(
    belief: Belief | None,
    distance: float,
    schedule: Schedule,
    path: Path,
    required: float,
    shared: float,
) -> float:
    """How far along a path the robot can go for certain [m].

    Without a lidar it trusts what it knows, and that is to the end.
    """
    if belief is None:
        return path.length
    sighted = _sighted_until(belief, distance, schedule, path, required, shared)
    for start, end, floor in schedule.kept(distance, sighted, required):
        clear = belief.clear_until(path, start, end, floor)
        if clear < end:
            return clear
    return sighted


def _sighted_until(
    belief: Belief,
    distance: float,
    schedule: Schedule,
    path: Path,
    required: float,
    shared: float = math.inf,
) -> float:
    """How far along a path the robot has seen where its body will be [m]."""
    end = min(distance + belief.lookahead, path.length)
    floor = min(floor for _, _, floor in schedule.kept(distance, end, required))
    start = max(distance, min(schedule.sighted_until, shared))
    return belief.seen_until(path, start, end, floor)
