"""Round what is in the way: over to a new path, on looking for one, or to a stop for good.

Tested through ``robot/replanning/test_decide`` and ``robot/watching/test_renewed_allowance``.
"""

from __future__ import annotations

from dataclasses import replace

from viaspline.robot.navigation.decision import Decision
from viaspline.robot.replanning.deadline import with_time_to_search
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.replan_search import search
from viaspline.robot.replanning.transitions import keep_searching, stop_for_good, take_over


def way_round(blocked: ReplanContext) -> Decision:
    """What a robot does that has something in its way, in the time that it has for that.

    Args:
        blocked: The robot, with what is in its way.
    """
    context = with_time_to_search(blocked)
    result = search(context)
    if result.candidate is not None:
        decision = take_over(context, result.candidate, result.skip)
    elif result.begin_with is None:
        decision = stop_for_good(context, str(result.refusal))
    else:
        decision = keep_searching(context, result)
    return replace(decision, searched=True, work=context.work)
