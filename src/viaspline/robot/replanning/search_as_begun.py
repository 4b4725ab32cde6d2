"""A search for a way on goes on through what the robot saw when it began.

Every scan of a lidar shows more of the same walls, or with noise the same a little elsewhere. A
search that began anew with each of them would never come farther than it does in a step. So it goes
on in the world in which it began, from a place that stays the same, and what it has found is looked
at in the world as it is by then.

Tested through ``robot/replanning/test_search_as_begun``.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.robot.navigation.pending_search import FIRST_STAGE
from viaspline.robot.replanning.path_candidate import PathCandidate
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.replan_search import ReplanResult

OUTDATED: Final = ReplanResult(None, "what was found isn't clear any more", begin_with=FIRST_STAGE)
"""What comes of a search whose path isn't clear any more: it begins anew."""


def as_first_seen(context: ReplanContext) -> ReplanContext:
    """A robot whose search goes on from one place, with what it knew when it began; others as are.

    That is where it stands, or where it will leave its path if it never turns on the spot. What it
    has to stop for under way is what it sees now.

    Args:
        context: The robot, with what is in its way.
    """
    pending = context.schedule.pending
    if pending is None or (context.speed > 0.0 and context.settled_leave is None):
        return context
    world = pending.so_far.world
    begun = replace(context, knowledge=replace(context.knowledge, world=world))
    if context.speed > 0.0:
        return begun
    return replace(begun, obstruction=replace(context.obstruction, world=world))


def holds_now(context: ReplanContext, candidate: PathCandidate) -> bool:
    """Whether a path that was found through what was seen keeps clear of what is known now.

    Args:
        context: The robot, with what it knows now.
        candidate: The path.
    """
    world = context.knowledge.world
    if as_first_seen(context).knowledge.world is world:
        return True
    schedule = replace(context.schedule, path=candidate.solution.path, reduced=candidate.reduced)
    now = ReplanContext.of(context.task, context.progress, context.knowledge, schedule)
    return now.free_until(world) is None


def begun_anew(searched: ReplanContext, now: ReplanContext) -> ReplanContext:
    """The robot after a step in which it found what isn't clear any more.

    Args:
        searched: With what it went by, and what it has spent.
        now: With what it knows now.
    """
    before = searched.requirements.budget
    assert before is not None
    budget = WorkBudget(before.limit, before.spent, has_gained=True)
    return replace(
        searched,
        knowledge=now.knowledge,
        obstruction=now.obstruction,
        requirements=searched.requirements.within(budget),
    )
