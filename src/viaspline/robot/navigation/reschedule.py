"""A new trajectory for what lies ahead, as far as the robot has seen it, with the stops to come.

Tested through ``robot/test_navigator`` and ``robot/replanning/test_sight_limit``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.kernels.tracking.control_law import HEADING_DEADBAND_RAD
from viaspline.kernels.tracking.drive_motion import HEADING
from viaspline.machine.reference import heading_after
from viaspline.machine.turns_on_spot import (
    TURN,
    heading_onward,
    turns_where_it_stands,
    with_turns,
)
from viaspline.mission.spot_turning import SpotTurning
from viaspline.robot.navigation.certain_way import certain_until, sighted_until
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.facing import facing_at, turn_to
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.law_horizon import (
    LEAST_PART_M,
    dense_until,
    is_in_parts,
    reach_ahead,
    renewed_at,
)
from viaspline.robot.navigation.law_past import law_past, part_until, spans_until
from viaspline.robot.navigation.progress import SAME_PLACE_M, Progress
from viaspline.robot.navigation.schedule import Schedule, vias_after
from viaspline.robot.state import RobotState
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.part import retime_part
from viaspline.trajectory.retime import braking, retime
from viaspline.trajectory.trajectory import Trajectory

STANDING_MPS = 1e-3
"""A robot that is slower stands [m/s]."""

MAX_LEAVING_RAD, MAX_LEAVING_SHARE = 0.05, 0.4
"""A robot that stands leaves when it looks along its path so far [rad], and its body is off by no
more than this share of what is kept for the tracking error."""


def caught_up(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule,
    measured: RobotState,
) -> Schedule:  # fmt: skip
    """The schedule of a robot that is ahead or behind, from where it is; else as it was.

    Args:
        task: What is asked of the drive.
        progress: How far it has come, and how far that is from where it should be.
        knowledge: All that is known.
        schedule: What the robot means to do.
        measured: Its speed; that is below 0 where it gets back to a place on which it turns.
    """
    if progress.along_track == 0.0 and progress.time < renewed_at(task, knowledge, schedule):
        return schedule
    if progress.along_track == 0.0:
        speed = float(schedule.trajectory.state_at(progress.time)[1])
        return rescheduled(task, progress, knowledge, schedule, speed)
    speed, path = measured.speed, schedule.path
    if task.mission.robot.held_heading is not None:  # it goes any way, whichever way it looks
        way = float(path.heading(path.parameter(progress.distance)))
        speed = measured.speed_towards(way)
    allowed = float(schedule.trajectory.speed_at(progress.distance))
    return rescheduled(task, progress, knowledge, schedule, min(max(speed, 0.0), allowed))


def rescheduled(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule, speed: float
) -> Schedule:
    """The schedule with a trajectory that begins here and now, at this speed [m/s].

    It ends, at rest, where the robot is not certain to be free any more. Where the robot can't
    stop in time, because what was certain is not so now, or because a drive is faster than its
    law, it brakes as hard as it can.
    """
    path, turns, probed = schedule.path, schedule.turns, schedule.probed_until
    try:
        trajectory = trajectory_within_sight(
            task, progress, knowledge, schedule, speed, path=path, turns=turns, at_least=probed
        )
    except GeometryError:
        certain = knowledge.belief is None and schedule.held_at >= path.length
        if certain and not len(knowledge.moving) and task.model is None:
            raise
        trajectory = braking_at_once(task, progress, schedule, speed)
    return replace(schedule, trajectory=trajectory, timed_at=progress.time)


def braking_at_once(
    task: DriveTask, progress: Progress, schedule: Schedule, speed: float
) -> Trajectory:
    """The trajectory of a robot that brakes as hard as it can, from here or where it may first.

    Args:
        task: What is asked of the drive.
        progress: Where the robot is on the path, and when.
        schedule: What it means to do up to now, and how long it is committed to that.
        speed: Of the robot now [m/s]; where it is committed to its old trajectory, that says it.
    """
    old, until = schedule.trajectory, schedule.committed_until
    if until <= progress.time:
        return _harsh_stop(task, schedule.path, progress.distance, speed, progress.time)
    distance, speed, _ = (float(x) for x in old.state_at(until))
    distance = max(distance, progress.distance)
    stop = _harsh_stop(task, schedule.path, distance, speed, until)
    return old.followed_by(stop, progress.time)


def _harsh_stop(
    task: DriveTask, path: Path, distance: float, speed: float, time: float
) -> Trajectory:
    """Braking as hard as it goes, which says so where the jerk has a limit.

    Where it just does for the end of the path, that is where it ends, whatever the rounding says.
    """
    law = braking(distance, speed, task.limits.brake, time)
    law = replace(law, distances=np.minimum(law.distances, path.length))
    if task.limits.max_jerk is None:
        return law
    return replace(law, over_jerk_until=float(law.distances[-1]))


def rescheduled_by_sight(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule, speed: float
) -> Schedule:
    """The schedule after one more look of a lidar: how far it has seen, and when it is there."""
    assert knowledge.belief is not None
    required = task.requirements.required
    sighted = sighted_until(knowledge.belief, progress.distance, schedule, schedule.path, required)
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
    reach: float | None = None,
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
        reach: And no farther ahead than this [m]; by default as far as it pays.

    Raises:
        GeometryError: When the robot is too fast to stop where it has to.
    """
    distance, time = progress.distance, progress.time
    accel = float(schedule.trajectory.state_at(time)[2])
    if time < schedule.committed_until:
        time = schedule.committed_until
        distance, speed, accel = (float(x) for x in schedule.trajectory.state_at(time))
    required = task.requirements.required
    certain = certain_until(knowledge.belief, distance, schedule, path, required, shared)
    ahead = reach_ahead(task, schedule) if reach is None else reach
    end = min(certain, schedule.held_at, distance + ahead)
    if is_in_parts(task.limits, path) and not len(knowledge.moving):
        end = dense_until(task, path, distance, end, (speed, accel))
    end = max(end, at_least, distance)  # a stop that lies behind would be none
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
    stops = with_turns(path, task.spot_turning, stops, distance)
    turn = _turn_before_leaving(task, progress, schedule, path, distance, time)
    if turn is not None and speed < STANDING_MPS and distance < end:
        stops, speed = [*_turning(turn, stops), *stops], 0.0
    part, motion = (distance, end), (speed, accel)
    if len(knowledge.moving):
        trajectory = law_past(task, knowledge.moving, schedule, path, stops, part, motion, time)
    else:
        trajectory = _timed(task, schedule, path, stops, part, motion, time)
    if time == progress.time:
        return trajectory
    return schedule.trajectory.followed_by(trajectory, progress.time)


def _turn_before_leaving(
    task: DriveTask,
    progress: Progress,
    schedule: Schedule,
    path: Path,
    distance: float,
    time: float,
) -> Station | None:
    """The stay of a robot that stands, if it looks another way than its path leads on."""
    model, controller = task.model, progress.controller
    if model is None:
        turning = task.spot_turning
        facing = facing_at(progress, schedule.path, schedule.trajectory, turning, time)
        if facing is None:
            return None
        return turn_to(facing, path, distance, turning, is_new=path is not schedule.path)
    if controller is None or controller.believed is None or not turns_where_it_stands(model):
        return None
    # by its own points, on which it turns: within a cusp that is nearly one the path's are others
    on_it = path is controller.path
    way = heading_after(controller.reference, distance) if on_it else heading_onward(path, distance)
    angle = math.remainder(way - float(controller.believed[HEADING]), math.tau)
    if abs(angle) <= _leaving_angle(task):
        return None
    return Station(distance, SpotTurning.of_model(model).time(angle), TURN)


def _turning(turn: Station, stops: Sequence[Station]) -> tuple[Station, ...]:
    """What a turn takes longer than the stays at its place, in which the robot turns as well."""
    stays = sum(stop.dwell for stop in stops if abs(stop.distance - turn.distance) <= SAME_PLACE_M)
    return (replace(turn, dwell=turn.dwell - stays),) if turn.dwell > stays else ()


def _leaving_angle(task: DriveTask) -> float:
    """How far beside its path's heading a robot may look when it sets off [rad]."""
    robot, kept = task.mission.robot, task.requirements.tracking_error
    if robot.footprint is None or kept == 0.0:
        return MAX_LEAVING_RAD
    angle = max(MAX_LEAVING_SHARE * kept / robot.outer_radius, 2.0 * HEADING_DEADBAND_RAD)
    return min(angle, MAX_LEAVING_RAD)


def _timed(
    task: DriveTask,
    schedule: Schedule,
    path: Path,
    stops: Sequence[Station],
    part: tuple[float, float],
    motion: tuple[float, float],
    time: float,
) -> Trajectory:
    """The trajectory of a part of a path, to rest at its end.

    It costs no more than the part, and where laws are cheap than the spans before it.

    Args:
        task: What is asked of the drive.
        schedule: What the robot means to do up to now.
        path: What is driven.
        stops: On the part.
        part: From where to where [m].
        motion: Speed and acceleration at its start [m/s], [m/s²].
        time: There [s].
    """
    (distance, end), (speed, accel) = part, motion
    zones = task.mission.world.speed_zones
    if is_in_parts(task.limits, path):
        if end - distance < (LEAST_PART_M if end < path.length else SAME_PLACE_M):
            if speed > 0.0:
                raise GeometryError(f"the robot can't stop within {end - distance:g} m")
            return _standing(distance, stops, task.limits, time)
        return retime_part(
            path, distance, end, task.limits, stops, zones=zones, slow=schedule.slow,
            start_speed=speed, start_accel=accel, start_time=time, replaces=schedule.trajectory,
        )  # fmt: skip
    timed, ends_here = path, end >= path.length
    if not ends_here:
        cut = part_until if schedule.is_round else spans_until
        timed, stops = cut(path, stops, end)
        ends_here = schedule.is_round
    trajectory = retime(
        timed, task.limits, stops, zones=zones, slow=schedule.slow,
        start=min(distance, timed.length), start_speed=speed, start_accel=accel, start_time=time,
        replaces=schedule.trajectory,
    )  # fmt: skip
    return trajectory if ends_here else trajectory.until(end)


def _standing(distance: float, stops: Sequence[Station], limits: Limits, time: float) -> Trajectory:
    """The trajectory of a robot that stays where it is, at least as long as its stops there."""
    return Trajectory.through(
        np.full(2, distance), np.zeros(2), max_accel=limits.brake, start_time=time,
        stations=[stop for stop in stops if stop.distance <= distance],
    )  # fmt: skip
