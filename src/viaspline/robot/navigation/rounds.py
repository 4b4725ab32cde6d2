"""The laps to come of a closed route: one round ahead of the robot, that grows as it is driven.

A robot that goes round many times has a path of one round, which ends where it begins. What lies
behind it is taken off the beginning and put to the end, span by span as it was driven: the next lap
is the last one, with all its detours. So what a re-plan costs doesn't depend on the laps to come,
nor on those that were driven. The last part of the round isn't looked at before the robot has come
nearer: what is in its way there is gone round then, once.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viaspline.curve.path import SEAM, Path, PathVia
from viaspline.kernels.arrays import Floats
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.laps_ahead import LapsAhead
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.trajectory.slow_zones import Slow, slow_between

UNSEEN_RATIO = 3.0 / 8.0
"""Part of a round at its end that isn't looked at yet."""

GROWS_RATIOS = 2.0, 1.5
"""The round grows when so many times that is left of it, the second if no whole span lies behind
sooner. So there is half as much ahead at least that the robot has looked at."""

FEW_ROUNDS = 3
"""A drive of no more rounds is one path from its start to its end."""

SAME_U = 1e-9
"""A parameter nearer than this to a joint of two spans is that joint."""

MIN_STOPS, MIN_REACHES, MIN_LIDAR_REACHES = 8.0, 4.0, 8.0
"""A round is no shorter than so many braking distances and so many ranges of the sensor, more of a
lidar's; shorter laps make up one together."""

KEPT_RATIO = 1.0 / 8.0
"""So much of a round stays behind a robot with a lidar: it may have to go back as it came, and its
controller looks for it on what lies behind, too."""


def first_round(task: DriveTask, path: Path) -> tuple[Path, LapsAhead | None]:
    """The path with which a drive begins, and the laps after it; None if that is all of it.

    Without a lidar a controller follows the trajectory of its plan, for which slower stretches were
    tried out all along the way: with that alone a drive is one path.

    Args:
        task: What is asked of the drive.
        path: All laps, one after the other.
    """
    laps = task.mission.route.laps
    count = math.ceil(_least_round(task) * laps / path.length)
    follows_plan = task.model is not None and not _has_lidar(task)
    if FEW_ROUNDS * count >= laps or follows_plan:
        return path, None
    end = count * (len(path.spans) // laps)
    goal = max(via.index for via in path.vias if via.index is not None)
    vias = [via for via in path.vias if via.u < end]
    first = Path(path.spans[:end], [*vias, _seam(path.spans[:end])])
    points = goal // laps
    unseen, timed = UNSEEN_RATIO * first.length, _least_round(task)
    kept = KEPT_RATIO * first.length if _has_lidar(task) else 0.0
    return first, LapsAhead(points, count * points, goal, unseen, timed, kept=kept)


def grows_after(schedule: Schedule) -> float:
    """When the path grows if nothing new is seen [s]; inf: never."""
    grows_at = _grows_at(schedule)
    return math.inf if grows_at is None else float(schedule.trajectory.time_at(grows_at))


def is_due(progress: Progress, schedule: Schedule) -> bool:
    """Whether it is time for the path to grow by what was driven of it.

    That waits for a search to be over: until then the robot stays where it has looked.
    """
    grows_at = _grows_at(schedule)
    return grows_at is not None and progress.distance >= grows_at and schedule.pending is None


def _grows_at(schedule: Schedule) -> float | None:
    """Where the robot is when the path grows [m]: if there is time, it has driven a whole span."""
    path, laps = schedule.path, schedule.laps
    if laps is None or not schedule.is_round or schedule.giving_up is not None:
        return None
    soonest, latest = (path.length - ratio * laps.unseen for ratio in GROWS_RATIOS)
    return max(soonest, min(float(path.distance(1.0)) + laps.kept, latest))


def next_part(progress: Progress, schedule: Schedule) -> tuple[Progress, Schedule, Path]:
    """The path with what was driven of it at its end, and not at its beginning any more.

    Returns:
        (progress along that path, the schedule with it, what is behind); the trajectory is the one
        that there was, and ends where the path ended before.
    """
    path, laps = schedule.path, schedule.laps
    assert laps is not None
    u = float(path.parameter(progress.distance - laps.kept))
    u = math.floor(u + SAME_U) if u >= 1.0 - SAME_U else u
    driven = float(path.distance(u))
    behind = Path(path.section(0.0, u).spans, [via for via in path.vias if via.u < u])
    rest = path.section(u, path.domain[1]).spans
    vias = [
        replace(via, u=via.u - math.floor(u)) for via in path.vias if u <= via.u < len(path.spans)
    ]
    again = [_lap_later(via, len(rest), laps.round) for via in behind.vias]
    ends = next((via for via in again if via.index == laps.goal), None)
    if ends is None:
        spans = np.concatenate((rest, behind.spans))
        ahead = Path(spans, [*vias, *again, _seam(spans)])
        turns = [turn + path.length - driven for turn in schedule.turns if turn < driven]
        slow = _moved(slow_between(schedule.slow, 0.0, driven), path.length - driven)
        to_come = replace(laps, unseen=UNSEEN_RATIO * ahead.length)
    else:
        spans = np.concatenate((rest, behind.spans))[: round(ends.u)]
        ahead = Path(spans, [*vias, *(via for via in again if via.u <= ends.u)])
        turns, slow, to_come = [], (), replace(laps, unseen=0.0)
    trajectory = schedule.trajectory.moved(-driven)
    moved = replace(
        schedule,
        path=ahead,
        trajectory=trajectory,
        proven=trajectory if schedule.is_proven else None,
        turns=(*(turn - driven for turn in schedule.turns if turn >= driven), *turns),
        slow=(*_moved(slow_between(schedule.slow, driven, path.length), -driven), *slow),
        sighted_until=max(schedule.sighted_until - driven, 0.0),
        probed_until=max(schedule.probed_until - driven, 0.0),
        reduced=None if schedule.reduced is None else schedule.reduced.moved(-driven),
        driven=schedule.driven + driven,
        laps=to_come,
    )
    controller = progress.controller
    progress = replace(
        progress,
        distance=max(progress.distance - driven, 0.0),
        controller=None if controller is None else controller.moved(-driven),
    )
    return progress, moved, behind


def _moved(parts: tuple[Slow, ...], by: float) -> tuple[Slow, ...]:
    return tuple(Slow(part.start + by, part.end + by, part.speed) for part in parts)


def _lap_later(via: PathVia, first: int, points: int) -> PathVia:
    index = None if via.index is None else via.index + points
    return replace(via, u=via.u + first, index=index)


def _seam(spans: Floats) -> PathVia:
    return PathVia(SEAM, tuple(spans[-1, 3].tolist()), "detour", float(len(spans)))


def _least_round(task: DriveTask) -> float:
    """How long a round has to be [m]."""
    limits, sensor = task.limits, task.mission.robot.sensor
    speed, brake = limits.max_speed, limits.brake
    onset = 0.0 if limits.max_jerk is None else brake / limits.max_jerk
    stop = speed * (speed / (2.0 * brake) + task.reaction + onset)
    reaches = MIN_LIDAR_REACHES if _has_lidar(task) else MIN_REACHES
    return max(MIN_STOPS * stop, 0.0 if sensor is None else reaches * sensor.reach)


def _has_lidar(task: DriveTask) -> bool:
    sensor = task.mission.robot.sensor
    return sensor is not None and sensor.lidar is not None
