"""Other paths for robots of a fleet under way: from where each of them stands.

A robot that gets another path stands still, so the two meet where it does: nothing but its place,
and its heading where it can't turn on the spot, has to be the same.

Tested through ``fleet/execution/test_replanned_fleets``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.driven_plan import driven_plan
from viaspline.errors import GeometryError, NoPathError
from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.laying.lay_among_rests import lay_among_rests
from viaspline.fleet.laying.resting_places import RestingPlace, RestingPlaces, rests_of
from viaspline.handed_in import check_kind
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.mission.model import Mission
from viaspline.mission.route_spec import EndPoint, Route, ViaPoint
from viaspline.planner import Plan
from viaspline.whole_plan import in_order

SAME_M = 1e-3
"""Via points so little ahead are behind."""
HAIR_M = 0.03
"""What a start needs beyond what has to be kept from a robot that stands for ever [m]."""
SPACING_M = 0.2
"""Between two places at which a robot may be that isn't known to be at one."""


@dataclass(frozen=True, eq=False)
class FleetMissions:
    """What the robots of a fleet under way are to do, and the paths on which they do it.

    Attributes:
        members: By name; a robot that was sent elsewhere has its new mission.
        plans: Of the robots that have a path, by name: with the laws that they would drive alone.
    """

    members: Mapping[str, FleetMember]
    plans: Mapping[str, AnyPlan]

    @classmethod
    def of(cls, plan: FleetPlan) -> FleetMissions:
        """What the robots of a plan are to do."""
        return cls({one.name: one for one in plan.fleet.members}, plan.plans)

    def with_way(self, member: FleetMember, plan: AnyPlan) -> FleetMissions:
        """With a robot more, or another mission and path of one."""
        name = member.name
        return replace(
            self, members={**self.members, name: member}, plans={**self.plans, name: plan}
        )


def check_member(member: FleetMember, *, flies: bool) -> None:
    """Refuse what is no robot with a mission that ends, in the plane or in space as the others.

    Args:
        member: The robot.
        flies: Whether the others are in space.

    Raises:
        GeometryError: It is something else, or never ends.
    """
    check_kind("member", member, FleetMember, "give FleetMember(name, mission)")
    check_kind("member.name", member.name, str, "give the robot a name")
    check_kind("member.mission", member.mission, Mission, "give Mission.model_validate({...})")
    if member.mission.route.is_patrol:
        raise GeometryError(
            f"'{member.name}' is a patrol that never ends; plan the whole fleet anew, or give it a "
            "number of laps"
        )
    if member.mission.is_spatial is not flies:
        raise GeometryError(
            f"'{member.name}' is in the {'plane' if flies else 'air'}, and the fleet isn't; "
            f"{'give its points heights' if flies else 'leave out its heights'}"
        )


def rest_of_route(mission: Mission, path: Path, place: float) -> Route:
    """What is left of a route, from a place of its path on.

    Args:
        mission: Whose route it is.
        path: That it drives.
        place: Where it stands along that [m].

    Raises:
        GeometryError: The route is a strip that the robot stays inside of.
    """
    route = mission.route
    if route.corridor is not None:
        raise GeometryError("its route has a corridor; give it a route of its own from there")
    points = [point for _, point in route.points()]
    along = path.via_distances.tolist()
    left = [
        _passed_through(points[via.index % len(points)])
        for via, at in zip(path.vias, along, strict=True)
        if via.kind == "user" and via.index is not None and place + SAME_M < at < path.length
    ]
    goal = route.start if route.closed else points[-1]
    end = EndPoint(at=goal.at, name=goal.name, heading_deg=getattr(goal, "heading_deg", None))
    return Route(
        start=_end_at(mission, path, place), via=tuple(left), goal=end, optimise=route.optimise,
        detours=route.detours,
    )  # fmt: skip


def _passed_through(point: ViaPoint | EndPoint) -> ViaPoint:
    """A point of a route as one on the way: the start of a round is passed between its laps."""
    return point if isinstance(point, ViaPoint) else ViaPoint(at=point.at, name=point.name)


def from_where_it_stands(mission: Mission, route: Route, path: Path, place: float) -> Mission:
    """A mission with another route, which begins at a place of a path [m].

    Args:
        mission: Of the robot until now.
        route: Its other one; the start in it is left out.
        path: Its path until now.
        place: Where it stands along that [m].
    """
    start = _end_at(mission, path, place)
    if route.closed:
        raise GeometryError("the route is closed; give one with a goal, for it begins elsewhere")
    return mission.model_copy(update={"route": route.model_copy(update={"start": start})})


def _end_at(mission: Mission, path: Path, place: float) -> EndPoint:
    """The start of a route where a robot stands on a path."""
    at: list[float] = np.asarray(path.at_distance(place)).tolist()
    drive = mission.robot.drive
    if drive is None or drive.kind.turn_radius is None:
        return EndPoint(at=at)
    step = min(1e-3, path.length)
    ends = np.array([min(place, path.length - step), min(place + step, path.length)])
    (x0, y0), (x1, y1) = np.asarray(path.at_distance(ends))[:, :2].tolist()
    return EndPoint(at=at, heading_deg=math.degrees(math.atan2(y1 - y0, x1 - x0)))


def rests_now(
    fleet: DrivenFleet, state: FleetProgressState, missions: FleetMissions, name: str
) -> RestingPlaces:
    """Where the other robots of a fleet rest: those that stand now, and those that will.

    Args:
        fleet: What is driven.
        state: How far it has come.
        missions: Of the robots.
        name: The robot that is laid among them, which isn't one of them.
    """
    found: list[RestingPlace] = []
    stuck, reaches = state.stuck().tolist(), fleet.courses.packed.reach.tolist()
    left = (state.places > SAME_M).tolist()
    is_gone, out = (state.packed.progress == np.inf).tolist(), state.out.tolist()
    for robot, other in enumerate(fleet.names):
        if other == name or is_gone[robot]:
            continue
        if out[robot]:
            found += _anywhere(fleet, state, robot, reaches[robot])
            continue
        for one in rests_of(missions.members[other], reaches[robot]):
            if not (left[robot] and one.kind == "start"):
                found.append(one)
        if stuck[robot] >= 0:
            x, y = _place_at(fleet, robot, float(state.places[robot]))
            found.append(RestingPlace(other, "start", (x, y), reaches[robot]))
    return RestingPlaces(tuple(found))


def _anywhere(
    fleet: DrivenFleet, state: FleetProgressState, robot: int, reach: float
) -> Iterator[RestingPlace]:
    """Where a robot stands that doesn't drive any more: all places at which it may be."""
    places, grown = places_of_one_out(state, robot)
    for place in places:
        x, y = _place_at(fleet, robot, place)
        yield RestingPlace(fleet.names[robot], "goal", (x, y), reach + grown)


def places_of_one_out(state: FleetProgressState, robot: int) -> tuple[list[float], float]:
    """Where along its path a robot may be that doesn't go on any more.

    Returns:
        Distances along the path, and how far it may be from the nearest of them [m].
    """
    since, until = float(state.packed.progress[robot]), float(state.packed.promised[robot])
    since = max(min(since, float(state.places[robot])), 0.0)
    count = math.ceil((until - since) / SPACING_M) if until > since else 0
    places: list[float] = np.linspace(since, max(until, since), count + 1).tolist()
    return places, 0.5 * SPACING_M if count else 0.0


def _place_at(fleet: DrivenFleet, robot: int, place: float) -> tuple[float, float]:
    """Where a distance along a robot's course is [m]."""
    x, y = fleet.place_at(robot, place).tolist()
    return x, y


def laid_from_rest(
    member: FleetMember, separation: float, rests: RestingPlaces, out: Sequence[str]
) -> Plan:
    """The path of a robot round all that rest, and the law that it would drive alone.

    Args:
        member: With a mission that begins where it stands.
        separation: Free space between any two bodies [m].
        rests: Where others rest.
        out: Those that never get on any more: there is no way past them.

    Raises:
        NoPathError: There is no way, or none round one that never gets on any more.
        GaveUpError: None was found.
        GeometryError: The robot can't follow it.
    """
    mission, world = in_order(member.mission)
    alone = driven_plan(mission, world)
    reach = mission.robot.outer_radius + alone.tracking_error + 0.5 * separation
    among = _with_room_at(rests, mission.route.start.at[:2], reach, out)
    points = np.array([via.at[:2] for _, via in mission.route.points()])
    _check_not_past(member.name, (among.places[k] for k in sorted(among.at(points, reach))), out)
    laid = lay_among_rests(alone, mission, member.name, reach, among)
    _check_not_past(member.name, laid.passed, out)
    return laid.plan


def _check_not_past(name: str, passed: Iterable[RestingPlace], out: Sequence[str]) -> None:
    """Refuse a path that passes places where a robot may be that never gets on any more."""
    for rest in passed:
        if rest.robot in out:
            raise NoPathError(
                f"there is no way for '{name}' round '{rest.robot}', which doesn't drive any more",
                where=np.array(rest.at),
                remedy=f"take '{rest.robot}' away",
                obstacles=(rest.robot,),
            )


def _with_room_at(
    rests: RestingPlaces, start: Sequence[float], reach: float, out: Sequence[str]
) -> RestingPlaces:
    """Resting places of which those that never end leave a start the hair that paths keep more.

    How near the path really comes to such a robot is seen where it is timed.
    """
    if not out:
        return rests
    x, y = start
    found = []
    for one in rests.places:
        room = math.dist((x, y), one.at) - reach - HAIR_M
        is_near = one.robot in out and room < one.reach < room + 2.0 * HAIR_M
        found.append(replace(one, reach=room) if is_near else one)
    return RestingPlaces(tuple(found))
