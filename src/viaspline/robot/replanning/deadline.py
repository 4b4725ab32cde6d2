"""How long a robot under way may look for a new path before it has to brake.

Tested through ``robot/replanning/test_decide``.
"""

from __future__ import annotations

import math

from viaspline.robot.navigation.pending_search import (
    FIRST_STAGE,
    NO_STAGE,
    PendingSearch,
    SearchSoFar,
    SideInDoubt,
    Stage,
)
from viaspline.robot.replanning.replan_context import NOTHING, ReplanContext

STEP_WORK_S = 0.03
"""What one step of a robot under way spends on a search, at most [s of the reference machine]: with
what it perceives, and on a busy machine, the step then takes 50 ms."""

STANDING_WORK_S = 0.1
"""What one that stands spends on it at first: nothing comes nearer to it meanwhile, and what it
sees hardly changes, but with noise it does, and then its search begins anew."""

SHARES = (1.0, 0.5, 0.25)
"""Parts of that which are tried where the robot has to brake before."""

ROOM_RATIO = 2.0
"""So many required distances are left before what is in the way, and the radius of its circle by a
robot that never turns on the spot,"""

SPARE_RATIO = 0.5
"""and so much of one the place is known to."""

RETRY_INTERVAL_S = 0.3
"""Who has tried all that it has time for under way tries again so much later [s],"""

PAUSE_RATIO = 0.05
"""or after so much of the time until it is where it has to stop, if that is longer."""

MAX_STANDING_WORK_S = 64.0
"""What a robot that stands spends on a search in all, as much as the longest plans take,"""

MAX_PART_WORK_S = 3.2
"""and on a part of it at most. A step in which not even a part of it was over is followed by one
that may spend twice as much."""

SPENT_AT_REST = (
    f"stands and has found no way on in the {MAX_STANDING_WORK_S:g} s of work that a search at "
    "rest may take; plan anew from where it stands with what it has seen (Navigator.world), for a "
    "plan has no such limit, or lead it by a via point"
)
"""Why it gives up then, and what helps: its search under way was over before, whatever
``max_replan_s`` had been."""


def with_time_to_search(context: ReplanContext) -> ReplanContext:
    """The robot with what this step may spend on its search, and committed to its path for that.

    It goes on as it meant to while it searches. So it begins with a new path where it is then, and
    it searches no longer than it can and still stop before what is in its way.

    Args:
        context: The robot, with what is in its way.
    """
    pending, found = context.schedule.pending, NOTHING
    if pending is not None and pending.so_far.world is context.knowledge.world:
        found = pending.so_far.finished
    if context.speed == 0.0:
        limit = STANDING_WORK_S if pending is None else pending.so_far.limit
        standing = context.searching(limit, found)
        if standing.speed == 0.0:
            return standing
    longest = min(STEP_WORK_S, _until_next_command(context), _left(context))
    for share in SHARES if longest > 0.0 else ():
        committed = context.searching(share * longest, found)
        if committed.is_clear(committed.stop):
            return committed
    # who is guided by a lidar may be too close already, and slow: it leaves as soon as it can
    is_late = context.knowledge.belief is not None and not context.is_clear(context.stop)
    return context.searching(SHARES[-1] * STEP_WORK_S if is_late else 0.0, found)


def gone_on(
    context: ReplanContext, begin_with: Stage, held_at: float, doubt: SideInDoubt | None
) -> PendingSearch | None:
    """How a search that was stopped goes on; None if it has spent all that it may, at rest.

    Args:
        context: The robot that has searched.
        held_at: Where it stops meanwhile, along the path [m].
        begin_with: The stage that comes next, or ``NO_STAGE``.
        doubt: What it was found to pass on another side, if that is not decided yet.
    """
    before, obstacles = context.schedule.pending, context.obstruction.world
    names = context.obstruction.names
    since = context.progress.time if before is None else before.since
    budget, world = context.requirements.budget, context.knowledge.world
    assert budget is not None
    if context.speed > 0.0:
        again = -math.inf
        if begin_with == NO_STAGE:
            pause = max(RETRY_INTERVAL_S, PAUSE_RATIO * _until_there(context, held_at))
            begin_with, again, doubt = FIRST_STAGE, context.progress.time + pause, None
        so_far = SearchSoFar(STANDING_WORK_S, 0.0, world, budget.finished)
        free, leave = context.obstruction.free_until, _settled_leave(context, again)
        if leave is not None and leave != context.settled_leave and begin_with < NO_STAGE:
            begin_with = (begin_with[0], 0)  # from there nothing of this mode was tried yet
        return PendingSearch(
            since, obstacles, names, begin_with, so_far, again, free, doubt, leave,
            brakes=must_brake(context),
        )  # fmt: skip
    spent = budget.spent + (0.0 if before is None else before.so_far.spent)
    limit = max(budget.limit if budget.has_gained else 2.0 * budget.limit, STANDING_WORK_S)
    if limit > MAX_PART_WORK_S or spent + limit > MAX_STANDING_WORK_S:
        return None
    so_far = SearchSoFar(limit, spent, world, budget.finished)
    return PendingSearch(since, obstacles, names, begin_with, so_far, doubt=doubt)


def _until_there(context: ReplanContext, place: float) -> float:
    """How long the robot takes by its law to a place, or to where that ends if it is nearer [s].

    One that has just set off is slow, but not for long.
    """
    law = context.schedule.trajectory
    arrives = law.time_at(min(place, float(law.distances[-1])))
    return max(float(arrives) - context.progress.time, 0.0)


def _settled_leave(context: ReplanContext, again: float) -> float | None:
    """Where a robot under way leaves its path if its search comes to something before [m].

    A search from one place goes on from step to step; for one that turns on the spot where it
    stands, that place will do. One that doesn't has to turn away before: it searches from halfway
    there, and once it has passed that, from halfway again.

    Args:
        context: The robot that has searched.
        again: When it goes on; later than now if it has tried all that it has time for [s].
    """
    if context.requirements.turns_at_rest or again > context.progress.time:
        return None
    return context.settled_leave or 0.5 * (context.leaves[0] + max(context.leaves))


def is_paused(context: ReplanContext, free: float) -> bool:
    """Whether a robot under way goes on as it is before it searches again.

    Args:
        context: The robot, with something in its way.
        free: Up to this distance along the path it is clear [m].
    """
    pending = context.schedule.pending
    if pending is None or context.speed == 0.0:
        return False
    if must_brake(context) and not pending.brakes:
        return False
    return context.progress.time < pending.again and free >= pending.free_until


def must_brake(context: ReplanContext) -> bool:
    """Whether the robot has searched for as long as ``max_replan_s`` lets it under way."""
    is_searching = context.schedule.pending is not None
    return context.speed > 0.0 and is_searching and _until_deadline(context) <= 0.0


def stopping_place(context: ReplanContext) -> float:
    """Where the robot stops whose time to search is up [m]: it brakes as soon as it can.

    It goes on to search on its way there: nothing is nearer by then than it would have been.
    """
    pending = context.schedule.pending
    if pending is not None and pending.brakes:
        return context.schedule.held_at
    return min(context.stop, context.schedule.held_at)


def last_place(context: ReplanContext) -> float:
    """How far the robot goes on while it searches [m]: where it stands there is room to turn away.

    That is where it was held in the step before, as long as there is. It is never held farther on.

    Args:
        context: The robot, that can stop before what is in its way.
    """
    low, high = context.stop, context.schedule.looked_at
    held, needs = context.schedule.held_at, context.requirements
    room = ROOM_RATIO * needs.required
    if needs.turn_radius is not None and not needs.turns_at_rest:
        room += needs.turn_radius
    if context.is_clear(high):  # what it passes on a wrong side is not too near
        high = max(low, context.obstruction.free_until)
    elif low <= held < high and context.is_clear(min(held + room, high)):
        return held
    while high - low > SPARE_RATIO * context.requirements.required:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if context.is_clear(middle) else (low, middle)
    return min(max(context.stop, low - room), held)


def unhurried(context: ReplanContext) -> ReplanContext:
    """The robot with what a step may spend while nothing is in its way."""
    return context.searching(STEP_WORK_S)


def _until_next_command(context: ReplanContext) -> float:
    """How long a robot with a drive can go on by its last command [s]: then it needs another.

    Held for longer, what it was told in a bend leads it off its path.
    """
    controller = context.progress.controller
    return float("inf") if controller is None else controller.period


def _left(context: ReplanContext) -> float:
    """How much longer the robot may search before it brakes for that [s]; inf if it does already.

    In the step in which it begins to brake it doesn't search: it would go on meanwhile.
    """
    pending = context.schedule.pending
    if pending is not None and pending.brakes:
        return float("inf")
    return _until_deadline(context)


def _until_deadline(context: ReplanContext) -> float:
    """What is left of ``max_replan_s`` [s]; inf if that isn't said."""
    longest, pending = context.task.mission.robot.max_replan_s, context.schedule.pending
    if longest is None:
        return float("inf")
    return longest if pending is None else longest - (context.progress.time - pending.since)
