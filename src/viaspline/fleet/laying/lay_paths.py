"""Each robot's path by itself, among the places where the others rest.

A path that passes no resting place of another can be timed whatever the others do: see
``plan_fleet``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import TypeAlias, TypeVar

from viaspline.errors import GaveUpError, GeometryError, PlanningError
from viaspline.fleet.laying.kept_paths import KeptPaths, PathAlone
from viaspline.fleet.laying.lay_among_rests import LaidPath, lay_among_rests
from viaspline.fleet.laying.laying_workers import LayingWorkers, ThisProcess
from viaspline.fleet.laying.resting_places import RestingPlace, RestingPlaces, all_rests
from viaspline.fleet.not_served import NotServed, Outcome
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan_in
from viaspline.planning.routing.visit_order import ordered
from viaspline.world.world import World

LayingProgress: TypeAlias = Callable[[int, int], None]
"""Called with how many paths are laid, and how many have to be: alone, then among all."""

AT_ONCE = 25
"""So many robots are one piece of work, in a large fleet."""
LEAST_PIECES = 12
"""Into so many pieces the work of a small one is cut."""
THIS_PROCESS = ThisProcess()
Worlds: TypeAlias = tuple[tuple[Mission, World], ...]
"""Worlds that are packed, each with a mission that has it."""
Part = TypeVar("Part")
Done = TypeVar("Done")


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
    fleet: Fleet,
    progress: LayingProgress | None = None,
    before: KeptPaths | None = None,
    workers: LayingWorkers = THIS_PROCESS,
) -> LaidPaths:
    """Lay the path of every robot, round those resting places of others that it would hit.

    Where there is no way round one of them, the path passes it, and timing has to see to it that
    its robot isn't there then. A robot without a path stands at its start for good, and no path
    passes there: who finds none round it stays at its start as well.

    Args:
        fleet: What is asked for.
        progress: See ``LayingProgress``.
        before: From an earlier laying: what was asked for then isn't laid again. The paths are the
            same without it.
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
    worlds = _worlds(members, before)
    alone = _alone(members, worlds, before, workers, tell)
    reaches = {one.name: _reach(fleet, one, alone[one.name]) for one in members}
    missing = {name: one for name, one in alone.items() if isinstance(one, NotServed)}
    while True:
        rests = _rests(members, reaches, missing)
        laid = _among(alone, reaches, rests, before, workers, tell)
        stuck = {name: one for name, one in laid.items() if isinstance(one, NotServed)}
        if not stuck.keys() - missing.keys():
            break
        missing |= stuck
    found = {name: one for name, one in laid.items() if isinstance(one, LaidPath)}
    return LaidPaths(
        {name: one.plan for name, one in found.items()},
        tuple(missing[one.name] for one in members if one.name in missing),
        {name: one.passed for name, one in found.items() if one.passed},
        KeptPaths({one.name: one.mission for one in members}, worlds, alone, rests, found),
    )


def _rests(
    members: Sequence[FleetMember], reaches: Mapping[str, float], missing: Mapping[str, NotServed]
) -> RestingPlaces:
    """Where robots rest, those for ever at their starts that have no path."""
    stranded = {name: one.outcome == "refused" for name, one in missing.items()}
    return all_rests(members, [reaches[one.name] for one in members], stranded)


class _Told:
    """Counts the pieces that are done, and tells."""

    def __init__(self, progress: LayingProgress | None, pieces: int) -> None:
        self._progress, self._pieces, self._done = progress, pieces, 0

    def more(self, pieces: int) -> None:
        self._done = min(self._done + pieces, self._pieces)  # some may be laid once more
        if self._progress is not None and pieces:
            self._progress(self._done, self._pieces)


def _pieces(robots: Sequence[Part]) -> list[Sequence[Part]]:
    """Robots in pieces of work."""
    size = min(AT_ONCE, -(-len(robots) // LEAST_PIECES))
    return [robots[k : k + size] for k in range(0, len(robots), max(size, 1))]


def _in_order(
    workers: LayingWorkers, task: Callable[[Part], list[Done]], parts: Sequence[Part], tell: _Told
) -> list[Done]:
    """What comes of all parts, in the order of the parts."""
    found: dict[int, list[Done]] = {}
    for k, done in workers.each(task, parts):
        found[k] = done
        tell.more(len(done))
    return [one for k in range(len(parts)) for one in found[k]]


def _alone(
    members: Sequence[FleetMember], worlds: Worlds, before: KeptPaths | None,
    workers: LayingWorkers, tell: _Told,
) -> dict[str, PathAlone | NotServed]:  # fmt: skip
    """Every robot's plan as if it were alone, by name."""
    kept = {} if before is None else {one.name: before.alone_of(one) for one in members}
    anew = [one for one in members if kept.get(one.name) is None]
    tell.more(len(members) - len(anew))
    parts = [AloneTask(tuple(part), worlds) for part in _pieces(anew)]
    laid = _in_order(workers, lay_alone, parts, tell)
    found = {one.name: path for one, path in zip(anew, laid, strict=True)}
    return {one.name: kept.get(one.name) or found[one.name] for one in members}


def _among(
    alone: Mapping[str, PathAlone | NotServed], reaches: Mapping[str, float], rests: RestingPlaces,
    before: KeptPaths | None, workers: LayingWorkers, tell: _Told,
) -> dict[str, LaidPath | NotServed]:  # fmt: skip
    """The path among resting places of every robot that has one alone, or why there is none."""
    paths = {name: one for name, one in alone.items() if isinstance(one, PathAlone)}
    if before is not None:
        found = {
            name: _laid_or_not(name, partial(before.laid_of, name, one, reaches[name], rests))
            for name, one in paths.items()
        }
        tell.more(len(alone))
        return found
    names = list(paths)
    tell.more(len(alone) - len(names))
    tasks = [
        AmongRests(
            tuple(part), tuple(paths[name] for name in part), tuple(reaches[n] for n in part), rests
        )
        for part in _pieces(names)
    ]
    return dict(zip(names, _in_order(workers, lay_among, tasks, tell), strict=True))


@dataclass(frozen=True, eq=False)
class AloneTask:
    """Robots whose paths are to be laid as if each were alone.

    Attributes:
        members: The robots.
        worlds: Those that are packed.
    """

    members: tuple[FleetMember, ...]
    worlds: Worlds


@dataclass(frozen=True, eq=False)
class AmongRests:
    """Robots whose paths are to be laid among resting places.

    Attributes:
        names: The robots.
        alone: What each does if it is alone.
        reaches: Of each [m].
        rests: Of all robots of the fleet.
    """

    names: tuple[str, ...]
    alone: tuple[PathAlone, ...]
    reaches: tuple[float, ...]
    rests: RestingPlaces


def lay_among(asked: AmongRests) -> list[LaidPath | NotServed]:
    """Lay paths among resting places, or say why there are none."""
    return [
        _laid_or_not(
            name, partial(lay_among_rests, one.plan, one.mission, name, reach, asked.rests)
        )
        for name, one, reach in zip(asked.names, asked.alone, asked.reaches, strict=True)
    ]


def _laid_or_not(name: str, lay: Callable[[], LaidPath]) -> LaidPath | NotServed:
    """What comes of laying a robot's path."""
    try:
        return lay()
    except PlanningError as error:
        return not_served(name, error)


def lay_alone(asked: AloneTask) -> list[PathAlone | NotServed]:
    """Each robot's plan as if it were alone, or why there is none."""
    return [_alone_anew(member, asked.worlds) for member in asked.members]


def _alone_anew(member: FleetMember, worlds: Worlds) -> PathAlone | NotServed:
    """A robot's plan as if it were alone, or why there is none."""
    try:
        world = _packed(member.mission, worlds)
        mission = ordered(member.mission, world)
        if mission is not member.mission and mission.route.corridor is not None:
            world = World.known(mission)
        return PathAlone(mission, plan_in(mission, world))
    except (PlanningError, GeometryError) as error:
        return not_served(member.name, error)


def _worlds(members: Sequence[FleetMember], before: KeptPaths | None) -> Worlds:
    """The world that robots share, packed once; packed already if it is the one from before."""
    mission = members[0].mission
    if mission.route.corridor is not None:
        return ()
    for other, world in () if before is None else before.worlds:
        if other.world is mission.world or other.world == mission.world:
            return ((other, world),)
    return ((mission, World.known(mission)),)


def _packed(mission: Mission, worlds: Worlds) -> World:
    """What a mission has on its map."""
    if mission.route.corridor is None:
        for other, world in worlds:
            if other.world is mission.world or other.world == mission.world:
                return world
    return World.known(mission)


def not_served(name: str, error: PlanningError | GeometryError) -> NotServed:
    """What is told of a robot that has no path."""
    if isinstance(error, PlanningError):
        outcome: Outcome = "gave up" if isinstance(error, GaveUpError) else "refused"
        where = (error.where[0], error.where[1])
        return NotServed(name, outcome, error.reason, error.remedy, error.obstacles, where)
    reason, _, remedy = str(error).partition("; ")
    return NotServed(name, "refused", reason, remedy)


def _reach(fleet: Fleet, member: FleetMember, alone: PathAlone | NotServed) -> float:
    """How far a robot keeps others away on its part [m]; see ``PackedCourses``."""
    robot = member.mission.robot
    error = alone.plan.tracking_error if isinstance(alone, PathAlone) else robot.tracking_error_m
    return robot.outer_radius + (error or 0.0) + 0.5 * fleet.separation_m
