"""Other paths for flights of a fleet under way: from where each of them hovers or stands.

Tested through ``fleet/execution/test_changed_flights``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.execution.ways_from_rest import SAME_M, FleetMissions, places_of_one_out
from viaspline.fleet.space.hover_places import HoverPlace, hovers_of
from viaspline.fleet.space.lay_in_space import lay_among_hovers
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.mission.model import Mission
from viaspline.mission.route_spec import EndPoint, Route, ViaPoint
from viaspline.mission.shapes.solids import Place
from viaspline.mission.space.altitude_spec import AltitudeSpec
from viaspline.mission.space.flight_places import FlightPlaces, flight_places, ground_height
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.mission.space.takeoff_spec import Takeoff
from viaspline.space.plan_spatial import plan_spatial
from viaspline.space.spatial_plan import SpatialPlan


def rest_of_flight(plan: SpatialPlan, place: float) -> Route:
    """What is left of a flight's route, from a place of its path on.

    Args:
        plan: Whose path it flies.
        place: Where it hovers along that [m].

    Raises:
        GeometryError: It comes down to land already.
    """
    mission, path, route = plan.mission, plan.path, plan.mission.route
    if route.land is not None and place > plan.airborne[1] - SAME_M:
        raise GeometryError("it comes down to land, or has landed; let it go on")
    first = _start_of_laps(flight_places(mission))
    points: list[ViaPoint] = [ViaPoint(at=first, name=route.start.name), *route.via]
    left = tuple(
        points[via.index % len(points)]
        for via, along in zip(path.vias, path.via_distances.tolist(), strict=True)
        if via.kind == "user"
        and via.index is not None
        and (route.closed or via.index < len(points))
        and place + SAME_M < along < path.length - SAME_M
    )
    return route.model_copy(
        update={
            "via": left,
            "goal": EndPoint(at=first, name=route.start.name) if route.closed else _goal(route),
            "closed": False,
            "laps": 1,
            "order": "given",
        }
    )


def _goal(route: Route) -> EndPoint | None:
    """Where a route that isn't closed ends in the air; None: it lands."""
    if route.goal is not None or route.land is not None:
        return route.goal
    last = route.via[-1] if route.via else route.start
    return EndPoint.model_validate(last.model_dump(exclude_unset=True))


def from_where_it_hovers(plan: SpatialPlan, route: Route, place: float) -> Mission:
    """A flight's mission with another route, which begins at a place of its path.

    On the ground, and on its way up or down, it takes off: as the route says, or as high as it was
    to come before. In the air a take-off is left out. Heights above home stay above its old home.

    Args:
        plan: Whose path it has flown until now.
        route: Its other one; the start in it is left out.
        place: Where it is along the path [m].

    Raises:
        GeometryError: The route is closed.
    """
    if route.closed:
        raise GeometryError("the route is closed; give one with a goal, for it begins elsewhere")
    mission, path, (begins, ends) = plan.mission, plan.path, plan.airborne
    x, y, z = np.asarray(path.at_distance(place)).tolist()
    home = flight_places(mission).home
    start, takeoff = EndPoint(at=(x, y, z)), None
    if place < begins - SAME_M or place > ends + SAME_M:
        top = np.asarray(path.at_distance(begins if place < begins else ends)).tolist()
        low = ground_height(mission.world.ground, x, y)
        asked = 0.0 if route.takeoff is None else route.takeoff.to_agl_m
        takeoff = Takeoff(to_agl_m=asked if low + asked > z else top[2] - low)
    world = mission.world.model_copy(
        update={"altitude": _above_old_home(mission.world.altitude, home)}
    )
    route = route.model_copy(update={"start": start, "takeoff": takeoff})
    return mission.model_copy(update={"route": route, "world": world})


def _above_old_home(band: AltitudeSpec | None, home: float) -> AltitudeSpec | None:
    """Limits of the height that don't depend on where the route begins.

    >>> _above_old_home(AltitudeSpec(min_m=5, max_m=50), 100.0)
    AltitudeSpec(min_m=105.0, max_m=150.0, above='amsl')
    """
    if band is None or band.above != "home":
        return band
    low, high = (None if one is None else home + one for one in (band.min_m, band.max_m))
    return AltitudeSpec(min_m=low, max_m=high, above="amsl")


def _start_of_laps(places: FlightPlaces) -> Place:
    return places.start if places.takeoff is None else places.takeoff


def hovers_now(
    fleet: DrivenFleet, state: FleetProgressState, missions: FleetMissions, name: str
) -> list[HoverPlace]:
    """Where the other flights of a fleet are for long: those that hover now, and that will.

    Args:
        fleet: What is flown.
        state: How far it has come.
        missions: Of the robots.
        name: The robot that is laid among them, which isn't one of them.
    """
    found: list[HoverPlace] = []
    stuck = state.stuck()
    for robot, other in enumerate(fleet.names):
        if other == name or state.packed.progress[robot] == math.inf:
            continue
        member, plan = missions.members[other], missions.plans.get(other)
        assert plan is None or isinstance(plan, SpatialPlan), "these are flights"
        body = FlyingBody.of(member.mission.robot)
        if state.out[robot]:
            found += _anywhere(fleet, state, robot, body)
            continue
        has_left = state.places[robot] > SAME_M
        hovers = hovers_of(member, plan)
        found += [one for one in hovers if not (has_left and one.kind == "start")]
        if stuck[robot] >= 0:
            at = _place_at(fleet, robot, float(state.places[robot]))
            found.append(HoverPlace(other, "start", at, body))
    return found


def _anywhere(
    fleet: DrivenFleet, state: FleetProgressState, robot: int, body: FlyingBody
) -> Iterator[HoverPlace]:
    """Where a flight is that doesn't go on any more: all places at which it may be."""
    places, grown = places_of_one_out(state, robot)
    more = replace(body, margin=body.margin + grown)
    for place in places:
        yield HoverPlace(fleet.names[robot], "out", _place_at(fleet, robot, place), more)


def _place_at(fleet: DrivenFleet, robot: int, place: float) -> Place:
    """Where a distance along a robot's course is [m]."""
    x, y, z = fleet.place_at(robot, place).tolist()
    return x, y, z


def laid_from_hover(
    member: FleetMember, separation: float, others: Sequence[HoverPlace]
) -> SpatialPlan:
    """The path of a flight round all that hover, and the law that it would fly alone.

    Args:
        member: With a mission that begins where it is.
        separation: Free space between any two bodies [m].
        others: Where the others are for long.

    Raises:
        NoPathError: There is no way, or none round one that never goes on.
        GaveUpError: None was found.
        GeometryError: It asks for something that isn't flown.
    """
    return lay_among_hovers(plan_spatial(member.mission), others, separation)
