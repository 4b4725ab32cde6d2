"""The certificate of what is still ahead, renewed with what a robot is truly beside its path.

What was kept for the tracking error is a promise of the model. Where the machine breaks it, what is
measured takes its place: the path ahead is proven anew with that. Where it doesn't hold it is laid
anew, from the first place on that has room for more. Where that can't be at once, the robot looks
for a way on as round anything that is in its way, and stops if there is none.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from viaspline.errors import PlanningError
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.replanning import replan
from viaspline.robot.navigation.decision import Decision
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.reschedule import braking_at_once, rescheduled
from viaspline.robot.navigation.schedule import ReducedClearance, Schedule
from viaspline.robot.navigation.track_path import STANDSTILL_MPS
from viaspline.robot.perception.body_room import room_along
from viaspline.robot.replanning.deadline import with_time_to_search
from viaspline.robot.replanning.path_candidate import PathCandidate, timed
from viaspline.robot.replanning.recovery import set_down, way_on_from_close, way_out
from viaspline.robot.replanning.replan_context import Obstruction, ReplanContext
from viaspline.robot.replanning.transitions import stop_for_good, take_over
from viaspline.robot.replanning.way_round import SLACK_M, SPACING_RATIO, way_on
from viaspline.robot.run import Event
from viaspline.robot.watching.path_deviation import Deviation

LAY_WORK_S = (0.03, 0.12)
"""What may be spent on a new path: first, and then [s of the reference machine]."""

LAID_ANEW = "the path ahead is laid anew with that"


@dataclass(frozen=True)
class RenewedAllowance:
    """A drive that goes on with what its robot is truly beside its path.

    Attributes:
        task: With what is kept for that from now on.
        decision: What the robot means to do, and what there is to note of it.
        progress: Where it is by that, if it goes on from where it was set; None: where it was.
    """

    task: DriveTask
    decision: Decision
    progress: Progress | None = None


def renewed_allowance(
    task: DriveTask,
    progress: Progress,
    knowledge: Knowledge,
    schedule: Schedule,
    deviation: Deviation,
) -> RenewedAllowance:
    """How a robot goes on that is farther beside its path than was kept.

    Args:
        task: What is asked of the drive.
        progress: How far the robot has come.
        knowledge: All that is known.
        schedule: What it means to do.
        deviation: How far it is beside its path.
    """
    if deviation.returns is not None:
        context = ReplanContext.of(task, progress, knowledge, schedule)
        if not deviation.returns and _may_set_off_anywhere(context, deviation):
            if deviation.speed > STANDSTILL_MPS:
                return RenewedAllowance(task, _braking_first(context, deviation))
            anew = from_where_it_was_set(context, deviation)
            if anew is not None:
                return anew
        return RenewedAllowance(task, _set_back(context, deviation))
    requirements = replace(task.requirements, tracking_error=deviation.needed)
    renewed = replace(task, requirements=requirements)
    context = ReplanContext.of(renewed, progress, knowledge, schedule)
    if knowledge.belief is not None:  # what it sees decides anew with every scan
        told = _told(context, deviation, "what is ahead is looked at again with that", "renewed")
        return RenewedAllowance(renewed, Decision(schedule, (told,)))
    free = context.free_until(knowledge.world)
    if free is None:
        told = _told(context, deviation, "the path ahead is proven clear with that", "holds")
        return RenewedAllowance(renewed, Decision(schedule, (told,)))
    names = context.in_the_way(knowledge.world)
    blocked = replace(context, obstruction=Obstruction(knowledge.world, names, free))
    return RenewedAllowance(renewed, _laid_anew(blocked, deviation))


def from_where_it_was_set(context: ReplanContext, deviation: Deviation) -> RenewedAllowance | None:
    """How one goes on that was set beside its path and can't come back: on a path from there.

    Where a body was set it can be: it comes no nearer to anything than it is, and keeps all from
    the first place on that has room.

    Returns:
        None if it can't turn there, or if there is no such path.
    """
    task = context.task
    at, requirements = np.array(deviation.at[:2]), task.requirements
    floor = min(float(context.knowledge.world.distance(at[None])[0]), requirements.required)
    floor -= SLACK_M
    if floor < requirements.radius:
        return None
    there = set_down(context, at, floor)
    there = replace(there, obstruction=Obstruction(there.knowledge.world, (), there.stop))
    spacing, candidate, work = SPACING_RATIO * requirements.required, None, 0.0
    for limit in LAY_WORK_S:
        searching = there.searching(limit)
        try:
            candidate = way_out(searching, searching.task.requirements, floor)
            if candidate is None:
                kept = (searching.task.requirements,)
                candidate = way_on_from_close(searching, floor, spacing, kept).candidate
        except SpentBudgetError:
            candidate = None
        work = searching.work
        if candidate is not None:
            break
    if candidate is None:
        return None
    told = _told(context, deviation, "it goes on from there on a path of its own", "laid anew")
    decision = take_over(there, candidate, {})
    decision = replace(decision, events=(told, *decision.events), searched=True, work=work)
    return RenewedAllowance(task, decision, there.progress)


def _may_set_off_anywhere(context: ReplanContext, deviation: Deviation) -> bool:
    """Whether a robot that was set beside its path can turn on the spot and go on from there."""
    requirements, schedule = context.task.requirements, context.schedule
    turns = requirements.turns_at_rest and requirements.footprint is None
    is_plain = schedule.path.dimension == 2 and schedule.laps is None
    return turns and is_plain and deviation.turned == 0.0


def _braking_first(context: ReplanContext, deviation: Deviation) -> Decision:
    """How one that can't come back to its path brakes, to go on from where it stands then."""
    motion = replace(context.motion, speed=min(context.speed, deviation.speed))
    law = braking_at_once(context.task, context.progress, context.schedule, motion.speed)
    schedule = replace(context.schedule, trajectory=law, pending=None, held_at=context.stop)
    if deviation.was_told:
        return Decision(schedule)
    then = "the way back is not clear: it stands first, and goes on from there"
    return Decision(schedule, (_told(context, deviation, then, "brakes"),))


def _set_back(context: ReplanContext, deviation: Deviation) -> Decision:
    """How one goes on that was set beside its path: back to it, or not at all."""
    task, progress, knowledge = context.task, context.progress, context.knowledge
    schedule = context.schedule
    if deviation.returns:
        told = _told(context, deviation, "it comes back to it, where it is clear", "returns")
        if deviation.slowly is not None:
            slow = replace(schedule, slow=(*schedule.slow, deviation.slowly))
            speed = float(schedule.trajectory.state_at(progress.time)[1])
            schedule = rescheduled(task, progress, knowledge, slow, speed)
        return Decision(schedule, (told,))
    told = _told(context, deviation, "the way back is not clear", "stops")
    why = f"it was set {deviation.off:.2f} m beside its path, and the way back is not clear"
    if deviation.turned != 0.0:
        why = (
            f"it looks {math.degrees(abs(deviation.turned)):.0f}° away from its path, and has no "
            "room to turn to it: turn it, or say how it stands by route.start.heading_deg"
        )
    # its law may be faster than what was set there is
    motion = replace(context.motion, speed=min(context.speed, deviation.speed))
    stopped = stop_for_good(replace(context, motion=motion), why)
    return replace(stopped, events=(told, *stopped.events))


def _laid_anew(context: ReplanContext, deviation: Deviation) -> Decision:
    """A path that keeps more, from the first place on that has room for it; or a search for one."""
    tried: tuple[PathCandidate | None, float] = (None, 0.0)
    for limit in LAY_WORK_S:
        try:
            tried = _candidate(context.searching(limit))
            break
        except SpentBudgetError:
            tried = (None, limit)
    candidate, work = tried
    if candidate is None:
        return _looked_for(context, deviation, work)
    told = _told(context, deviation, LAID_ANEW, "laid anew")
    decision = take_over(context, candidate, {})
    return replace(decision, events=(told, *decision.events), searched=True, work=work)


def _looked_for(context: ReplanContext, deviation: Deviation, work: float) -> Decision:
    """The search for a path that keeps more, braking for it; a stop where there is none.

    Args:
        context: The robot, with what is too near to the path ahead.
        deviation: How far it is beside it.
        work: What was spent already [s of the reference machine].
    """
    searching = with_time_to_search(context)
    found = way_on(searching)
    if isinstance(found, str):
        told = _told(context, deviation, "no path ahead that keeps so much was found", "stops")
        why = f"it gets {deviation.off:.2f} m beside its path, and what is ahead is not clear then"
        decision = stop_for_good(context, f"{why}: {found}")
    elif found.replan is None:
        told = _told(context, deviation, "one that keeps so much is looked for", "searches")
        decision = found
    else:
        told = _told(context, deviation, LAID_ANEW, "laid anew")
        decision = found
    events = (told, *decision.events)
    return replace(decision, events=events, searched=True, work=work + searching.work)


def _candidate(context: ReplanContext) -> tuple[PathCandidate | None, float]:
    """A path with more room, and what was spent on it [s of the reference machine].

    It may begin as fast as the robot is, though that may be more than it should be by now.

    Raises:
        SpentBudgetError: When more would have to be.
    """
    path, world = context.schedule.path, context.knowledge.world
    requirements, here = context.requirements, context.progress.distance
    spacing = SPACING_RATIO * requirements.required
    limits = context.task.limits
    limits = replace(limits, max_speed=max(limits.max_speed, context.speed))
    context = replace(context, task=replace(context.task, limits=limits))
    for leave in context.leaves:
        places = np.arange(leave, path.length, spacing)
        room = room_along(world, path, places, requirements)
        roomy = np.flatnonzero(room >= requirements.required)
        if not roomy.size:
            continue
        at = float(places[roomy[0]])
        before = np.linspace(here, at, 2 + int((at - here) / spacing))
        floor = float(np.min(room_along(world, path, before, requirements))) - SLACK_M
        if floor < requirements.radius + requirements.tracking_error:
            return None, context.work  # it might touch something on the way there
        less = context
        if floor < requirements.required:
            reduced = ReducedClearance(at, floor)
            less = replace(context, schedule=replace(context.schedule, reduced=reduced))
        try:
            solution = replan.planned(path, at, world, requirements, (), less.schedule.looked_at)
        except SpentBudgetError:
            raise
        except PlanningError:
            continue
        # its model says that the robot gets too far beside it? it has been wrong already
        candidate = timed(less, "planned", solution) or timed(_untried(less), "planned", solution)
        if candidate is not None:
            return candidate, context.work
    return None, context.work


def _untried(context: ReplanContext) -> ReplanContext:
    """A context in which a path isn't driven ahead by the model."""
    requirements = replace(context.task.requirements, tracking_error=0.0)
    return replace(context, task=replace(context.task, requirements=requirements))


def _told(context: ReplanContext, deviation: Deviation, then: str, outcome: str) -> Event:
    task, kept = context.task, f"{deviation.kept:.3f} m are kept for that"
    if task.model is None and deviation.kept == 0.0:
        kept = "no allowance is kept: the mission has no robot.drive, nor robot.tracking_error_m"
    if deviation.returns is None:
        kept += f", {deviation.needed:.3f} m from now on"
    data = {
        "off_m": deviation.off,
        "kept_m": deviation.kept,
        "allowance_m": deviation.needed,
        "clearance_m": None if math.isinf(deviation.clearance) else deviation.clearance,
        "outcome": outcome,
    }
    words = f"is {deviation.off:.3f} m beside its path; {kept}; {then}"
    if deviation.turned != 0.0:
        away = math.degrees(abs(deviation.turned))
        words = f"looks {away:.0f}° away from its path, {deviation.off:.3f} m beside it; {then}"
    return Event("deviation", context.progress.time, context.here, words, data)
