"""The ways past what moves beside the path that a robot is on, some of them tried in each step.

Where there is room for that it swerves: round what moves, few paths are found that have a law, and
they cost most. Else it is led round what it would meet first. What a step has no time for is tried
in the next one.

Tested through ``robot/yielding/test_give_way``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

from viaspline.errors import PlanningError
from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.problem.work_budget import LAW_AMONG_S, WorkBudget
from viaspline.planning.replanning import replan
from viaspline.robot.replanning.path_candidate import PathCandidate, timed
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.yielding.meeting_ahead import meeting_ahead
from viaspline.robot.yielding.soonest_end import soonest_end
from viaspline.robot.yielding.swerves import Swerves, driven
from viaspline.spacetime.standing_ghost import standing_ghost
from viaspline.spacetime.timed_problem import without_lanes
from viaspline.trajectory.trajectory import Trajectory

WAYS_WORK_S = 0.01
"""No other way is begun in a step that has spent so much on them [s of the reference machine]."""

SIDE_WORK_S = 0.03
"""What may be spent on laying one of them [s of the reference machine]."""

LAID_S = 0.001
"""What a path costs that is laid and isn't clear of what stands [s of the reference machine]."""

SIDES: tuple[Side, Side] = ("left", "right")

Way: TypeAlias = Callable[[WorkBudget], PathCandidate | None]
"""Lays and times a path past what moves; None if there is none."""


@dataclass(frozen=True)
class TriedWays:
    """What some ways past what moves have come to.

    Attributes:
        best: The first to arrive of those that are worth it, with the number of its way.
        next_way: Which of them is tried next; 0 if all were.
    """

    best: tuple[PathCandidate, int] | None
    next_way: int


def try_ways(
    ways: Sequence[Way], begin: int, is_worth: Callable[[PathCandidate, int], bool]
) -> TriedWays:
    """Try ways one after the other, until the step has no time for more.

    Args:
        ways: The most promising first.
        begin: The first that was not tried yet.
        is_worth: Whether a path is worth being taken, by the number of its way.
    """
    budget, best = WorkBudget(WAYS_WORK_S), None
    at = begin if begin < len(ways) else 0
    while at < len(ways) and budget.spent < budget.limit:
        found = ways[at](budget)
        if found is not None and is_worth(found, at):
            ends = found.trajectory.end_time
            if best is None or ends < best[0].trajectory.end_time:
                best = found, at
        at += 1
    return TriedWays(best, at if at < len(ways) else 0)


def ways_past(
    context: ReplanContext, free: Trajectory, paths: Swerves, before: float
) -> tuple[Way, ...]:
    """The ways past what a robot would meet first.

    Args:
        context: The robot under way.
        free: The law that it would drive on its path if nothing moved.
        paths: By which it may swerve; where there are none it is led round.
        before: Who swerves and arrives no sooner than this gains nothing [s].
    """
    moving, path = context.knowledge.moving, context.schedule.path
    meeting = meeting_ahead(context.task, moving, path, free, context.progress.time)
    if meeting is None:
        return ()
    if paths:
        return tuple(partial(_swerved, context, paths, k, before) for k in range(len(paths.places)))
    return tuple(
        partial(_led_round, context, meeting.obstacle, side, window)
        for window in meeting.windows
        for side in SIDES
    )


def _swerved(
    context: ReplanContext, paths: Swerves, number: int, before: float, budget: WorkBudget
) -> PathCandidate | None:
    """A path by a place beside the robot's own, with its law; None if it ends too late.

    It is asked for with each room to spare: what no law at all serves isn't searched for any. The
    work that is reckoned is the same, so as many ways are tried in a step.
    """
    path = paths.path(number)
    if path is None:
        budget.spent += LAID_S
        return None
    budget.spent += LAW_AMONG_S
    if soonest_end(context, path.path) >= before:
        return None
    fastest = paths.fastest(number)
    if fastest is None or fastest.end_time >= before:
        return None
    return driven(context, path)


def _led_round(
    context: ReplanContext,
    obstacle: int,
    side: Side,
    window: tuple[float, float],
    budget: WorkBudget,
) -> PathCandidate | None:
    """The path on one side of where an obstacle is for a while, with its law."""
    apart = context.task.apart
    made = standing_ghost(context.knowledge.moving, obstacle, side, window, apart)
    if made is None:
        return None
    ghost, _ = made
    world = context.knowledge.world.with_obstacles([ghost])
    index, required = len(world) - 1, context.requirements.required
    places = [context.here[:2], *(via.at[:2] for via, _ in context.vias_ahead)]
    if (world.distances_to(index, places) < required).any():
        return None
    searching = context.searching(SIDE_WORK_S)
    path, until = context.schedule.path, context.schedule.looked_at
    stands = context.speed == 0.0
    lay = replan.from_rest if stands else replan.planned
    leave = context.stop if stands else context.leaves[0]
    try:
        requirements = without_lanes(searching.requirements)
        solution = lay(path, leave, world, requirements, (), until)
        budget.spent += LAW_AMONG_S
        return timed(context, "from_rest" if stands else "planned", solution)
    except PlanningError:
        return None
    finally:
        budget.spent += searching.work
