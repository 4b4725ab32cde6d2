"""What a robot does about what it has just perceived."""

from __future__ import annotations

from dataclasses import replace

from viaspline.robot.navigation.decision import Decision
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.perception.belief import News
from viaspline.robot.perception.perceive import Sighting
from viaspline.robot.replanning.deadline import with_time_to_search
from viaspline.robot.replanning.replan_context import Obstruction, ReplanContext
from viaspline.robot.replanning.replan_from_scan import replan_from_scan
from viaspline.robot.replanning.replan_search import FIRST_STAGE, search
from viaspline.robot.replanning.transitions import keep_searching, stop_for_good, take_over
from viaspline.world.world import World


def decide(
    task: DriveTask,
    progress: Progress,
    knowledge: Knowledge,
    schedule: Schedule,
    sighting: Sighting | None,
) -> Decision:
    """Go on, go round what is in the way, give up a point of the route, wait or stop.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: All that is known, with what was just seen.
        schedule: What the robot has meant to do so far.
        sighting: What was just seen, if it was anything new.
    """
    if sighting is None:
        sighting = World()
    if isinstance(sighting, News) and (progress.finished or schedule.giving_up is not None):
        return Decision(schedule)
    context = ReplanContext.of(task, progress, knowledge, schedule)
    if isinstance(sighting, World):
        return _round_obstacles(context, sighting)
    return replan_from_scan(context, opened=sighting.gone > 0)


def _round_obstacles(context: ReplanContext, new: World) -> Decision:
    """Round obstacles that are known exactly from when they are seen; if there is no way, stop."""
    detected = tuple(context.detection(new, i) for i in range(len(new)))
    unchanged = Decision(context.schedule, detected)
    if context.schedule.giving_up is not None:
        return unchanged
    pending = context.schedule.pending
    met = new if pending is None else World((*pending.obstacles.obstacles, *new.obstacles))
    free = context.free_until(met)
    if free is None:
        return unchanged
    if pending is not None and len(new):  # what has just been seen may bar what was tried
        begun = replace(pending, obstacles=met, begin_with=FIRST_STAGE)
        context = replace(context, schedule=replace(context.schedule, pending=begun))
    blocked = replace(context, obstruction=Obstruction(met, met.names, free))
    decision = _searched(with_time_to_search(blocked))
    return replace(decision, events=detected + decision.events)


def _searched(context: ReplanContext) -> Decision:
    """Go over to a new path, stop for good, or go on looking for one."""
    result = search(context)
    if result.candidate is not None:
        decision = take_over(context, result.candidate, result.skip)
    elif result.begin_with is None:
        decision = stop_for_good(context, str(result.refusal))
    else:
        decision = keep_searching(context, result)
    return replace(decision, searched=True, work=context.work)
