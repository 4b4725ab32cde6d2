"""The search for a new path under way: past lost points, on the sides that the robot meant.

Tested through ``robot/test_navigator`` and ``robot/replanning/test_decide``.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from viaspline.errors import PlanningError
from viaspline.robot.navigation.pending_search import NO_STAGE, UNDER_WAY, SideInDoubt, Stage
from viaspline.robot.navigation.progress import SAME_PLACE_M
from viaspline.robot.replanning.first_way_on import UnfinishedSearchError, first_candidate
from viaspline.robot.replanning.passing_sides import changed_side, is_better
from viaspline.robot.replanning.path_candidate import PathCandidate
from viaspline.robot.replanning.replan_context import ReplanContext


@dataclass(frozen=True)
class ReplanResult:
    """What a search for a new path came to.

    Attributes:
        candidate: The path; None if there is none.
        refusal: Why there is none.
        skip: Indices of points of the route that are given up for it, each with the reason.
        begin_with: The stage with which the search goes on; None if it is over.
        doubt: What it was found to pass on another side, if that is not decided yet.
    """

    candidate: PathCandidate | None
    refusal: PlanningError | str = ""
    skip: Mapping[int, str] = field(default_factory=dict)
    begin_with: Stage | None = None
    doubt: SideInDoubt | None = None


def search(context: ReplanContext) -> ReplanResult:
    """A path on, past points of the route that can't be reached any more, or why there is none."""
    if not context.is_clear(context.stop):
        looks_on = context.speed > 0.0 and context.stands_clear  # from where it stands then
        return ReplanResult(None, _too_late(context), begin_with=NO_STAGE if looks_on else None)
    skip, reason = _covered(context)
    if reason is not None:
        return ReplanResult(None, reason)
    while True:
        try:
            return ReplanResult(_on_kept_sides(context, frozenset(skip)), skip=skip)
        except UnfinishedSearchError as error:
            return ReplanResult(None, error, begin_with=error.begin_with, doubt=error.doubt)
        except PlanningError as error:
            lost = _lost(context, skip, error)
            if lost is None:
                return ReplanResult(None, error)
            skip[lost] = error.reason


def _on_kept_sides(context: ReplanContext, skip: Collection[int]) -> PathCandidate:
    """The first candidate, unless it passes something on another side than the path so far.

    Nothing that the robot knew is passed on another side than it meant to, unless that is clearly
    better. Where a step has no time left to find that out, the next one begins with it: by then the
    robot is elsewhere, and the candidate would have to be found anew.

    Raises:
        UnfinishedSearchError: When it has spent what it may.
        PlanningError: If there is no way to the goal, or none was found.
    """
    world, pending = context.knowledge.world, context.schedule.pending
    candidate, doubt = None, None if pending is None else pending.doubt
    if doubt is None:
        candidate = first_candidate(context, world, skip)
        doubt = _doubt_about(context, candidate)
        if doubt is None:
            return candidate
        context = context.searching_from_the_first()
    if doubt.is_open:
        kept = _on_side(context, doubt, skip)
        if kept is not None and _is_worth(context, doubt, kept):
            return kept
        if candidate is not None:
            return candidate
        context = context.searching_from_the_first()
    try:
        return first_candidate(context, world, skip)
    except UnfinishedSearchError as error:
        decided = replace(doubt, is_open=False)
        raise UnfinishedSearchError(error, error.begin_with, decided) from error


def _doubt_about(context: ReplanContext, candidate: PathCandidate) -> SideInDoubt | None:
    """What a candidate passes on another side than the robot meant to, if it does."""
    schedule, solution = context.schedule, candidate.solution
    changed = changed_side(
        schedule.path, solution.path, solution.changed_from, context.progress.last_via,
        schedule.laid_in, context.requirements.required, solution.rejoins_at,
    )  # fmt: skip
    if changed is None:
        return None
    (x, y), side = changed[0].tolist(), changed[1]
    modes = UNDER_WAY if candidate.mode == "reflex" else ("planned",)
    return SideInDoubt((x, y), side, modes, solution.path.length)


def _is_worth(context: ReplanContext, doubt: SideInDoubt, kept: PathCandidate) -> bool:
    """Whether a candidate that keeps to its side isn't clearly worse than the other one."""
    here = context.progress.distance
    return not is_better(doubt.other - here, kept.solution.path.length - here)


def _on_side(
    context: ReplanContext, doubt: SideInDoubt, skip: Collection[int]
) -> PathCandidate | None:
    """The first candidate on the side that the robot meant; None if there is none.

    Raises:
        UnfinishedSearchError: When it has spent what it may under way. A robot that stands spends
            the rest of its step on that at most.
    """
    world = context.knowledge.world
    now = int(world.nearest(doubt.place)[1])
    if now < 0 or world.obstacles[now].forced_side is not None:
        return None
    try:
        sided = context.requirements.once(
            ("side", world, now, doubt.side), partial(world.with_side, now, doubt.side)
        )
        return first_candidate(
            context, sided, skip, doubt.modes, partial(_is_worth, context, doubt)
        )
    except UnfinishedSearchError as error:
        if context.speed == 0.0 or error.begin_with == NO_STAGE:
            return None
        raise UnfinishedSearchError(error, error.begin_with, doubt) from error
    except PlanningError:
        return None


def _too_late(context: ReplanContext) -> str:
    """Why a robot that comes too close before it stands can't go on."""
    world, required = context.obstruction.world, context.task.requirements
    distance, nearest = world.nearest(context.schedule.path.at_distance(context.stop))
    name, gap = world.name(int(nearest)), f"{float(distance) - required.radius:.2f} m"
    inside = f"inside the clearance of {required.kept:g} m that it has to keep"
    if context.speed == 0.0:
        return f"the robot stands {gap} from '{name}', {inside}"
    return (
        f"'{name}' appeared inside the braking distance; the robot comes to stand {gap} from it, "
        f"{inside}"
    )


def _covered(context: ReplanContext) -> tuple[dict[int, str], str | None]:
    """The points still to come that what is in the way covers; a reason if the goal is one."""
    world, required = context.obstruction.world, context.task.requirements
    ahead = [(via, at) for via, at in context.vias_ahead if at > context.stop + SAME_PLACE_M]
    if not ahead:
        return {}, None
    distances, nearest = world.nearest(np.array([via.at[:2] for via, _ in ahead]))
    covered: dict[int, str] = {}
    for k in np.flatnonzero(distances < context.floor).tolist():
        via, name = ahead[k][0], world.name(int(nearest[k]))
        free = float(distances[k]) - required.radius
        why = f"'{name}' leaves {free:.2f} m there, {required.kept:g} m are needed"
        if free < 0.0:
            why = f"'{name}' covers it"
        if context.is_goal(via):
            return {}, f"the goal '{via.name}' can't be reached any more: {why}"
        assert via.index is not None
        covered[via.index] = why
    return covered, None


def _lost(context: ReplanContext, skip: Mapping[int, str], error: PlanningError) -> int | None:
    """Index of the point that an error says can't be reached, if the robot may go on without."""
    for via, at in context.vias_ahead:
        if via.name != error.via or at <= context.stop + SAME_PLACE_M:
            continue
        if not context.is_goal(via):
            return via.index if via.index not in skip else None
    return None
