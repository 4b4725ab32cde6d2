"""Round what is in the way: over to a new path, on looking for one, or to a stop for good.

Tested through ``robot/replanning/test_decide`` and ``robot/watching/test_renewed_allowance``.
"""

from __future__ import annotations

from dataclasses import replace

from viaspline.robot.navigation.decision import Decision
from viaspline.robot.replanning.deadline import SPENT_AT_REST, with_time_to_search
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.replan_search import search
from viaspline.robot.replanning.transitions import keep_searching, stop_for_good, take_over


def way_round(blocked: ReplanContext) -> Decision:
    """What a robot does that has something in its way, in the time that it has for that.

    Args:
        blocked: The robot, with what is in its way.
    """
    context = with_time_to_search(blocked)
    found = way_on(context)
    decision = stop_for_good(context, found) if isinstance(found, str) else found
    return replace(decision, searched=True, work=context.work)


def way_on(context: ReplanContext) -> Decision | str:
    """Over to a new path, or on looking for one; why not, where there is nothing left but to stop.

    Args:
        context: The robot, with what is in its way and what it may spend on its search.
    """
    result = search(context)
    if result.candidate is not None:
        return take_over(context, result.candidate, result.skip)
    if result.begin_with is None:
        return str(result.refusal)
    return keep_searching(context, result) or SPENT_AT_REST
