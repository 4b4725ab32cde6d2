"""The first way on for a robot under way: from the least change of its path to the greatest.

Tested through ``robot/test_navigator`` and ``robot/replanning/test_decide``.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from viaspline.errors import GaveUpError, PlanningError
from viaspline.machine.allowance import TRACKING_REMEDY
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.replanning import replan
from viaspline.planning.routing.leg_errors import BlockedLegError
from viaspline.robot.navigation.pending_search import (
    FIRST_STAGE,
    LAST_STAGE,
    NEARBY,
    NO_STAGE,
    ORDER,
    UNDER_WAY,
    SideInDoubt,
    Stage,
)
from viaspline.robot.navigation.progress import SAME_PLACE_M
from viaspline.robot.replanning.hold_to_path import CREEP_MPS
from viaspline.robot.replanning.path_candidate import PathCandidate, awaited, timed
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.run import Mode
from viaspline.world.world import World

TURN_BACK_SAMPLES = 129
"""Places along a path at which it is seen whether it leads back."""

NEARBY_WORK_S = 3.2
"""What a robot that stands spends before it lays all of its path anew [s of the reference machine],
if a search nearby comes on."""

WIDER = (1.15, 1.05)
"""So many times as wide are the turns of a path that leaves steering to correct with, in order."""

MAX_SHARE_BEFORE = 0.2
"""A part of a search that was stopped had a step for itself if no more was spent before."""


class UnfinishedSearchError(SpentBudgetError):
    """A search for a new path has spent what it may in one step.

    Attributes:
        begin_with: The stage with which it goes on.
        doubt: What it was found to pass on another side, if that is not decided yet.
    """

    def __init__(
        self, spent: SpentBudgetError, begin_with: Stage, doubt: SideInDoubt | None = None
    ) -> None:
        super().__init__(spent.reason, where=spent.where, remedy=spent.remedy, tried=spent.tried)
        self.begin_with, self.doubt = begin_with, doubt


def first_candidate(
    context: ReplanContext,
    world: World,
    skip: Collection[int] = (),
    modes: tuple[Mode, ...] = UNDER_WAY,
    worth: Callable[[PathCandidate], bool] = lambda _: True,
) -> PathCandidate:
    """The first way on that the robot can take: in these modes under way, then from rest.

    A robot under way doesn't turn back on the spot: a path that leads behind it is left for a
    robot that has come to rest.

    Args:
        context: The robot under way.
        world: What the path keeps clear of.
        skip: Points of the route that are left out; the spans to them can't stay as they are.
        modes: In this order.
        worth: Whether one is worth being taken; of those from rest the last is in any case.

    Raises:
        UnfinishedSearchError: When it has spent what it may.
        PlanningError: If there is no way to the goal, or none was found.
    """
    forced = bool(context.knowledge.world.sided.size)
    laid_anew = set()  # from there a reflex has laid all that a planned path would
    closed = set()  # parts of the order by which nothing leads on, wherever the path is left
    for stage, mode, leave in _stages(context, ("planned",) if skip else modes):
        if stage[0] in closed or (mode == "planned" and leave in laid_anew):
            continue
        if stage[0] == NEARBY and skip:
            continue  # what would stay leads to them
        before = context.work
        try:
            solution, candidate = _at_stage(context, world, skip, stage, mode, leave)
        except UnfinishedSearchError:
            raise
        except SpentBudgetError as error:
            raise UnfinishedSearchError(error, _next(stage, before, context)) from error
        except BlockedLegError:
            if stage == LAST_STAGE or (mode == "planned" and not forced):
                raise  # nor does anything lead on from rest: a clear path joins the places
            closed.add(stage[0])
            continue
        except PlanningError:
            if stage == LAST_STAGE:
                raise
            continue  # a robot that leaves later, or that stands, may find a way
        if stage == LAST_STAGE:
            if candidate is None:
                raise _not_followed(context)
            return candidate
        rests = mode == "from_rest"
        if (
            not rests
            and solution.rejoins_at is None
            and solution.changed_from <= leave + SAME_PLACE_M
        ):
            laid_anew.add(leave)
        leads_on = candidate is not None and (rests or not _turns_back(context, solution))
        if candidate is not None and leads_on and worth(candidate):
            return candidate
    raise AssertionError("the last stage of a search finds something or says why there is nothing")


def _at_stage(
    context: ReplanContext,
    world: World,
    skip: Collection[int],
    stage: Stage,
    mode: Mode,
    leave: float,
) -> tuple[Solution, PathCandidate | None]:
    """The path of one stage, and how it is driven; None where it can't be.

    Args:
        context: The robot under way.
        world: What the path keeps clear of.
        skip: Points of the route that are left out.
        stage: At the last one nothing is left but to drive it as well as may be.
        mode: How the path is left.
        leave: Where [m].
    """
    solution = context.requirements.once(
        ("laid", stage[0], leave, world, context.schedule.path, frozenset(skip)),
        partial(_laid, context, stage[0], leave, world, skip),
    )
    candidate = timed(context, mode, solution)
    if candidate is None and stage == LAST_STAGE:
        candidate = _with_steering_left(context, world, skip) or _awaited(context, solution)
    return solution, candidate


def _with_steering_left(
    context: ReplanContext, world: World, skip: Collection[int]
) -> PathCandidate | None:
    """A path from rest with wider turns, for a robot that can't follow the one that was found.

    Where a path is as sharp as its wheels can be turned, it has no steering left to correct with,
    however slow it is.

    Returns:
        None if it could follow that with what it has left, or if there is no such path.
    """
    requirements = context.requirements
    if context.task.model is None or requirements.turn_radius is None:
        return None
    for times in WIDER:
        radius = times * requirements.turn_radius
        wider = replace(context, requirements=replace(requirements, turn_radius=radius))
        lay = partial(_laid, wider, LAST_STAGE[0], context.stop, world, skip)
        asked = ("laid wider", context.stop, world, context.schedule.path, frozenset(skip))
        try:
            candidate = timed(context, "from_rest", wider.requirements.once(asked, lay))
        except SpentBudgetError:
            raise
        except PlanningError:
            continue  # it has no room for that
        if candidate is not None:
            return candidate
    return None


def _awaited(context: ReplanContext, solution: Solution) -> PathCandidate | None:
    """A path from rest that the robot goes over to and waits, if it stands.

    Raises:
        UnfinishedSearchError: If it is under way: it goes on and looks again, for what moves may
            leave it a law before it has to stop.
    """
    candidate = awaited(context, solution)
    if candidate is None or context.speed == 0.0:
        return candidate
    spent = SpentBudgetError(
        "no time law was found on the way round past what moves",
        where=context.here,
        remedy="it looks again before it has to stop",
        tried=("waiting, slowing down and passing before",),
    )
    raise UnfinishedSearchError(spent, NO_STAGE)


def _stages(context: ReplanContext, modes: tuple[Mode, ...]) -> Iterator[tuple[Stage, Mode, float]]:
    """What is tried one after the other, from the stage with which a search goes on.

    Yields:
        The stage, the mode, and where the path so far is left [m].
    """
    pending = context.schedule.pending
    first = FIRST_STAGE if pending is None else pending.begin_with
    leaves = context.clear_leaves()
    for mode in modes:
        for k, leave in enumerate(leaves):
            stage = (ORDER.index(mode), k)
            if stage >= first:
                yield stage, mode, leave
    for k in (NEARBY, LAST_STAGE[0]):
        if (k, 0) >= first and not (k == NEARBY and context.schedule.is_round):
            yield (k, 0), "from_rest", context.stop


def _laid(
    context: ReplanContext, order: int, leave: float, world: World, skip: Collection[int]
) -> Solution:
    """The path of one stage, by its part of the order."""
    path, requirements = context.schedule.path, context.requirements
    until = context.schedule.looked_at
    if ORDER[order] == "reflex":
        return replan.reflex(path, leave, world, requirements, until)
    if order == NEARBY:
        return replan.from_rest_nearby(path, leave, world, requirements, until)
    lay = replan.planned if ORDER[order] == "planned" else replan.from_rest
    return lay(path, leave, world, requirements, skip, until)


def _next(stage: Stage, before: float, context: ReplanContext) -> Stage:
    """With which stage a search goes on that was stopped at one.

    One that had a step for itself isn't tried again, unless it comes on from a settled place, or it
    is the last and the robot stands.

    Args:
        stage: At which it was stopped.
        before: What had been spent before that [s of the reference machine].
        context: The robot that has searched.
    """
    budget = context.requirements.budget
    assert budget is not None  # it has been spent
    had_most = before <= MAX_SHARE_BEFORE * budget.limit and budget.limit > 0.0
    if not had_most or (stage[0] == NEARBY and _comes_on_nearby(context)):
        return stage
    if stage[0] < NEARBY and context.settled_leave is not None and budget.has_gained:
        return stage
    if stage < LAST_STAGE:
        return (stage[0], stage[1] + 1)
    return NO_STAGE if context.speed > 0.0 else stage


def _comes_on_nearby(context: ReplanContext) -> bool:
    """Whether a robot that stands has found out more, and may spend more on its first search."""
    budget, pending = context.requirements.budget, context.schedule.pending
    if context.speed > 0.0 or budget is None or not budget.has_gained:
        return False
    return budget.spent + (0.0 if pending is None else pending.so_far.spent) < NEARBY_WORK_S


def _not_followed(context: ReplanContext) -> GaveUpError:
    """Why a robot that stands doesn't go on, though a path would lead on."""
    if context.task.model is None:
        return GaveUpError(
            "no time law was found on the way on by which the robot can stop within what it knows",
            where=context.here,
            remedy="give it a lower max_speed_mps, or more max_brake_mps2",
            tried=("from rest, on a path round all that stands",),
        )
    kept = context.task.requirements.tracking_error
    return GaveUpError(
        f"the robot would get farther beside its path than the {kept:.3f} m that are kept for that",
        where=context.here,
        remedy=f"give it {TRACKING_REMEDY}, or more room by tracking_error_m",
        tried=(f"as slowly as {CREEP_MPS:g} m/s where it has to be",),
    )


def _turns_back(context: ReplanContext, solution: Solution) -> bool:
    """Whether a path leads farther behind the place where it begins than the old one does."""
    at, old, new = solution.changed_from, context.schedule.path, solution.path
    place, ahead = np.asarray(old.at_distance(at)), old.tangent(float(old.parameter(at)))
    samples = (np.linspace(at, line.length, TURN_BACK_SAMPLES) for line in (old, new))
    depths = [
        float(((line.at_distance(along) - place) @ ahead).min())
        for line, along in zip((old, new), samples, strict=True)
    ]
    return depths[1] < depths[0] - context.requirements.required
