"""From a mission in space to a plan: round what stands, past what moves."""

from __future__ import annotations

from viaspline.mission.model import Mission
from viaspline.space.among.plan_past_moving import plan_past_moving
from viaspline.space.soonest_tension import by_soonest_tension
from viaspline.space.spatial_order import ordered_in_space
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.static_plan import static_plan, static_plan_by
from viaspline.space.weighed_ways import WaysPast


def plan_spatial(mission: Mission) -> SpatialPlan:
    """Plan a mission in space: the spline, round and over what stands in the way, timed.

    Args:
        mission: A mission that is spatial.

    Raises:
        NoPathError: When there is no path, with the reason.
        GaveUpError: When none was found.
        GeometryError: When it asks for something that isn't planned in space.
    """
    mission = ordered_in_space(mission)
    if mission.spline.tension == "auto":
        return by_soonest_tension(mission, _planned)
    return _planned(mission)


def _planned(mission: Mission) -> SpatialPlan:
    """The plan of a mission that leaves nothing open but its path and its law."""
    plan = static_plan(mission)
    return plan_past_moving(plan) if mission.world.moving else plan


def plan_by(mission: Mission, problem: SpatialProblem, ways: WaysPast) -> SpatialPlan:
    """Plan what a mission asks for by ways that somebody else finds.

    Args:
        mission: A mission that is spatial, with its via points in the order of their service.
        problem: What it asks for.
        ways: Finds the ways past what stands on its legs.

    Raises:
        NoPathError: When there is no path, with the reason.
        GaveUpError: When none was found.
    """
    plan = static_plan_by(mission, problem, ways)
    return plan_past_moving(plan) if mission.world.moving else plan
