"""Passive safety under way: the robot stands before anything can touch it.

Tested through ``robot/yielding/test_stoppable``.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viaspline.machine.settling import settled_after_law
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.pending_search import FIRST_STAGE, PendingSearch, SearchSoFar
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.reschedule import rescheduled
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.perception.perceive import Sighting
from viaspline.robot.replanning.deadline import STANDING_WORK_S
from viaspline.robot.run import Event
from viaspline.robot.yielding.certified_stop import (
    STAY_S,
    StopAsked,
    certified_stop,
    kept_or_stopped,
    stay_meant,
)
from viaspline.robot.yielding.held_up import rests
from viaspline.robot.yielding.may_come import WhatMayCome, kept_to_what_comes
from viaspline.tracks.patience import FROZEN, MAX_FROZEN_S, UNSEEING
from viaspline.trajectory.passive_premises import SAME_PLACE_M
from viaspline.trajectory.passive_safety import FIRST_STEPS_M, stop_of
from viaspline.trajectory.retime import braking
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World

LEAST_STEP_M = FIRST_STEPS_M[0]
"""One that stands doesn't set off for less: by steps of a hair it would neither come on nor have
stood for long [m]."""

FREED_M, FREED_SHARE = 0.01, 2e-3
"""Who has come so much farther has got free [m], and that share of what full speed takes it in the
time for which it may stand: one that creeps on by a few centimetres a minute hasn't."""

PIECE_S = 0.02
"""A law with a limit of the jerk is taken in pieces of even acceleration, so long [s]."""


def stoppable(
    task: DriveTask,
    progress: Progress,
    knowledge: Knowledge,
    before: Schedule,
    after: Schedule,
    coming: WhatMayCome,
) -> Schedule:
    """A schedule by which the robot is at rest before anything that it may meet touches it.

    It goes on by what it means to do as far as that is proven: nothing is faster than the mission
    says, nothing appears inside of what its sensor sees, and what is on the map moves as that says.
    It stops where none of that comes, if it can: see ``certified_stop``. Where not even braking at
    once is proven, it stops as an earlier look has proven, on the path on which that was, or keeps
    to all that it has proven. One that follows exactly and stands until what crosses is gone sets
    off no sooner. With a limit of the jerk it may brake more suddenly than that, and the law says
    so.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: All that is known, with what was just seen.
        before: What it meant to do before this look, along distances as they count now.
        after: What it would do if nothing could come.
        coming: What may come by this look.
    """
    robot = task.mission.robot
    things = robot.moving
    has_law = after.giving_up is None and not progress.finished
    if things is None or things.safety == "none" or not has_law:
        return after
    if progress.dwell is not None:
        return _staying(task, progress, _freed(after))
    if rests(knowledge, after, progress.time) and after.path is before.path:
        return after
    now, brake = progress.time, task.limits.brake
    after = replace(after, waits_for_gap=False)
    speed = float(before.trajectory.state_at(now)[1])
    meant = after
    if after.trajectory is before.trajectory:
        meant = rescheduled(task, progress, knowledge, after, speed)
        meant = replace(meant, timed_at=after.timed_at)  # it is asked all the same for other ways
    leaves = now if progress.controller else _stands_until(meant.trajectory, now)
    if leaves > now + task.reaction:
        stop = braking(progress.distance, 0.0, brake, now)
        return replace(_waiting(meant, now), trajectory=stop, gives_way=True, waits_for_gap=True)
    keep = kept_to_what_comes(task)
    upper = _in_even_pieces(meant.trajectory, leaves, brake)
    hold = STAY_S if meant.is_round else task.mission.route.hold_s
    stay = stay_meant(meant.trajectory, meant.path, progress.distance, hold)
    proven = before.trajectory if before.is_proven and meant.path is before.path else None
    limits = (task.limits.max_accel, brake)
    settle = 0.0
    if task.model is not None and progress.controller is not None:
        settle = settled_after_law(task.model, brake, progress.controller.period)
    asked = StopAsked(
        meant.path, upper, coming.premises, keep, limits, leaves, stay, proven, settle
    )
    law = certified_stop(asked)
    if law is None:
        law = stop_of(before.trajectory, now, brake)
        law = kept_or_stopped(asked, law) if meant.path is before.path else law
        meant = meant if meant.path is before.path else before
    if task.limits.max_jerk is not None and law is not proven:
        law = replace(law, over_jerk_until=float(law.distances[-1]))
    here = progress.distance
    # corners may be nearer to each other than a step
    step = min(here + LEAST_STEP_M, upper.next_rest(here + SAME_PLACE_M) - SAME_PLACE_M)
    is_frozen = speed == 0.0 and law.distances[-1] < step
    if is_frozen and law.distances[-1] > here:
        law = braking(here, 0.0, brake, now)
    return _patient(robot, replace(meant, trajectory=law, proven=law), here, now, is_frozen)


def _staying(task: DriveTask, progress: Progress, schedule: Schedule) -> Schedule:
    """The schedule of a robot at a station, which doesn't leave before it has looked again."""
    law, now = schedule.trajectory, progress.time
    there = float(law.state_at(now + task.reaction)[0])
    if there <= float(law.state_at(now)[0]) + SAME_PLACE_M:
        return schedule
    return replace(schedule, trajectory=braking(progress.distance, 0.0, task.limits.brake, now))


def _freed(schedule: Schedule) -> Schedule:
    """The schedule of a robot that stands because it means to."""
    return replace(schedule, frozen_since=math.inf, frozen_at=math.inf, frozen_before=0.0)


def _waiting(schedule: Schedule, now: float) -> Schedule:
    """The schedule of a robot that waits for a gap: it isn't frozen then, but comes no farther."""
    if schedule.frozen_since == math.inf:
        return schedule
    before = schedule.frozen_before + now - schedule.frozen_since
    return replace(schedule, frozen_since=math.inf, frozen_before=before)


def _patient(
    robot: RobotSpec, schedule: Schedule, here: float, now: float, is_frozen: bool
) -> Schedule:
    """The schedule of a robot that doesn't stand for ever where nothing is proven to be safe.

    It has stood since it was last on its way: not only while it would go if nothing could come.
    What it waits for a gap in between doesn't count, nor does it begin anew then.

    Args:
        robot: The robot.
        schedule: What it means to do now.
        here: Where it is along its path [m].
        now: [s].
        is_frozen: Whether no step of it is proven now.
    """
    driven = schedule.driven + here
    if driven > schedule.frozen_at + max(FREED_M, FREED_SHARE * robot.max_speed_mps * MAX_FROZEN_S):
        schedule = _freed(schedule)
    if is_frozen and schedule.frozen_since == math.inf:
        at = min(schedule.frozen_at, driven)
        schedule = replace(schedule, frozen_since=now, frozen_at=at)
    if not is_frozen or schedule.frozen_before + now - schedule.frozen_since < MAX_FROZEN_S:
        return schedule
    reason = FROZEN if robot.sensor is not None else FROZEN + UNSEEING
    return replace(schedule, giving_up=reason, pending=None)


def kept_to_path(
    progress: Progress, knowledge: Knowledge, schedule: Schedule, sighting: Sighting | None
) -> tuple[Schedule, Event]:
    """The schedule of a robot that stops on its path though a new one was found, and the event.

    What was just seen is told of once: it is looked for a way round it again in the next step.

    Args:
        progress: How far it has come.
        knowledge: All that is known, with what was just seen.
        schedule: Which keeps to the path that there was.
        sighting: What was just seen, or looked at, if it was anything new.
    """
    words = "brakes: on the new path it might be touched, on the old one its stop is proven"
    event = Event("braked", progress.time, schedule.place(progress.distance), words)
    if not isinstance(sighting, World) or not len(sighting):
        return schedule, event
    so_far = SearchSoFar(STANDING_WORK_S, 0.0, knowledge.world, {})
    pending = PendingSearch(progress.time, sighting, sighting.names, FIRST_STAGE, so_far)
    if schedule.pending is not None:
        pending = replace(schedule.pending.with_new(sighting), so_far=so_far)
    return replace(schedule, pending=pending), event


def _stands_until(law: Trajectory, now: float) -> float:
    """Up to when a robot is to stand that goes on then [s]; now if it moves, or is to stay."""
    here, speed, _ = (float(value) for value in law.state_at(now))
    if speed > 0.0 or here >= law.distances[-1]:
        return now
    last = int(np.searchsorted(law.distances, here, side="right")) - 1
    return max(float(law.times[last]), now)


def _in_even_pieces(law: Trajectory, now: float, brake: float) -> Trajectory:
    """A law with a limit of the jerk, up to its next rest, in short pieces of even acceleration."""
    if law.changes is None:
        return law
    times = np.linspace(now, law.end_time, 2 + math.ceil((law.end_time - now) / PIECE_S))
    distances, speeds, _ = law.state_at(times)
    rests = np.flatnonzero((speeds == 0.0) & (distances > distances[0] + SAME_PLACE_M))
    last = int(rests[0]) + 1 if rests.size else len(times)
    kept = np.append(np.diff(distances[:last]) > SAME_PLACE_M, True)
    places, squares = distances[:last][kept], speeds[:last][kept] ** 2
    if len(places) < 2:
        return braking(float(distances[0]), 0.0, brake, now)
    squares[-1] = 0.0
    return Trajectory.through(places, squares, max_accel=brake, start_time=now)
