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
from viaspline.robot.replanning.deadline import is_paused
from viaspline.robot.replanning.replan_context import Obstruction, ReplanContext
from viaspline.robot.replanning.replan_from_scan import replan_from_scan
from viaspline.robot.replanning.transitions import let_go
from viaspline.robot.replanning.way_round import way_round
from viaspline.robot.run import Event
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


def look_again(
    task: DriveTask,
    progress: Progress,
    knowledge: Knowledge,
    schedule: Schedule,
    sighting: Sighting | None,
) -> Decision:
    """As ``decide`` when a part of the path has come nearer: whatever is known may be in its way.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: All that is known, with what was just seen.
        schedule: What the robot has meant to do so far.
        sighting: What was just seen, if it was anything new.
    """
    context = ReplanContext.of(task, progress, knowledge, schedule)
    if knowledge.belief is not None:
        return replan_from_scan(context, opened=False)
    new, world = sighting if isinstance(sighting, World) else World(), knowledge.world
    free = context.free_until(world)
    if free is None:
        return _round_obstacles(context, new)
    return _go_round(context, Obstruction(world, context.in_the_way(world), free), new)


def _round_obstacles(context: ReplanContext, new: World) -> Decision:
    """Round obstacles that are known exactly from when they are seen; if there is no way, stop."""
    if context.schedule.giving_up is not None:
        return Decision(context.schedule, _detected(context, new))
    pending, met, names = context.schedule.pending, new, new.names
    if pending is not None:
        pending = pending.with_new(new)
        met, names = pending.obstacles, pending.names
        context = replace(context, schedule=replace(context.schedule, pending=pending))
    free = context.free_until(met)
    if free is None:
        free = context.on_side_until(met)
    if free is None:
        return Decision(let_go(context), _detected(context, new))
    if not len(new) and is_paused(context, free):
        return Decision(context.schedule)
    return _go_round(context, Obstruction(met, names, free), new)


def _go_round(context: ReplanContext, obstruction: Obstruction, new: World) -> Decision:
    """Round what is in the way, of which some may be new, in the time that there is."""
    blocked = replace(context, obstruction=obstruction)
    decision = way_round(blocked)
    return replace(decision, events=_detected(context, new) + decision.events)


def _detected(context: ReplanContext, new: World) -> tuple[Event, ...]:
    return tuple(context.detection(new, i) for i in range(len(new)))
