"""Plans of fleets with a robot more, one less, or one sent elsewhere; the others keep theirs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.execution.driven_fleet import DrivenFleet, rounds_of
from viaspline.fleet.execution.fleet_orders import index_of
from viaspline.fleet.execution.grown_certificate import grown_certificate
from viaspline.fleet.execution.grown_fleet import GrownFleet, grown_fleet
from viaspline.fleet.execution.joined_fleet import LetIn, joined_fleet
from viaspline.fleet.execution.left_fleet import fleet_without
from viaspline.fleet.execution.renewed_precedences import renewed_precedences
from viaspline.fleet.execution.ways_from_rest import check_member, laid_from_rest
from viaspline.fleet.execution.ways_in_the_air import laid_from_hover
from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.laying.resting_places import RestingPlaces, rests_of
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.fleet.patrols.fleet_patrols import FleetPatrols
from viaspline.fleet.precedences import Precedence, precedences_of
from viaspline.fleet.robots_at_home import certify_all
from viaspline.fleet.space.hover_places import hovers_of
from viaspline.fleet.timing.rides import FleetRides
from viaspline.fleet.timing.timed_trajectory import timed_trajectory
from viaspline.handed_in import check_kind
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.mission.fleet.changed_fleet import changed_fleet
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.space.spatial_plan import SpatialPlan


def add_robot(plan: FleetPlan, member: FleetMember) -> FleetPlan:
    """A plan with one robot more; the paths and the laws of the others stay as they are.

    Its path is laid round the places where the others rest, and it lets pass whom it has to. Among
    patrols that never end it arrives a period before the last lap that is laid out ends.

    Args:
        plan: Of the others.
        member: The robot.

    Raises:
        PlanningError: It has no path, or can't be timed along it among the others.
        GeometryError: There is a robot of its name, it never ends, or something moves in the world
            that waits for nobody.

    Example:
        >>> import viaspline as vs
        >>> plan = vs.plan_fleet(vs.Fleet.model_validate({"separation_m": 1, "fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
        ... ]}))
        >>> there = vs.Mission.model_validate({"route": {"start": [20, -20], "goal": [20, 20]}})
        >>> both = add_robot(plan, vs.FleetMember("b", there))
        >>> [(one.first, one.second) for one in both.precedences], both.served
        ([('a', 'b')], True)
        >>> both.plans["a"] is plan.plans["a"]
        True
    """
    check_kind("plan", plan, FleetPlan, "give plan_fleet(fleet)")
    check_member(member, flies=plan.is_spatial)
    if member.name in {one.name for one in plan.fleet.members}:
        raise GeometryError(f"there is a robot {member.name!r} already; give another name")
    return _with(plan, member, (*plan.fleet.members, member))


def reroute_robot(plan: FleetPlan, member: FleetMember) -> FleetPlan:
    """A plan in which one robot has another mission; all else stays as it is.

    Args:
        plan: Of the fleet.
        member: The robot with its other mission.

    Raises:
        PlanningError: It has no path, or can't be timed along it among the others.
        GeometryError: There is no robot of its name, the mission never ends, or something moves in
            the world that waits for nobody.

    Example:
        >>> import viaspline as vs
        >>> plan = vs.plan_fleet(vs.Fleet.model_validate({"fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
        ... ]}))
        >>> farther = vs.Mission.model_validate({"route": {"start": [0, 0], "goal": [50, 0]}})
        >>> reroute_robot(plan, vs.FleetMember("a", farther)).plans["a"].path.length
        50.0
    """
    check_kind("plan", plan, FleetPlan, "give plan_fleet(fleet)")
    check_member(member, flies=plan.is_spatial)
    names = tuple(one.name for one in plan.fleet.members)
    members = list(plan.fleet.members)
    members[index_of(names, member.name)] = member
    return _with(plan, member, members)


def remove_robot(plan: FleetPlan, name: str) -> FleetPlan:
    """A plan without one of its robots; the paths and the laws of the others stay as they are.

    Args:
        plan: Of the fleet.
        name: Of the robot.

    Raises:
        GeometryError: There is no such robot, it is the only one, or something moves in the world
            that waits for nobody.

    Example:
        >>> import viaspline as vs
        >>> plan = vs.plan_fleet(vs.Fleet.model_validate({"fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
        ...     {"name": "b", "route": {"start": [0, 9], "goal": [40, 9]}},
        ... ]}))
        >>> list(remove_robot(plan, "a").plans)
        ['b']
    """
    check_kind("plan", plan, FleetPlan, "give plan_fleet(fleet)")
    index_of(tuple(one.name for one in plan.fleet.members), name)
    members = [one for one in plan.fleet.members if one.name != name]
    if not members:
        raise GeometryError(f"{name!r} is the only robot; a fleet has one at least")
    _check_nothing_moves(plan)
    driven = _driven(plan)
    if name in plan.names:
        driven = fleet_without(driven, plan.names.index(name))
    plans = {one: it for one, it in plan.plans.items() if one != name}
    rides = _rides_left(driven, plan, name)
    crossings = ordered_crossings(driven.courses, driven.crossings, driven.laws)
    precedences = precedences_of(driven.courses, crossings, driven.laws, rides.laws)
    driven = replace(driven, crossings=crossings)
    fleet = Fleet.of(members, plan.fleet.separation_m)
    certificate = certify_all(fleet, driven.courses, driven.laws)
    return _planned(plan, fleet, driven, plans, rides, precedences, certificate)


def _check_nothing_moves(plan: FleetPlan) -> None:
    """Refuse to change the plan of a fleet among things that move."""
    if plan.fleet.world.moving:
        name = plan.fleet.world.moving[0].name or "what moves"
        raise GeometryError(
            f"'{name}' waits for nobody, and only robots are timed among each other here; plan the "
            "whole fleet anew with plan_fleet, or leave the motion out"
        )


def _with(plan: FleetPlan, member: FleetMember, members: Sequence[FleetMember]) -> FleetPlan:
    """A plan with a robot more, or in place of one of its name."""
    _check_nothing_moves(plan)
    driven = _driven(plan)
    laid = _laid(plan, member)
    count = len(plan.names)
    nowhere = LetIn(np.full(count, np.inf), np.zeros(count), np.zeros(count, np.bool_))
    grown = joined_fleet(grown_fleet(driven, member, laid), driven.laws.packed, nowhere)
    joined = grown.fleet
    robot = joined.names.index(member.name)
    rides = _joined_rides(grown, plan)
    law = timed_trajectory(laid.trajectory, joined.courses, rides, joined.laws, robot)
    plans = {**plan.plans, member.name: replace(laid, trajectory=law)}
    crossings, precedences = renewed_precedences(plan, grown, rides.laws)
    joined, fleet = replace(joined, crossings=crossings), _asked(plan, members, member)
    certificate = grown_certificate(plan, fleet, joined, robot)
    return _planned(plan, fleet, joined, plans, rides, precedences, certificate)


def _asked(plan: FleetPlan, members: Sequence[FleetMember], member: FleetMember) -> Fleet:
    """What is asked for with a robot more, or in place of one of its name."""
    if plan.is_spatial:
        return Fleet.of(members, plan.fleet.separation_m)
    return changed_fleet(plan.fleet, members, member)


def _laid(plan: FleetPlan, member: FleetMember) -> AnyPlan:
    """The path of a robot round the places where the others rest, and its law if it were alone."""
    others = [one for one in plan.fleet.members if one.name != member.name]
    if plan.is_spatial:
        flights = {name: one for name, one in plan.plans.items() if isinstance(one, SpatialPlan)}
        hovers = [it for one in others for it in hovers_of(one, flights.get(one.name))]
        return laid_from_hover(member, plan.fleet.separation_m, hovers)
    reaches = dict(zip(plan.names, plan.courses.packed.reach.tolist(), strict=True))
    half = 0.5 * plan.fleet.separation_m
    rests = RestingPlaces(
        tuple(
            rest
            for one in others
            for rest in rests_of(
                one, reaches.get(one.name) or one.mission.robot.outer_radius + half
            )
        )
    )
    out = [one.name for one in plan.not_served if one.name != member.name]
    return laid_from_rest(member, plan.fleet.separation_m, rests, out)


def _driven(plan: FleetPlan) -> DrivenFleet:
    """The parts of a plan that change with its robots."""
    return DrivenFleet(
        plan.courses, plan.crossings, plan.laws, plan.rides.packed, plan.fleet.separation_m,
        *rounds_of(plan),
    )  # fmt: skip


def _rides_left(driven: DrivenFleet, before: FleetPlan, gone: str) -> FleetRides:
    """How robots drive alone that are left when one is taken out of a plan."""
    kept = np.array([name != gone for name in before.names], np.bool_)
    nodes = np.repeat(kept, np.diff(before.courses.packed.first))
    arrive, leave, speed, timed = before.rides.laws.packed
    laws = PackedLaws(arrive[nodes], leave[nodes], speed[nodes], timed[kept])
    return FleetRides(driven.rides, before.rides.alone[kept], FleetLaws(laws))


def _joined_rides(grown: GrownFleet, before: FleetPlan) -> FleetRides:
    """How robots drive alone with one of them more, or with one on another path."""
    fleet, robot, at = grown.fleet, grown.robot, grown.at
    mine = slice(*fleet.courses.packed.first[robot : robot + 2].tolist())
    rides, old = fleet.rides, before.rides.laws.packed
    goes = rides.depart[robot] + np.cumsum(rides.lasts[mine] + rides.stays[mine])
    goes -= rides.lasts[mine]
    leave = goes.copy()
    leave[-1] = np.inf
    laws = PackedLaws(
        at.by_node(old.arrive, goes - rides.stays[mine]),
        at.by_node(old.leave, leave),
        at.by_node(old.speed, np.sqrt(rides.square[mine])),
        at.by_robot(old.is_timed, np.ones(1, np.bool_)),
    )
    alone = at.by_robot(before.rides.alone, goes[-1:] - rides.depart[robot])
    return FleetRides(rides, alone, FleetLaws(laws))


def _patrols(
    before: FleetPlan, plans: Mapping[str, AnyPlan], driven: DrivenFleet
) -> FleetPatrols | None:
    """What still never ends, and from when on nothing else moves; None: all end."""
    if before.patrols is None or driven.rounds is None:
        return None
    names = [n for n, way in zip(driven.names, driven.rounds.tolist(), strict=True) if way > 0.0]
    if not names:
        return None
    ends = [one.trajectory.end_time for name, one in plans.items() if name not in names]
    old = before.patrols
    since = max([old.repeats_from, *ends])
    return FleetPatrols(
        old.period,
        {name: old.laps[name] for name in names},
        {name: old.begins[name] for name in names},
        since,
        max(old.planned_until, since + old.period),
    )


def _planned(
    before: FleetPlan,
    fleet: Fleet,
    driven: DrivenFleet,
    plans: Mapping[str, AnyPlan],
    rides: FleetRides,
    precedences: tuple[Precedence, ...],
    certificate: FleetCertificate,
) -> FleetPlan:
    """The plan of a fleet that was changed."""
    patrols = _patrols(before, plans, driven)
    if patrols is not None:
        certificate = replace(certificate, repeats=(patrols.repeats_from, patrols.period))
    names = [one.name for one in fleet.fleet]
    return FleetPlan(
        fleet=fleet,
        plans={name: plans[name] for name in names if name in plans},
        not_served=tuple(one for one in before.not_served if one.name in set(names) - set(plans)),
        certificate=certificate,
        precedences=precedences,
        alone=dict(zip(driven.names, rides.alone.tolist(), strict=True)),
        courses=driven.courses,
        crossings=driven.crossings,
        laws=driven.laws,
        rides=rides,
        patrols=patrols,
    )
