"""Each robot's path by itself, among the places where the others rest.

A path that passes no resting place of another can be timed whatever the others do: see
``plan_fleet``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias, TypeVar

from viaspline.errors import GaveUpError, GeometryError, PlanningError
from viaspline.fleet.fleet_plan import NotServed
from viaspline.fleet.laying.lay_among_rests import LaidPath, lay_among_rests
from viaspline.fleet.laying.laying_workers import LayingWorkers, ThisProcess
from viaspline.fleet.laying.resting_places import RestingPlace, RestingPlaces, all_rests
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan_in
from viaspline.planning.routing.visit_order import ordered
from viaspline.world.world import World

LayingProgress: TypeAlias = Callable[[int, int], None]
"""Called with how many paths are laid, and how many have to be: alone, then among all."""

AT_ONCE = 25
"""So many robots are one piece of work."""
THIS_PROCESS = ThisProcess()
Part = TypeVar("Part")
Done = TypeVar("Done")


@dataclass(frozen=True, eq=False)
class LaidPaths:
    """The paths of a fleet, each with the law that its robot would drive alone.

    Attributes:
        plans: By name, in the order of the fleet.
        not_served: The robots that have none, with the reason.
        passed: By name, the resting places of others that a path comes too near to, where it does.
    """

    plans: dict[str, Plan]
    not_served: tuple[NotServed, ...] = ()
    passed: Mapping[str, tuple[RestingPlace, ...]] = field(default_factory=dict)


def lay_paths(
    fleet: Fleet,
    progress: LayingProgress | None = None,
    workers: LayingWorkers = THIS_PROCESS,
) -> LaidPaths:
    """Lay the path of every robot, round those resting places of others that it would hit.

    Where there is no way round one of them, the path passes it, and timing has to see to it that
    its robot isn't there then. A robot without a path stands at its start for good.

    Args:
        fleet: What is asked for.
        progress: See ``LayingProgress``.
        workers: Who lays them; the paths don't depend on that.

    Example:
        >>> mission = lambda start, goal: Mission.model_validate(
        ...     {"route": {"start": start, "goal": goal}})
        >>> a, b = mission((0, 0), (20, 0)), mission((10, 0.5), (10, 20))
        >>> laid = lay_paths(Fleet.of([FleetMember("a", a), FleetMember("b", b)], 1.0))
        >>> [round(plan.path.length, 1) for plan in laid.plans.values()], dict(laid.passed)
        ([20.4, 19.5], {})
    """
    members = fleet.members
    tell = _Told(progress, 2 * len(members))
    parts = [members[k : k + AT_ONCE] for k in range(0, len(members), AT_ONCE)]
    alone = [one for part in _in_order(workers, lay_alone, parts, tell) for one in part]
    reaches = [_reach(fleet, *pair) for pair in zip(members, alone, strict=True)]
    rests = all_rests(members, reaches)
    tasks = [
        AmongRests(tuple(alone[k : k + AT_ONCE]), tuple(reaches[k : k + AT_ONCE]), rests)
        for k in range(0, len(members), AT_ONCE)
    ]
    laid = [one for part in _in_order(workers, lay_among, tasks, tell) for one in part]
    named = {member.name: one for member, one in zip(members, laid, strict=True) if one is not None}
    return LaidPaths(
        {name: one.plan for name, one in named.items()},
        tuple(one for one in alone if isinstance(one, NotServed)),
        {name: one.passed for name, one in named.items() if one.passed},
    )


class _Told:
    """Counts the pieces that are done, and tells."""

    def __init__(self, progress: LayingProgress | None, pieces: int) -> None:
        self._progress, self._pieces, self._done = progress, pieces, 0

    def more(self, pieces: int) -> None:
        self._done += pieces
        if self._progress is not None:
            self._progress(self._done, self._pieces)


def _in_order(
    workers: LayingWorkers, task: Callable[[Part], list[Done]], parts: Sequence[Part], tell: _Told
) -> list[list[Done]]:
    """What comes of every part, in the order of the parts."""
    found: dict[int, list[Done]] = {}
    for k, done in workers.each(task, parts):
        found[k] = done
        tell.more(len(done))
    return [found[k] for k in range(len(parts))]


@dataclass(frozen=True, eq=False)
class AlonePlan:
    """What a robot does if it is alone.

    Attributes:
        name: The robot.
        mission: Its via points in the order in which they are served.
        plan: Of that.
    """

    name: str
    mission: Mission
    plan: Plan


@dataclass(frozen=True, eq=False)
class AmongRests:
    """Robots whose paths are to be laid among resting places.

    Attributes:
        alone: What each does if it is alone, or why that is nothing.
        reaches: Of each [m].
        rests: Of all robots of the fleet.
    """

    alone: tuple[AlonePlan | NotServed, ...]
    reaches: tuple[float, ...]
    rests: RestingPlaces


def lay_among(asked: AmongRests) -> list[LaidPath | None]:
    """Lay paths among resting places; None for a robot that has none even alone."""
    return [
        lay_among_rests(one.plan, one.mission, one.name, reach, asked.rests)
        if isinstance(one, AlonePlan)
        else None
        for one, reach in zip(asked.alone, asked.reaches, strict=True)
    ]


def lay_alone(members: Sequence[FleetMember]) -> list[AlonePlan | NotServed]:
    """Each robot's plan as if it were alone."""
    shared: list[tuple[Mission, World]] = []
    found: list[AlonePlan | NotServed] = []
    for member in members:
        world = _shared_world(member.mission, shared)
        try:
            mission = ordered(member.mission, world)
            if mission is not member.mission and mission.route.corridor is not None:
                world = World.known(mission)
            found.append(AlonePlan(member.name, mission, plan_in(mission, world)))
        except (PlanningError, GeometryError) as error:
            found.append(not_served(member.name, error))
    return found


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


def _reach(fleet: Fleet, member: FleetMember, alone: AlonePlan | NotServed) -> float:
    """How far a robot keeps others away on its part [m]; see ``PackedCourses``."""
    robot = member.mission.robot
    error = alone.plan.tracking_error if isinstance(alone, AlonePlan) else robot.tracking_error_m
    return robot.outer_radius + (error or 0.0) + 0.5 * fleet.separation_m
