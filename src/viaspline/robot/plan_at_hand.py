"""Whether a plan that was handed in is one of the mission that it is to be driven for."""

from __future__ import annotations

from viaspline.errors import GeometryError
from viaspline.handed_in import check_kind
from viaspline.mission.model import Mission
from viaspline.mission.route_spec import Route
from viaspline.planner import Plan


def check_plan_of(mission: Mission, plan: object) -> None:
    """Refuse a plan of another robot, or of a route through other places.

    The worlds may differ: what is planned without something may be driven with it.

    Args:
        mission: What is to be driven.
        plan: What was handed in.

    Raises:
        GeometryError: It is no plan, or one of another mission.
    """
    check_kind("plan", plan, Plan, "give plan(mission)")
    assert isinstance(plan, Plan)
    if plan.mission.robot != mission.robot:
        other = "robot"
    elif _places(plan.mission.route) != _places(mission.route):
        other = "route"
    else:
        return
    raise GeometryError(f"plan is one for another {other} than the mission's; give plan(mission)")


def _places(route: Route) -> tuple[object, ...]:
    """Where a route leads; an order that the plan chose doesn't count."""
    goal = route.goal.at if route.goal is not None else None
    return route.start.at, sorted(via.at for via in route.via), goal, route.closed, route.laps
