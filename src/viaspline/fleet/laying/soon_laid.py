"""Whether the path of a body is found soon, before it is laid for as long as it takes.

A disc is led round anything in milliseconds. A body with a turning circle or corners is sought a
way for among poses, which may take half a minute where there is none; what may be spent on trying
another path is counted in work, and that is told by a search that counts it.

Tested through ``fleet/test_rerouted_fleet``.
"""

from __future__ import annotations

import math
from dataclasses import replace

from viaspline.mission.model import Mission
from viaspline.planning.plan_drive import find_drive
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.world.world import World


def check_soon_laid(mission: Mission, world: World, error: float, work: WorkBudget) -> float:
    """Find a path for a body within what may be spent, and take off as much for laying it.

    Its own path isn't that one: with time to spare it is bent more gently.

    Args:
        mission: What is to be planned.
        world: What it keeps clear of.
        error: How far the robot gets beside its path [m].
        work: What may be spent.

    Returns:
        What it took, and may take another time [s of the reference machine]; infinite: nothing is
        sought for such a body.

    Raises:
        SpentBudgetError: When that didn't do.
        PlanningError: When there is none, or none was found.
    """
    requirements = Requirements.of(mission, error)
    if requirements.is_free_disc:
        return math.inf
    if mission.spline.tension == "auto":
        spline = requirements.spline.model_copy(update={"tension": None})
        requirements = replace(requirements, spline=spline)
    before = work.spent
    find_drive(mission, world, requirements.within(work))
    took = work.spent - before
    work.spent += took
    return took
