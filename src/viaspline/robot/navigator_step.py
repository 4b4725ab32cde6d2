"""One step of a navigator: what it is told, followed, perceived, decided, kept safe, commanded.

Each stage takes the step as far as it has come and gives it a stage farther.

Tested through ``robot/test_navigator``.
"""

from __future__ import annotations

import time as clock
from collections.abc import Sequence
from dataclasses import dataclass, replace

from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.planner import Plan
from viaspline.robot.navigation.arrivals import note_arrivals
from viaspline.robot.navigation.at_start import set_off
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.facing import facing_at
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.log import Log
from viaspline.robot.navigation.navigation_state import NavigationState
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.reschedule import caught_up, rescheduled
from viaspline.robot.navigation.rounds import is_due, next_part
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.navigation.track_path import track, with_command
from viaspline.robot.path_following import command_for
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.perceive import Sighting, perceive, told_apart
from viaspline.robot.replanning.decide import decide, look_again
from viaspline.robot.state import Command, RobotState
from viaspline.robot.watching.clock import runs_backwards, told_of_clock
from viaspline.robot.watching.fresh_inputs import FreshInputs, Sensed, fresh_inputs
from viaspline.robot.watching.held_still import held_still, let_on, stop_command
from viaspline.robot.watching.judged_motion import JudgedMotion, judged_motion
from viaspline.robot.watching.measured_motion import remembered_for
from viaspline.robot.watching.model_watch import WatchedMotion, watched_motion
from viaspline.robot.watching.watch import Watch
from viaspline.robot.yielding.broken_premises import broken_premises
from viaspline.robot.yielding.foreseen import foreseen
from viaspline.robot.yielding.give_way import give_way
from viaspline.robot.yielding.held_up import held_up, rests
from viaspline.robot.yielding.may_come import WhatMayCome, sight_of
from viaspline.robot.yielding.stays_put import stays_put
from viaspline.robot.yielding.stoppable import kept_to_path, stoppable


@dataclass(frozen=True, eq=False)
class StepTaken:
    """What comes of a step.

    Attributes:
        command: What the robot is to do until the next one.
        task: What is asked of the drive, with what is kept now.
        state: What is handed on to the next step.
    """

    command: Command
    task: DriveTask
    state: NavigationState


@dataclass(frozen=True, eq=False)
class _StepSoFar:
    """A step as far as it has come.

    Attributes:
        task: What is asked of the drive.
        before: What the step before handed on.
        inputs: What the robot goes by.
        time: Now [s].
        progress: How far the robot has come.
        knowledge: What it knows.
        schedule: What it means to do.
        proven: The last schedule that was kept safe from what may come.
        log: What has happened.
        watch: What tells whether the model fits the machine.
        work: What was spent on looking for a path [s of the reference machine].
        sighting: What was just seen and not known.
        is_part_new: Whether a part of the path has just come nearer.
    """

    task: DriveTask
    before: NavigationState
    inputs: FreshInputs
    time: float
    progress: Progress
    knowledge: Knowledge
    schedule: Schedule
    proven: Schedule
    log: Log
    watch: Watch
    work: float = 0.0
    sighting: Sighting | None = None
    is_part_new: bool = False


def step_taken(
    task: DriveTask, plan: Plan, state: NavigationState, measured: RobotState, sensed: Sensed,
    time: float,
) -> StepTaken:  # fmt: skip
    """What a robot does, and what it hands on to the next step.

    Args:
        task: What is asked of the drive.
        plan: As it was before the robot set off.
        state: What the step before handed on.
        measured: Where the robot is, as it was handed in.
        sensed: What is seen now, as it was handed in.
        time: Now [s].
    """
    before = replace(state, log=Log())
    if not before.progress.set_off:
        before = set_off(task, before, measured, time, plan)
    if runs_backwards(before.watch, time):
        return _stood(task, state, measured, time)
    inputs = fresh_inputs(
        task, before.watch, before.progress, before.schedule, measured, sensed, time
    )
    told = _StepSoFar(
        task, before, inputs, time, before.progress, before.knowledge, before.schedule,
        before.schedule, before.log.with_events(*inputs.events), inputs.watch,
    )  # fmt: skip
    perceived = _perceived(_followed(told))
    decided = _given_way(_decided(perceived))
    return _commanded(_not_held_up(_kept_stoppable(decided, perceived)))


def _stood(
    task: DriveTask, before: NavigationState, measured: RobotState, time: float
) -> StepTaken:
    """A step before the last one: the robot stands."""
    progress, schedule = before.progress, before.schedule
    if before.watch.held is None and not progress.finished and schedule.giving_up is None:
        schedule = held_still(task, progress, schedule)
    watch, events = told_of_clock(before.watch, schedule.place(progress.distance), time)
    log = Log().with_events(*events)
    command = stop_command(task, command_for(task, progress, schedule, measured))
    return StepTaken(
        command, task, replace(before, schedule=schedule, log=log, work=0.0, watch=watch)
    )


def _followed(now: _StepSoFar) -> _StepSoFar:
    """How far has the robot come, and does the model fit what it did?"""
    task, inputs, before = now.task, now.inputs, now.before
    progress, knowledge, schedule = now.progress, now.knowledge, now.schedule
    if progress.finished and progress.controller is None:
        return now
    motion, watch, log = None, now.watch, now.log
    if not progress.finished and inputs.stale != "pose":
        motion = watched_motion(
            task, before.watch, watch, progress, schedule, inputs.measured, now.time
        )
        watch, schedule = motion.watch, motion.schedule
        log = log.with_events(*motion.events)
    facing = facing_at(progress, schedule.path, schedule.trajectory, task.spot_turning, now.time)
    progress, waiting = track(progress, schedule, inputs.measured, now.time)
    progress = replace(progress, facing=facing)
    # who is held still isn't waited for: it stands when it has had the time for that
    schedule = waiting if inputs.stale is None else schedule
    progress, log = note_arrivals(task, progress, schedule, log)
    now = replace(now, progress=progress, log=log, watch=watch)
    if is_due(progress, schedule):
        now, motion = _on_next_part(now, schedule), None
        progress, schedule = now.progress, now.schedule
    schedule = caught_up(task, progress, knowledge, schedule, inputs.measured)
    if _may_go_on(before.watch, inputs, progress, schedule):
        schedule = let_on(task, progress, knowledge, schedule)
    now = replace(now, schedule=schedule)
    return now if motion is None else _judged(now, motion)


def _may_go_on(watch: Watch, inputs: FreshInputs, progress: Progress, schedule: Schedule) -> bool:
    """Whether a robot that was held still goes on; one that stands for good doesn't."""
    was_held = watch.held is not None and inputs.stale is None
    return was_held and schedule.giving_up is None and not progress.finished


def _on_next_part(now: _StepSoFar, schedule: Schedule) -> _StepSoFar:
    """The robot with what it has driven at its path's end."""
    progress, proven, behind = next_part(now.progress, schedule)
    speed = float(proven.trajectory.state_at(progress.time)[1])
    schedule = rescheduled(now.task, progress, now.knowledge, proven, speed)
    return replace(
        now, progress=progress, schedule=schedule, proven=proven, log=now.log.with_driven(behind),
        is_part_new=True,
    )  # fmt: skip


def _judged(now: _StepSoFar, motion: WatchedMotion) -> _StepSoFar:
    """The step with what the robot does about a model that doesn't fit."""
    # where one was set it may see for the first time what is in its way
    knowledge = _as_seen(now) if motion.was_set else now.knowledge
    judged = judged_motion(
        now.task, now.progress, knowledge, now.schedule, now.watch, motion, now.inputs.measured
    )
    log = now.log
    for decision in judged.decisions:
        log = log.with_decision(decision, 0.0)
    if judged.moved_by > 0.0:
        now = _moved_along(now, judged)
    if judged.task.model is not now.task.model:
        now = replace(now, before=_steering_by(now.before, judged.task.model))
    return replace(
        now, task=judged.task, watch=judged.watch, schedule=judged.schedule, work=judged.work,
        log=log, progress=judged.progress,
    )  # fmt: skip


def _as_seen(now: _StepSoFar) -> Knowledge:
    """What is known with what stands in sight now; what can be told once only is left for later."""
    sensed = now.inputs.sensed
    if not isinstance(sensed, Scan | Sequence):
        return now.knowledge
    standing = sensed if isinstance(sensed, Scan) else told_apart(sensed)[0]
    return perceive(now.knowledge, standing, now.time, foreseen)[0]


def _steering_by(before: NavigationState, model: DriveModel | None) -> NavigationState:
    """The step before, with a controller that decides by another model: its command is due now."""
    progress = before.progress
    if model is None or progress.controller is None:
        return before
    controller = replace(progress.controller, model=model)
    return replace(before, progress=replace(progress, controller=controller))


def _moved_along(now: _StepSoFar, judged: JudgedMotion) -> _StepSoFar:
    """The robot on a path that leads from where it was set, so much farther along it."""
    before = now.before.progress
    if before.controller is not None:
        before = replace(before, controller=before.controller.moved(judged.moved_by))
    return replace(
        now, before=replace(now.before, progress=before), progress=judged.progress,
        proven=judged.schedule,
    )  # fmt: skip


def _perceived(now: _StepSoFar) -> _StepSoFar:
    """What does it perceive? After the end only a lidar goes on."""
    sensed, knowledge, sighting = now.inputs.sensed, now.knowledge, None
    if isinstance(sensed, Scan):
        knowledge, sighting = perceive(knowledge, sensed, now.time, foreseen)
    else:
        standing, moving = told_apart(sensed)
        if moving or knowledge.tracked.tracks:
            knowledge = knowledge.with_sightings(moving, now.time, foreseen)
        if not now.progress.finished:
            knowledge, sighting = perceive(knowledge, standing, now.time, foreseen)
    events = broken_premises(now.task, now.progress, now.before.knowledge, knowledge, now.schedule)
    return replace(now, knowledge=knowledge, sighting=sighting, log=now.log.with_events(*events))


def _decided(now: _StepSoFar) -> _StepSoFar:
    """What does it do about what stands there?"""
    if now.sighting is None and now.schedule.pending is None and not now.is_part_new:
        return now
    respond = look_again if now.is_part_new else decide
    began = clock.perf_counter()
    decision = respond(now.task, now.progress, now.knowledge, now.schedule, now.sighting)
    log = now.log.with_decision(decision, clock.perf_counter() - began)
    progress, log = note_arrivals(now.task, now.progress, decision.schedule, log)
    return replace(
        now, progress=progress, schedule=decision.schedule, log=log,
        work=max(now.work, decision.work),
    )  # fmt: skip


def _given_way(now: _StepSoFar) -> _StepSoFar:
    """What does it do about what moves? Who waited for what is gone from sight goes on."""
    waits = now.schedule.gives_way and not now.schedule.waits_for_gap
    is_free = not len(now.knowledge.moving) and not waits
    if is_free or rests(now.knowledge, now.schedule, now.time):
        return now
    decision = give_way(now.task, now.progress, now.knowledge, now.schedule)
    log = now.log.with_decision(decision, 0.0)
    progress, log = note_arrivals(now.task, now.progress, decision.schedule, log)
    return replace(now, progress=progress, schedule=decision.schedule, log=log)


def _kept_stoppable(now: _StepSoFar, undecided: _StepSoFar) -> _StepSoFar:
    """Can it stand before anything that may come touches it? Else it keeps to what it had."""
    robot = now.task.mission.robot
    if robot.moving is None:
        return now
    sight = sight_of(robot, now.inputs.sensed, now.inputs.measured, now.time)
    coming = WhatMayCome(now.knowledge, robot.moving.max_speed_mps, sight)
    schedule = stoppable(now.task, now.progress, now.knowledge, now.proven, now.schedule, coming)
    is_put = stays_put(now.task, now.progress, schedule, coming)
    schedule = replace(schedule, stays_put=is_put)
    if schedule.path is now.schedule.path:
        return replace(now, schedule=schedule)
    progress = undecided.progress
    looked_at = now.knowledge.world if now.is_part_new else now.sighting
    schedule, event = kept_to_path(progress, now.knowledge, schedule, looked_at)
    log = undecided.log.with_events(event)
    return replace(now, progress=progress, schedule=schedule, log=log)


def _not_held_up(now: _StepSoFar) -> _StepSoFar:
    """Has it stood long enough without a way on?"""
    return replace(now, schedule=held_up(now.task, now.progress, now.knowledge, now.schedule))


def _commanded(now: _StepSoFar) -> StepTaken:
    """What is it to do now?"""
    task, stale, measured = now.task, now.inputs.stale, now.inputs.measured
    progress, schedule, before = now.progress, now.schedule, now.before
    if stale is not None and not progress.finished and schedule.giving_up is None:
        schedule = held_still(task, progress, schedule)
    controller = before.progress.controller
    if controller is not None and schedule.driven != before.schedule.driven:
        controller = controller.moved(before.schedule.driven - schedule.driven)
    progress, waiting = with_command(controller, progress, schedule, measured, now.time, now.work)
    schedule = waiting if stale is None else schedule
    command = command_for(task, progress, schedule, measured)
    if schedule.giving_up is not None and progress.finished:
        command = stop_command(task, command)
    watch = replace(now.watch, held=stale).having_given(
        now.time + now.work, command.speed, remembered_for(task)
    )
    state = NavigationState(progress, now.knowledge, schedule, now.log, now.work, watch)
    return StepTaken(command, task, state)
