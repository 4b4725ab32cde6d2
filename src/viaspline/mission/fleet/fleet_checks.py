"""What types can't say of a fleet: the semantic checks, all of them, on whatever parts are sound.

What is wrong with the world or with a kind of robot is said once, not once for each robot.

Tested through ``mission/fleet/test_fleet``.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from dataclasses import replace

from viaspline.mission.clearances import clearance_faults
from viaspline.mission.fleet.flying_checks import flying_faults, is_flying
from viaspline.mission.fleet.member_parts import kind_in
from viaspline.mission.fleet.partial_fleet import PartialFleet, PartialMember
from viaspline.mission.fleet.standing_places import standing_faults
from viaspline.mission.partial_mission import PartialMission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.semantic_checks import robot_faults, route_faults, world_faults
from viaspline.mission.space.spatial_parts import SpatialParts
from viaspline.mission.unplaced_faults import Path, UnplacedFault, spell

UNSEEN = (
    "a fleet is planned on what is known: a robot that goes round something unseen leaves the path "
    "on which it is proven apart from the others",
    "put these obstacles under world.known, or leave them out",
)


def fleet_faults(partial: PartialFleet) -> list[UnplacedFault]:
    """Everything that is wrong with the meaning of a fleet."""
    faults, misshapen = world_faults(partial.world)
    if partial.world.unseen:
        faults.append(UnplacedFault(("world", "unseen"), *UNSEEN, at_key=True))
    for kind in partial.kinds.values():
        faults += _moved(robot_faults(kind), ("robot",), kind.robot_path)
    faults += _names(partial)
    strange = set()
    flies = is_flying(partial)
    for member in partial.members:
        found, is_strange = _faults_of(member, partial, flies=flies)
        faults += found
        if is_strange:
            strange.add(member.path)
    if flies:
        return faults + flying_faults(partial, misshapen)
    for points in _asked_together(partial, strange):
        faults += clearance_faults(points, misshapen)
    return faults + standing_faults(partial)


def _moved(faults: list[UnplacedFault], old: Path, new: Path) -> list[UnplacedFault]:
    """Faults with another beginning of their paths."""
    return [fault._replace(path=(*new, *fault.path[len(old) :])) for fault in faults]


def _names(partial: PartialFleet) -> Iterator[UnplacedFault]:
    first: dict[str, Path] = {}
    for member in partial.members:
        if member.name is None:
            continue
        if member.name in first:
            problem = f"the name '{member.name}' is taken by {spell(first[member.name])}"
            remedy = "give each robot a name of its own"
            yield UnplacedFault((*member.path, "name"), problem, remedy)
        else:
            first[member.name] = member.path


def _faults_of(
    member: PartialMember, fleet: PartialFleet, *, flies: bool
) -> tuple[list[UnplacedFault], bool]:
    """What is wrong with a robot by itself, and whether its corridor is."""
    faults = list(_keys(member, fleet))
    found: list[UnplacedFault] = []
    is_strange = False
    if member.parts.has_route:
        parts = member.parts
        if flies and parts.space is None:  # its points are looked at as places in space
            parts = replace(parts, space=SpatialParts())
        found, is_strange = route_faults(parts)
    if member.home != member.path:
        found += robot_faults(member.parts)
    return faults + _moved(found, (), member.home), is_strange


def _keys(member: PartialMember, fleet: PartialFleet) -> Iterator[UnplacedFault]:
    """A kind that there isn't or that isn't said, and a departure that is said twice."""
    if member.kind and member.kind not in fleet.kinds:
        problem = f"there is no kind of robot '{member.kind}'"
        yield UnplacedFault((*member.path, "robot"), problem, _kind_remedy(member.kind, fleet))
    if member.kind == "" and member.parts.has_route and len(fleet.kinds) > 1:
        remedy = f"give robot: {' or '.join(fleet.kinds)}"
        yield UnplacedFault(member.path, "doesn't say what kind of robot it is", remedy)
    if member.departs_twice:
        problem = "its route says depart_s already"
        yield UnplacedFault((*member.path, "depart_s"), problem, "give one of the two", at_key=True)


def _kind_remedy(kind: str, fleet: PartialFleet) -> str:
    if not fleet.kinds:
        return f"give robots: {{{kind}: {{radius_m: 0.5}}}}"
    near = difflib.get_close_matches(kind, fleet.kinds, n=1)
    if near:
        return f"did you mean '{near[0]}'?"
    return f"the kinds under robots are {', '.join(fleet.kinds)}"


def _asked_together(partial: PartialFleet, strange: set[Path]) -> Iterator[PartialMission]:
    """Points of all routes, those together that ask the same of the world: one check for each.

    A robot in a corridor has a room of its own, and is asked by itself.
    """
    together: dict[tuple[Path, RobotSpec | None], PartialMission] = {}
    for member in partial.members:
        parts = member.parts
        placed = [((*member.home, *path), point) for path, point in parts.points]
        own = replace(
            partial.world,
            points=placed,
            robot=parts.robot,
            robot_path=_robot_path(member, partial),
            corridor=None if member.path in strange else parts.corridor,
            closed=parts.closed,
        )
        if own.corridor is not None:
            yield own
        else:
            key = (own.robot_path, own.robot)
            together.setdefault(key, replace(own, points=[])).points.extend(placed)
    yield from together.values()


def _robot_path(member: PartialMember, fleet: PartialFleet) -> Path:
    """Where a robot's kind stands; in a mission's file as seen from there."""
    kind = None if member.kind is None else kind_in(fleet.kinds, member.kind or None)
    return ("robot",) if kind is None else kind.robot_path
