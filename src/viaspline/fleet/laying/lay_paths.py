"""Each robot's path by itself, among the places where the others rest.

A path that passes no resting place of another can be timed whatever the others do: see
``plan_fleet``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

from viaspline.errors import PlanningError
from viaspline.fleet.laying.alone_paths import AlonePaths, alone_paths
from viaspline.fleet.laying.kept_paths import KeptPaths, PathAlone
from viaspline.fleet.laying.laid_pieces import (
    THIS_PROCESS,
    LaidPieces,
    LayingProgress,
    laid_in_order,
    pieces_of_work,
)
from viaspline.fleet.laying.lay_among_rests import LaidPath, lay_among_rests
from viaspline.fleet.laying.laying_workers import LayingWorkers
from viaspline.fleet.laying.resting_places import RestingPlace, RestingPlaces, all_rests
from viaspline.fleet.not_served import NotServed, not_served
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.planner import Plan


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
    alone: AlonePaths | None = None,
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
        alone: What each robot does if it is alone, if that is known.

    Example:
        >>> from viaspline.mission.model import Mission
        >>> mission = lambda start, goal: Mission.model_validate(
        ...     {"route": {"start": start, "goal": goal}})
        >>> a, b = mission((0, 0), (20, 0)), mission((10, 0.5), (10, 20))
        >>> laid = lay_paths(Fleet.of([FleetMember("a", a), FleetMember("b", b)], 1.0))
        >>> [round(plan.path.length, 1) for plan in laid.plans.values()], dict(laid.passed)
        ([20.4, 19.5], {})
    """
    members = fleet.members
    alone = alone or alone_paths(fleet, progress, before, workers)
    tell = LaidPieces(progress, 2 * len(members), len(members))
    reaches = {one.name: alone.reach(fleet, one) for one in members}
    missing = {name: one for name, one in alone.of.items() if isinstance(one, NotServed)}
    while True:
        rests = _rests(members, reaches, missing)
        laid = _among(alone.of, reaches, rests, before, workers, tell)
        stuck = {name: one for name, one in laid.items() if isinstance(one, NotServed)}
        if not stuck.keys() - missing.keys():
            break
        missing |= stuck
    found = {name: one for name, one in laid.items() if isinstance(one, LaidPath)}
    return LaidPaths(
        {name: one.plan for name, one in found.items()},
        tuple(missing[one.name] for one in members if one.name in missing),
        {name: one.passed for name, one in found.items() if one.passed},
        KeptPaths({one.name: one.mission for one in members}, alone.worlds, alone.of, rests, found),
    )


def _rests(
    members: Sequence[FleetMember], reaches: Mapping[str, float], missing: Mapping[str, NotServed]
) -> RestingPlaces:
    """Where robots rest, those for ever at their starts that have no path."""
    stranded = {name: one.outcome == "refused" for name, one in missing.items()}
    return all_rests(members, [reaches[one.name] for one in members], stranded)


def _among(
    alone: Mapping[str, PathAlone | NotServed], reaches: Mapping[str, float], rests: RestingPlaces,
    before: KeptPaths | None, workers: LayingWorkers, tell: LaidPieces,
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
        for part in pieces_of_work(names)
    ]
    return dict(zip(names, laid_in_order(workers, lay_among, tasks, tell), strict=True))


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
