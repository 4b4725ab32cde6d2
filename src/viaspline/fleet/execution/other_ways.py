"""Other paths for robots of a fleet under way, in the plane or in space as the fleet is.

Tested through ``fleet/execution/test_changed_flights``.
"""

from __future__ import annotations

from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.execution.no_ways import SoughtWay
from viaspline.fleet.execution.ways_from_rest import (
    FleetMissions,
    from_where_it_stands,
    laid_from_rest,
    rest_of_route,
    rests_now,
)
from viaspline.fleet.execution.ways_in_the_air import (
    from_where_it_hovers,
    hovers_now,
    laid_from_hover,
    rest_of_flight,
)
from viaspline.fleet.laying.resting_places import RestingPlace, RestingPlaces
from viaspline.fleet.space.hover_places import HoverPlace
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.mission.model import Mission
from viaspline.mission.route_spec import Route
from viaspline.space.spatial_plan import SpatialPlan


def left_of_route(plan: AnyPlan, place: float) -> Route:
    """What is left of a robot's route, from a place of its path on [m].

    Raises:
        GeometryError: No route is left that could be planned.
    """
    if isinstance(plan, SpatialPlan):
        return rest_of_flight(plan, place)
    return rest_of_route(plan.mission, plan.path, place)


def sent_from(member: FleetMember, plan: AnyPlan, route: Route, place: float) -> Mission:
    """A robot's mission with another route, from where it stands.

    Args:
        member: The robot.
        plan: Whose path it has until now.
        route: Its other one.
        place: Where it stands along the path [m].

    Raises:
        GeometryError: The route is closed.
    """
    if isinstance(plan, SpatialPlan):
        return from_where_it_hovers(plan, route, place)
    return from_where_it_stands(member.mission, route, plan.path, place)


def around_now(
    fleet: DrivenFleet, state: FleetProgressState, missions: FleetMissions, name: str
) -> tuple[RestingPlace, ...] | tuple[HoverPlace, ...]:
    """Where the others rest or hover, now or later.

    Args:
        fleet: What is driven.
        state: How far it has come.
        missions: Of the robots.
        name: The robot that is laid among them.
    """
    if fleet.flies:
        return tuple(hovers_now(fleet, state, missions, name))
    return rests_now(fleet, state, missions, name).places


def laid_now(fleet: DrivenFleet, member: FleetMember, sought: SoughtWay) -> AnyPlan:
    """The path of a robot round all that rest now or will, and the law that it would drive alone.

    Args:
        fleet: What is driven.
        member: The robot, with a mission that begins where it stands.
        sought: Round whom.

    Raises:
        PlanningError: There is no way, or none was found.
        GeometryError: The robot can't follow it.
    """
    if fleet.flies:
        hovers = [one for one in sought.around if isinstance(one, HoverPlace)]
        return laid_from_hover(member, fleet.separation, hovers)
    rests = tuple(one for one in sought.around if isinstance(one, RestingPlace))
    return laid_from_rest(member, fleet.separation, RestingPlaces(rests), sought.out)
