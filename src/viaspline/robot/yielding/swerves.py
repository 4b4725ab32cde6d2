"""Paths by which a robot may swerve for what moves: laid at once through places beside its own.

Tested through ``robot/yielding/test_give_way``.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from viaspline.errors import PlanningError
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.departure import rolling, standing
from viaspline.planning.swerve import may_swerve, swerve
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.replanning.path_candidate import PathCandidate, timed
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.run import Mode
from viaspline.robot.yielding.swerve_places import swerve_places

SWERVES = 5
"""So many places are tried."""

SWERVE_WORK_S = 0.03
"""What may be spent on all of them [s of the reference machine]."""


def swerves(context: ReplanContext) -> list[Solution]:
    """The paths by the best places that are clear of what stands.

    None where the mission allows no such path.

    Args:
        context: The robot under way, with what moves, by which the places are chosen.
    """
    path, world, stands = context.schedule.path, context.knowledge.world, context.speed == 0.0
    if not context.vias_ahead or not may_swerve(path, world, context.requirements):
        return []
    requirements = context.searching(SWERVE_WORK_S).requirements
    leave, at = (standing, context.stop) if stands else (rolling, context.leaves[0])
    found = []
    for place in swerve_places(context, SWERVES):
        try:
            found.append(swerve(path, at, place, world, requirements, leave))
        except PlanningError:
            continue
    return found


def driven(
    context: ReplanContext, solutions: Iterable[Solution], known: Knowledge
) -> list[PathCandidate]:
    """Swerves with their laws; those that have none are left out.

    Args:
        context: The robot under way.
        solutions: The paths.
        known: What the laws keep clear of.
    """
    as_known = replace(context, knowledge=known)
    mode: Mode = "from_rest" if context.speed == 0.0 else "planned"
    found = []
    for solution in solutions:
        try:
            candidate = timed(as_known, mode, solution)
        except PlanningError:
            continue
        if candidate is not None:
            found.append(candidate)
    return found
