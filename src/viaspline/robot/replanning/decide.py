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
from viaspline.robot.replanning.replan_context import Obstruction, ReplanContext
from viaspline.robot.replanning.replan_from_scan import replan_from_scan
from viaspline.robot.replanning.replan_search import search
from viaspline.robot.replanning.transitions import stop_for_good, take_over
from viaspline.world.world import World


def decide(
    task: DriveTask,
    progress: Progress,
    knowledge: Knowledge,
    schedule: Schedule,
    sighting: Sighting,
) -> Decision:
    """Go on, go round what is in the way, give up a point of the route, wait or stop.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: All that is known, with what was just seen.
        schedule: What the robot has meant to do so far.
        sighting: What was just seen.
    """
    if isinstance(sighting, News) and (progress.finished or schedule.giving_up is not None):
        return Decision(schedule)
    context = ReplanContext.of(task, progress, knowledge, schedule)
    if isinstance(sighting, World):
        return _round_obstacles(context, sighting)
    return replan_from_scan(context, opened=sighting.gone > 0)


def look_again(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule
) -> Decision:
    """Go round what is known and stands in the way of a part of the path that has come nearer."""
    context = ReplanContext.of(task, progress, knowledge, schedule)
    world = knowledge.world
    free = context.free_until(world)
    if free is None:
        return Decision(schedule)
    return _go_round(context, Obstruction(world, context.in_the_way(world), free))


def _round_obstacles(context: ReplanContext, new: World) -> Decision:
    """Round obstacles that are known exactly from when they are seen; if there is no way, stop."""
    detected = tuple(context.detection(new, i) for i in range(len(new)))
    unchanged = Decision(context.schedule, detected)
    if context.schedule.giving_up is not None:
        return unchanged
    free = context.free_until(new)
    if free is None:
        free = context.on_side_until(new)
    if free is None:
        return unchanged
    decision = _go_round(context, Obstruction(new, new.names, free))
    return replace(decision, events=detected + decision.events)


def _go_round(context: ReplanContext, obstruction: Obstruction) -> Decision:
    blocked = replace(context, obstruction=obstruction)
    result = search(blocked)
    if result.candidate is None:
        decision = stop_for_good(blocked, str(result.refusal))
    else:
        decision = take_over(blocked, result.candidate, result.skip)
    return replace(decision, searched=True)
