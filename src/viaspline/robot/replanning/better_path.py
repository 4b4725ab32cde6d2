"""A better path for a robot whose own is free: something has gone, or it keeps too little."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

from viaspline.errors import PlanningError
from viaspline.planning.problem.requirements import Requirements
from viaspline.robot.navigation.decision import Decision
from viaspline.robot.replanning.deadline import unhurried
from viaspline.robot.replanning.first_way_on import first_candidate
from viaspline.robot.replanning.passing_sides import is_better
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.transitions import take_over

SPARE_RATIO = 0.1
"""What a new path keeps beyond what is required where there is room for it, of that distance: so
that what shows a little more of itself later does not block it again."""

REVIEW_INTERVAL_S = 1.0
"""Whether a better way has opened is asked no more often than this [s]."""


def better_path(context: ReplanContext, *, opened: bool) -> Decision:
    """A path that is clearly shorter than the one that is driven, if there may be one.

    Args:
        context: A robot with nothing in its way.
        opened: Whether something that was seen before has gone.
    """
    progress, schedule, world = context.progress, context.schedule, context.knowledge.world
    here, rest = progress.distance, schedule.path.length - progress.distance
    tight = schedule.reduced is not None and schedule.reduced.until > here
    due = progress.time >= schedule.reviewed_at + REVIEW_INTERVAL_S and progress.dwell is None
    if not due or not (tight or (opened and is_better(_straight_on(context), rest))):
        return Decision(schedule)
    reviewed = replace(schedule, reviewed_at=progress.time)
    freed = unhurried(
        replace(
            context,
            schedule=replace(reviewed, reduced=None),
            requirements=with_spare(context.requirements),
        )
    )
    try:
        candidate = first_candidate(freed, world, modes=("planned",))
    except PlanningError:
        return Decision(reviewed, searched=True, work=freed.work)
    if not tight and not is_better(candidate.solution.path.length - here, rest):
        return Decision(reviewed, searched=True, work=freed.work)
    return replace(take_over(freed, candidate, {}), searched=True, work=freed.work)


def with_spare(requirements: Requirements) -> Requirements:
    """What a path keeps where there is room to spare."""
    spare = SPARE_RATIO * requirements.required
    return replace(requirements, clearance=requirements.clearance + spare)


def _straight_on(context: ReplanContext) -> float:
    """Length of the way on if nothing were in it [m]."""
    stops = [context.here, *(via.at for via, _ in context.vias_ahead)]
    return sum(math.dist(a, b) for a, b in pairwise(stops))
