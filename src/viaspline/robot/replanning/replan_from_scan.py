"""A robot with a lidar: it goes on inside of what it has seen, round what is in its way.

Two things keep it safe, and neither waits for the other. The trajectory ends, at rest, where the
robot is not certain to be free any more: so it stops in time even if there is no way on. And where
the path ahead comes too close to what has been seen, far away or near, a new one is sought.
"""

from __future__ import annotations

import math
from dataclasses import replace

from viaspline.errors import PlanningError
from viaspline.planning.checking.conflicts import too_close
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.routing.leg_errors import BlockedLegError, UnfinishedLegError
from viaspline.robot.navigation.decision import Decision
from viaspline.robot.navigation.pending_search import FIRST_STAGE
from viaspline.robot.navigation.schedule import Schedule, Wait
from viaspline.robot.replanning.better_path import better_path, with_spare
from viaspline.robot.replanning.deadline import (
    RETRY_INTERVAL_S,
    SPENT_AT_REST,
    is_paused,
    last_place,
    with_time_to_search,
)
from viaspline.robot.replanning.recovery import room_to_stop, way_on_from_close, way_out
from viaspline.robot.replanning.replan_context import Obstruction, ReplanContext
from viaspline.robot.replanning.replan_search import ReplanResult, search
from viaspline.robot.replanning.retreat import retreat
from viaspline.robot.replanning.search_as_begun import (
    OUTDATED,
    as_first_seen,
    begun_anew,
    holds_now,
)
from viaspline.robot.replanning.sight_limit import within_sight
from viaspline.robot.replanning.transitions import braked, keep_searching, stop_for_good, take_over
from viaspline.world.world import World

MIN_REPLAN_INTERVAL_S = 0.25
"""A path that is blocked far ahead is laid anew no more often than this [s]."""

MAX_STAND_S = 5.0
"""A robot gives up if it has stood so long without a way [s]."""

LONG_WORK_S = 4.0
"""A robot that stands and looks for a way on tries the way back whenever it has spent so much more
[s of the reference machine]."""

MAX_INTO_DISC_RATIO = 0.5
"""So far the body may get into the discs on surfaces on its way out, of their radius."""

MAX_APPROACH_M = 1e-3
"""By which a robot that has come too close may come closer yet [m]."""


def replan_from_scan(context: ReplanContext, *, opened: bool) -> Decision:
    """How a robot under way goes on after one more scan.

    Args:
        context: The robot; its drive is not over yet.
        opened: Whether something that was seen before has gone.
    """
    schedule = context.schedule
    free = context.free_until(context.knowledge.world)
    if free is not None:
        blocked = replace(context, schedule=replace(schedule, probed_until=0.0))
        decision = _round_obstruction(blocked, free)
    else:
        unblocked = replace(schedule, pending=None, held_at=math.inf)
        unblocked = replace(unblocked, wait=None) if schedule.is_blocked else unblocked
        decision = better_path(replace(context, schedule=unblocked), opened=opened)
    if decision.schedule.giving_up is not None:
        return decision
    committed = _while_searched(context, decision)
    seen = within_sight(context.task, context.progress, context.knowledge, committed, context.speed)
    return replace(decision, schedule=seen)


def _while_searched(context: ReplanContext, decision: Decision) -> Schedule:
    """The schedule that stays as it was for as long as the search took.

    The robot is told what follows no sooner: a trajectory that began before would have left it.
    """
    schedule = decision.schedule
    if context.progress.controller is None or decision.work == 0.0:
        return schedule
    until = schedule.trajectory.cut_after(context.progress.time + decision.work)
    return replace(schedule, committed_until=max(schedule.committed_until, until))


def _round_obstruction(context: ReplanContext, free: float) -> Decision:
    """Round what the path comes too close to, ``free`` metres along it at the soonest."""
    if _may_wait(context, free) or is_paused(context, free):
        return Decision(context.schedule)
    world = context.knowledge.world
    indices = _obstructing(context, world)
    names = tuple(world.name(index) for index in indices)
    blocked = replace(
        context,
        schedule=replace(context.schedule, reduced=None),
        obstruction=Obstruction(world, names, free),
        floor=context.requirements.required,
    )
    as_seen = with_time_to_search(as_first_seen(blocked))
    try:
        result = _way_round(as_seen)
    except SpentBudgetError as error:
        result = ReplanResult(None, error, begin_with=FIRST_STAGE)
    if result.candidate is not None and not holds_now(blocked, result.candidate):
        result, as_seen = OUTDATED, begun_anew(as_seen, blocked)
    if result.begin_with is not None:
        kept = keep_searching(as_seen, result)
        decision = stop_for_good(blocked, SPENT_AT_REST) if kept is None else kept
        return replace(decision, searched=True, work=as_seen.work)
    if result.candidate is None:
        decision = _hold(blocked, _plain(result.refusal))
        return replace(decision, searched=True, work=as_seen.work)
    decision = take_over(blocked, result.candidate, result.skip)
    detected = tuple(context.detection(world, index) for index in indices)
    return replace(
        decision,
        schedule=replace(decision.schedule, wait=None),
        events=detected + decision.events,
        searched=True,
        work=as_seen.work,
    )


def _may_wait(context: ReplanContext, free: float) -> bool:
    """Whether a blocked path is not to be laid anew yet: it was just now, or it was in vain."""
    progress, schedule = context.progress, context.schedule
    if schedule.pending is not None:
        return False
    if schedule.wait is not None and schedule.wait.reason is not None:
        return progress.time < schedule.wait.again
    if progress.time >= schedule.laid_at + MIN_REPLAN_INTERVAL_S:
        return False
    near = MIN_REPLAN_INTERVAL_S * context.speed + 2.0 * context.requirements.required
    return free > progress.distance + near


def _obstructing(context: ReplanContext, world: World) -> list[int]:
    """Indices of what the path ahead comes too close to, one for each cluster of discs."""
    close: list[int] = []
    for _, _, part, floor in context.parts_ahead():
        close += too_close(world, part.spans, floor).tolist()
    found, last = [], (math.inf, math.inf)
    for index in dict.fromkeys(index for index in close if index >= 0):
        circle = world.obstacles[index].circle
        if circle is not None:
            if math.dist(circle.center, last) < 2.0 * context.requirements.required:
                continue
            last = circle.center
        found.append(index)
    return found


def _way_round(context: ReplanContext) -> ReplanResult:
    """A way on that keeps something to spare; if there is none, one that keeps what it must.

    A robot that has come too close already gets out of there first. One that stands in a pocket
    goes back as it came: where it knows no way on, and now and then while it looks for one.
    """
    requirements, belief = context.task.requirements, context.knowledge.belief
    assert belief is not None
    looked_long = _looked_long(context)
    if looked_long:
        try:
            back = _way_back(context, looked_long - 1)
        except SpentBudgetError:
            back = ReplanResult(None)
        if back.candidate is not None:
            return back
    room = room_to_stop(context, belief.cell_size)
    if room >= requirements.required:
        found = _way_on(context, with_spare(requirements))
    else:
        found = _way_out(context, room, with_spare(requirements))
    is_over = found.candidate is not None or found.begin_with is not None
    if is_over or context.speed > 0.0:
        return found
    wait = context.schedule.wait
    attempt = 0 if wait is None else round((context.progress.time - wait.since) / RETRY_INTERVAL_S)
    back = _way_back(context, attempt)
    return back if back.candidate is not None or back.refusal else found


def _way_back(context: ReplanContext, attempt: int) -> ReplanResult:
    """Back as it came for a robot that stands, if it can, with something to spare from there on."""
    requirements, belief = context.task.requirements, context.knowledge.belief
    assert belief is not None
    errors = belief.surfaces.tolerance + requirements.tracking_error
    least = requirements.radius - belief.cell_size - errors
    back = retreat(context, requirements, least, attempt)
    if back.candidate is None:
        return back
    roomier = retreat(context, with_spare(requirements), least, attempt)
    return back if roomier.candidate is None else roomier


def _looked_long(context: ReplanContext) -> int:
    """How often a robot that stands has looked long by now; 0 if it had in an earlier step."""
    pending = context.schedule.pending
    if pending is None or context.speed > 0.0:
        return 0
    spent, step = pending.so_far.spent, pending.so_far.limit
    return int(spent / LONG_WORK_S) if spent % LONG_WORK_S < step else 0


def _way_on(context: ReplanContext, spared: Requirements) -> ReplanResult:
    """A way on for a robot that has room, if there is one with something to spare.

    One that waits because there was none asks for that first which is most likely.
    """
    needed = search(context) if context.schedule.is_blocked else None
    if needed is not None and needed.candidate is None:
        return needed
    found = search(replace(context, requirements=spared))
    if found.candidate is not None:
        return found
    if needed is not None:
        return needed
    return found if found.begin_with is not None else search(context)


def _way_out(context: ReplanContext, room: float, spared: Requirements) -> ReplanResult:
    """A way on for a robot that has come too close, by which it comes no closer.

    Args:
        context: The robot.
        room: Its distance to what is nearest, up to where it can stop [m].
        spared: What the path keeps as soon as there is room.
    """
    requirements, belief = context.task.requirements, context.knowledge.belief
    assert belief is not None
    cell_size = belief.cell_size
    # discs reach beyond what was hit: for its noise, which stays, and by as much as nothing counts
    spare = MAX_INTO_DISC_RATIO * (cell_size - belief.surfaces.noise)
    floor = max(room - MAX_APPROACH_M, requirements.radius - spare)
    if requirements.required - room > cell_size:
        out = way_out(context, spared, floor) or way_out(context, requirements, floor)
        if out is not None:
            return ReplanResult(out)
    return way_on_from_close(context, floor, cell_size, (spared, requirements))


def _plain(refusal: PlanningError | str) -> str:
    """Why there is no way on, as far as a robot can tell that sees a part of the world."""
    if isinstance(refusal, BlockedLegError | UnfinishedLegError):
        return f"sees no way to '{refusal.via}'"
    return str(refusal)


def _hold(context: ReplanContext, reason: str) -> Decision:
    """Go no farther than where there is room to turn away; give up after a long stand."""
    time, wait = context.progress.time, context.schedule.wait
    since = time if wait is None or context.speed > 0.0 else wait.since
    if time - since >= MAX_STAND_S:
        return stop_for_good(context, reason)
    events = (braked(context, reason),) if context.speed > 0.0 and wait is None else ()
    waiting, held_at = Wait(since, time + RETRY_INTERVAL_S, reason), last_place(context)
    schedule = replace(context.schedule, wait=waiting, pending=None, held_at=held_at)
    return Decision(schedule, events)
