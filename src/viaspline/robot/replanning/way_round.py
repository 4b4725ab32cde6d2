"""Round what is in the way: over to a new path, on looking for one, or to a stop for good.

Tested through ``robot/replanning/test_decide`` and ``robot/watching/test_renewed_allowance``.
"""

from __future__ import annotations

from dataclasses import replace

from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.robot.navigation.decision import Decision
from viaspline.robot.navigation.pending_search import FIRST_STAGE
from viaspline.robot.replanning.deadline import SPENT_AT_REST, with_time_to_search
from viaspline.robot.replanning.recovery import room_to_stop, way_on_from_close, way_out
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.replan_search import ReplanResult, search
from viaspline.robot.replanning.transitions import keep_searching, stop_for_good, take_over

SPACING_RATIO = 0.25
"""From place to place at which the room is looked at, of what is required."""

SLACK_M = 1e-3
"""By which there may be less room than these places show [m]."""


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
    result = _found(context)
    if result.candidate is not None:
        return take_over(context, result.candidate, result.skip)
    if result.begin_with is None:
        return str(result.refusal)
    return keep_searching(context, result) or SPENT_AT_REST


def _found(context: ReplanContext) -> ReplanResult:
    """What a search comes to; one that has spent its time goes on in the next step."""
    try:
        return _way_on_or_out(context)
    except SpentBudgetError as error:
        return ReplanResult(None, error, begin_with=FIRST_STAGE)


def _way_on_or_out(context: ReplanContext) -> ReplanResult:
    """What a search comes to: of a robot with less room than it is to keep, one out of there first.

    So it is where more is kept from now on for what it gets beside its path than was when that was
    laid.
    """
    requirements = context.requirements
    spacing = SPACING_RATIO * requirements.required
    floor = room_to_stop(context, spacing) - SLACK_M
    if floor >= requirements.required - 2.0 * SLACK_M:
        return search(context)
    if floor < requirements.radius + requirements.tracking_error:  # it might touch something
        found = search(context)
    else:
        found = way_on_from_close(context, floor, spacing, (requirements,))
    is_over = found.candidate is not None or found.begin_with is not None
    if is_over or floor < requirements.radius:
        return found
    # straight away from what is near, where it comes no nearer than it stands
    out = way_out(context, requirements, floor)
    return found if out is None else ReplanResult(out)
