"""The tension of a flight that leaves it to the planner: of some, by whole plans."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from viaspline.errors import PlanningError
from viaspline.mission.model import Mission
from viaspline.mission.stated_tension import with_tension
from viaspline.space.spatial_plan import SpatialPlan

TRIED_TENSIONS: Final = (0.0, -0.5, -0.25, 0.25, 0.5, 0.75)
"""All led legs are lines and turns, whatever the tension: few are enough for the others."""

SPARE_SHARE: Final = 1e-3
"""What costs so much more at most is as good: then the gentlest counts."""


def by_soonest_tension(mission: Mission, planned: Callable[[Mission], SpatialPlan]) -> SpatialPlan:
    """The plan with the tension by which all of it is soonest, or shortest if that is asked for.

    Args:
        mission: In space; its tension is ``auto``.
        planned: Plans it with a tension.

    Raises:
        PlanningError: As it does with a tension of 0, if it does so with all.
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
    least = min(_cost(plan) for plan in plans)
    near = [plan for plan in plans if _cost(plan) <= least * (1.0 + SPARE_SHARE)]
    return min(near, key=lambda plan: plan.path.max_curvature()[0])


def _cost(plan: SpatialPlan) -> float:
    """How long it takes [s], or is [m] where that is what counts."""
    if plan.mission.route.optimise == "length":
        return plan.path.length
    return plan.trajectory.end_time - plan.trajectory.start_time
