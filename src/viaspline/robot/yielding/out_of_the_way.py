"""What a robot does that can't get past what moves: what meets it last.

Tested through ``robot/yielding/test_give_way``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from viaspline.robot.navigation.decision import Decision
from viaspline.robot.navigation.reschedule import braking_at_once
from viaspline.robot.replanning.path_candidate import PathCandidate
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.transitions import take_over
from viaspline.robot.run import Event
from viaspline.robot.yielding.meeting_ahead import meeting_ahead
from viaspline.robot.yielding.swerves import Swerves
from viaspline.spacetime.meetings import Meeting
from viaspline.trajectory.trajectory import Trajectory

LATER_S = 0.1
"""A new path has to be met so much later than any law on this one [s]."""


def out_of_the_way(context: ReplanContext, free: Trajectory, paths: Swerves) -> Decision:
    """What the robot meets nothing on for the longest time; braking if it is no worse.

    Args:
        context: The robot, which has no way past all that moves.
        free: The law that it would drive on its path if nothing moved.
        paths: By which it may swerve.
    """
    schedule, progress, task = context.schedule, context.progress, context.task
    braking = braking_at_once(task, progress, schedule, context.speed)
    laws = (braking, schedule.trajectory, free)
    moving, now = context.knowledge.moving, progress.time
    meetings = [meeting_ahead(task, moving, schedule.path, law, now) for law in laws]
    until = [math.inf if meeting is None else meeting.begins for meeting in meetings]
    best = max(range(len(laws)), key=lambda k: (until[k], -k))
    aside = _aside(context, paths, until[best] + LATER_S)
    if aside is not None:
        decision = take_over(context, aside, {})
        moved = replace(decision.schedule, timed_at=now, gives_way=True)
        return replace(decision, schedule=moved)
    held = replace(schedule, trajectory=laws[best], timed_at=now, gives_way=True)
    if best != 0 or context.speed == 0.0 or schedule.gives_way:
        return Decision(held)
    name = _met(context, meetings)
    words = f"brakes for '{name}', which moves"
    return Decision(held, (Event("braked", now, context.here, words),))


def _aside(context: ReplanContext, paths: Swerves, later: float) -> PathCandidate | None:
    """The path beside this one that meets something last, if that is later than a time [s].

    One that is to be at rest in time brakes on its path, where that is proven, until it stands.
    """
    is_passive = context.task.mission.robot.is_passive
    if later == math.inf or (is_passive and context.speed > 0.0):
        return None
    moving, now = context.knowledge.moving, context.progress.time
    best = None
    for candidate in paths.alone():
        path, law = candidate.solution.path, candidate.trajectory
        met = meeting_ahead(context.task, moving, path, law, now)
        begins = math.inf if met is None else met.begins
        if begins > later:
            best, later = candidate, begins
    return best


def _met(context: ReplanContext, meetings: Sequence[Meeting | None]) -> str:
    """The name of what is met first on any of the laws."""
    known = [meeting for meeting in meetings if meeting is not None]
    first = min(known, key=lambda meeting: meeting.begins)
    return context.knowledge.moving.name(first.obstacle)
