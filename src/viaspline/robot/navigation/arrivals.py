"""What happens along the path: via points that are passed, stays that end, the end of the drive."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.curve.path import PathVia
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.log import Log
from viaspline.robot.navigation.progress import SAME_PLACE_M, Dwell, Progress
from viaspline.robot.navigation.schedule import Schedule, vias_after
from viaspline.robot.run import Event, Visit


def note_arrivals(
    task: DriveTask, progress: Progress, schedule: Schedule, log: Log
) -> tuple[Progress, Log]:
    """Note every via point that was passed, every stay that is over, and the end of the drive."""
    if schedule.giving_up is not None and progress.dwell is not None:
        progress = replace(progress, dwell=None)  # it stands for good, not for a station
    progress, log = _end_dwell(progress, log)
    for via, distance in vias_after(schedule.path, progress.last_via):
        if progress.dwell is not None or progress.distance < distance - SAME_PLACE_M:
            break
        progress, log = _end_dwell(*_pass(via, distance, progress, schedule, log))
    return _end_drive(task, progress, schedule, log)


def _end_dwell(progress: Progress, log: Log) -> tuple[Progress, Log]:
    stay = progress.dwell
    if stay is None or progress.time < stay.until:
        return progress, log
    leaves = Event("dwell", stay.until, stay.at, f"the stay at '{stay.name}' is over")
    return replace(progress, dwell=None), log.with_events(leaves)


def _pass(
    via: PathVia, distance: float, progress: Progress, schedule: Schedule, log: Log
) -> tuple[Progress, Log]:
    """A via point at a distance along the path [m] has been passed."""
    assert via.index is not None
    path, trajectory = schedule.path, schedule.trajectory
    time = progress.time
    if trajectory.distances[0] <= distance:
        time = min(float(trajectory.time_at(distance)), time)
    on_curve = np.asarray(path.evaluate(via.u))
    miss = float(np.linalg.norm(on_curve - np.asarray(via.at))) + progress.cross_track
    log = log.with_visit(via.index, Visit(via.name, via.at, "served", time, miss))
    for index, why in _missed(progress.last_via, via.index, schedule):
        lost = f"gives up point {index} of the route again: {why}"
        log = log.with_skipped(index, why).with_events(Event("skipped", time, via.at, lost))
    progress = replace(progress, last_via=via.index)
    if via.dwell > 0.0:
        message = f"stops at '{via.name}' for {via.dwell:g} s"
        arrived = Event("arrived", time, via.at, message, {"dwell_s": via.dwell})
        stay = Dwell(via.name, via.at, time + via.dwell)
        return replace(progress, dwell=stay), log.with_events(arrived)
    if via.index > 0 and (schedule.is_round or vias_after(path, via.index)):
        log = log.with_events(Event("via", time, via.at, f"passes '{via.name}'"))
    return progress, log


def _missed(last: int, index: int, schedule: Schedule) -> tuple[tuple[int, str], ...]:
    return () if schedule.laps is None else schedule.laps.newly_missed(last, index)


def _end_drive(
    task: DriveTask, progress: Progress, schedule: Schedule, log: Log
) -> tuple[Progress, Log]:
    trajectory, reason = schedule.trajectory, schedule.giving_up
    end, time = float(trajectory.distances[-1]), trajectory.end_time
    over = progress.time >= time and progress.distance >= end - SAME_PLACE_M
    waits = reason is None and (schedule.is_round or end < schedule.path.length - SAME_PLACE_M)
    if progress.finished or progress.dwell is not None or waits or not over:
        return progress, log
    where = schedule.place(end)
    if reason is not None:
        event = Event("stopped", time, where, f"stands: {reason}")
    else:
        event = Event("reached", time, where, f"is at {_goal(task, schedule)}")
    return replace(progress, finished=True), log.with_events(event)


def _goal(task: DriveTask, schedule: Schedule) -> str:
    if task.mission.route.closed:
        return "its start again"
    return f"'{schedule.path.vias[-1].name}'" if schedule.path.vias else "its goal"
