"""What each robot of a fleet does if it is alone in the world.

Tested through ``fleet/laying/test_lay_paths``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from viaspline.errors import GeometryError, PlanningError
from viaspline.fleet.laying.kept_paths import KeptPaths, PathAlone
from viaspline.fleet.laying.laid_pieces import (
    THIS_PROCESS,
    LaidPieces,
    LayingProgress,
    laid_in_order,
    pieces_of_work,
)
from viaspline.fleet.laying.laying_workers import LayingWorkers
from viaspline.fleet.not_served import NotServed, not_served
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan_in
from viaspline.planning.routing.visit_order import ordered
from viaspline.world.world import World

Worlds: TypeAlias = tuple[tuple[Mission, World], ...]
"""Worlds that are packed, each with a mission that has it."""


@dataclass(frozen=True, eq=False)
class AlonePaths:
    """What each robot of a fleet does if it is alone.

    Attributes:
        worlds: Those that are packed.
        of: The path of each robot, or why there is none, by name, in the order of the fleet.
    """

    worlds: Worlds
    of: Mapping[str, PathAlone | NotServed]

    @classmethod
    def of_kept(cls, kept: KeptPaths) -> AlonePaths:
        """What was found out of a fleet."""
        return cls(kept.worlds, kept.alone)

    @property
    def plans(self) -> dict[str, Plan]:
        """Of those robots that have a path, by name."""
        return {name: one.plan for name, one in self.of.items() if isinstance(one, PathAlone)}

    def reach(self, fleet: Fleet, member: FleetMember) -> float:
        """How far a robot keeps others away on its part [m]; see ``PackedCourses``."""
        robot, found = member.mission.robot, self.of[member.name]
        error = robot.tracking_error_m
        if isinstance(found, PathAlone):
            error = found.plan.tracking_error
        return robot.outer_radius + (error or 0.0) + 0.5 * fleet.separation_m


def alone_paths(
    fleet: Fleet,
    progress: LayingProgress | None = None,
    before: KeptPaths | None = None,
    workers: LayingWorkers = THIS_PROCESS,
) -> AlonePaths:
    """Lay the path of every robot as if it were alone.

    Args:
        fleet: What is asked for.
        progress: See ``LayingProgress``; half of the work is left when it is done.
        before: From an earlier laying: what was asked for then isn't laid again.
        workers: Who lays them.
    """
    members = fleet.members
    worlds = _worlds(members, before)
    tell = LaidPieces(progress, 2 * len(members))
    return AlonePaths(worlds, _laid(members, worlds, before, workers, tell))


def _laid(
    members: Sequence[FleetMember], worlds: Worlds, before: KeptPaths | None,
    workers: LayingWorkers, tell: LaidPieces,
) -> dict[str, PathAlone | NotServed]:  # fmt: skip
    """Every robot's plan as if it were alone, by name."""
    kept = {} if before is None else {one.name: before.alone_of(one) for one in members}
    anew = [one for one in members if kept.get(one.name) is None]
    tell.more(len(members) - len(anew))
    parts = [AloneTask(tuple(part), worlds) for part in pieces_of_work(anew)]
    laid = laid_in_order(workers, lay_alone, parts, tell)
    found = {one.name: path for one, path in zip(anew, laid, strict=True)}
    return {one.name: kept.get(one.name) or found[one.name] for one in members}


@dataclass(frozen=True, eq=False)
class AloneTask:
    """Robots whose paths are to be laid as if each were alone.

    Attributes:
        members: The robots.
        worlds: Those that are packed.
    """

    members: tuple[FleetMember, ...]
    worlds: Worlds


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
