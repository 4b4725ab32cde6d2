"""Each robot's path by itself, among the places where the others rest.

A path that passes no resting place of another can be timed whatever the others do: see
``plan_fleet``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from viaspline.errors import GaveUpError, GeometryError, PlanningError
from viaspline.fleet.fleet_plan import NotServed
from viaspline.fleet.laying.kept_paths import KeptPaths, PathAlone
from viaspline.fleet.laying.lay_among_rests import LaidPath, lay_among_rests
from viaspline.fleet.laying.resting_places import RestingPlace, RestingPlaces, all_rests
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan_in
from viaspline.planning.routing.visit_order import ordered
from viaspline.world.world import World

LayingProgress: TypeAlias = Callable[[int, int], None]
"""Called with how many robots have their path, and how many there are."""


@dataclass(frozen=True, eq=False)
class LaidPaths:
    """The paths of a fleet, each with the law that its robot would drive alone.

    Attributes:
        plans: By name, in the order of the fleet.
        not_served: The robots that have none, with the reason.
        passed: By name, the resting places of others that a path comes too near to, where it does.
        kept: What the next laying of a fleet that differs a little can take from this one.
    """

    plans: dict[str, Plan]
    not_served: tuple[NotServed, ...] = ()
    passed: Mapping[str, tuple[RestingPlace, ...]] = field(default_factory=dict)
    kept: KeptPaths | None = None


def lay_paths(
    fleet: Fleet, progress: LayingProgress | None = None, before: KeptPaths | None = None
) -> LaidPaths:
    """Lay the path of every robot, round those resting places of others that it would hit.

    Where there is no way round one of them, the path passes it, and timing has to see to it that
    its robot isn't there then. A robot without a path stands at its start for good.

    Args:
        fleet: What is asked for.
        progress: See ``LayingProgress``.
        before: From an earlier laying: what was asked for then isn't laid again. The paths are the
            same without it.

    Example:
        >>> mission = lambda start, goal: Mission.model_validate(
        ...     {"route": {"start": start, "goal": goal}})
        >>> a, b = mission((0, 0), (20, 0)), mission((10, 0.5), (10, 20))
        >>> laid = lay_paths(Fleet.of([FleetMember("a", a), FleetMember("b", b)], 1.0))
        >>> [round(plan.path.length, 1) for plan in laid.plans.values()], dict(laid.passed)
        ([20.4, 19.5], {})
    """
    members = fleet.members
    worlds = list(before.worlds) if before is not None else []
    alone = _alone(fleet, worlds, before)
    reaches = [_reach(fleet, one, alone.get(one.name)) for one in members]
    rests = all_rests(members, reaches)
    laid: dict[str, LaidPath] = {}
    for k, (member, reach) in enumerate(zip(members, reaches, strict=True)):
        found = alone[member.name]
        if isinstance(found, PathAlone):
            laid[member.name] = _among_rests(member.name, found, reach, rests, before)
        if progress is not None:
            progress(k + 1, len(members))
    asked = {one.name: one.mission for one in members}
    return LaidPaths(
        {name: one.plan for name, one in laid.items()},
        tuple(one for one in alone.values() if isinstance(one, NotServed)),
        {name: one.passed for name, one in laid.items() if one.passed},
        KeptPaths(asked, tuple(worlds[-1:]), alone, rests, laid),
    )


def _among_rests(
    name: str, alone: PathAlone, reach: float, rests: RestingPlaces, before: KeptPaths | None
) -> LaidPath:
    """The path of a robot among resting places: the one that it had, if nothing has changed."""
    if before is not None:
        return before.laid_of(name, alone, reach, rests)
    return lay_among_rests(alone.plan, alone.mission, name, reach, rests)


def _alone(
    fleet: Fleet, worlds: list[tuple[Mission, World]], before: KeptPaths | None
) -> dict[str, PathAlone | NotServed]:
    """Every robot's plan as if it were alone, by name; worlds that are packed are added."""
    found: dict[str, PathAlone | NotServed] = {}
    for member in fleet.members:
        kept = None if before is None else before.alone_of(member)
        found[member.name] = kept or _alone_anew(member, worlds)
    return found


def _alone_anew(member: FleetMember, worlds: list[tuple[Mission, World]]) -> PathAlone | NotServed:
    """A robot's plan as if it were alone, or why there is none."""
    try:
        world = _shared_world(member.mission, worlds)
        mission = ordered(member.mission, world)
        if mission is not member.mission and mission.route.corridor is not None:
            world = World.known(mission)
        return PathAlone(mission, plan_in(mission, world))
    except (PlanningError, GeometryError) as error:
        return not_served(member.name, error)


def _shared_world(mission: Mission, shared: list[tuple[Mission, World]]) -> World:
    """What a mission has on its map, packed once for all that have the same."""
    if mission.route.corridor is not None:
        return World.known(mission)
    for other, world in shared:
        if other.world is mission.world or other.world == mission.world:
            return world
    shared.append((mission, World.known(mission)))
    return shared[-1][1]


def not_served(name: str, error: PlanningError | GeometryError) -> NotServed:
    """What is told of a robot that has no path."""
    if isinstance(error, GaveUpError):
        return NotServed(name, "gave up", error.reason, error.remedy)
    if isinstance(error, PlanningError):
        return NotServed(name, "refused", error.reason, error.remedy)
    reason, _, remedy = str(error).partition("; ")
    return NotServed(name, "refused", reason, remedy)


def _reach(fleet: Fleet, member: FleetMember, alone: PathAlone | NotServed | None) -> float:
    """How far a robot keeps others away on its part [m]; see ``PackedCourses``."""
    robot = member.mission.robot
    error = alone.plan.tracking_error if isinstance(alone, PathAlone) else robot.tracking_error_m
    return robot.outer_radius + (error or 0.0) + 0.5 * fleet.separation_m
