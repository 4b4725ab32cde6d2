"""The tension of a flight that leaves it to the planner: of some, by whole plans."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final

from viaspline.errors import PlanningError
from viaspline.mission.model import Mission
from viaspline.mission.stated_tension import REFERENCES, best_stated, with_tension
from viaspline.space.spatial_plan import SpatialPlan

TRIED_TENSIONS: Final = (None, 0.0, -0.5, -0.25, 0.25, 0.5, 0.75)
"""With none stated legs are lines and turns where those are sooner. All led legs are, whatever the
tension: few are enough for the others."""


def by_soonest_tension(mission: Mission, planned: Callable[[Mission], SpatialPlan]) -> SpatialPlan:
    """The plan with the tension by which all of it is soonest, or shortest if that is asked for.

    It is no later than with none stated or one by hand, and the gentlest of those that are nearly
    as soon.

    Args:
        mission: In space; its tension is ``auto``.
        planned: Plans it with a tension.

    Raises:
        PlanningError: As it does with none stated, if it does so with all.
    """
    plans: list[SpatialPlan] = []
    refused: PlanningError | None = None
    for tension in TRIED_TENSIONS:
        try:
            plans.append(planned(with_tension(mission, tension)))
        except PlanningError as error:
            refused = refused or error
    if not plans:
        assert refused is not None
        raise refused
    costs = [(_cost(plan), plan.path.max_curvature()[0]) for plan in plans]
    by_hand = [
        cost
        for plan, (cost, _) in zip(plans, costs, strict=True)
        if plan.mission.spline.tension in REFERENCES
    ]
    return plans[best_stated(costs, min(by_hand, default=math.inf))]


def _cost(plan: SpatialPlan) -> float:
    """How long it takes [s], or is [m] where that is what counts."""
    if plan.mission.route.optimise == "length":
        return plan.path.length
    return plan.trajectory.end_time - plan.trajectory.start_time
