"""The parts of a fleet that are structurally sound, each with its path.

A sound fleet is a partial one in which nothing is missing. If something is, the checks still run on
the rest, so that the user hears of every fault at once.

Tested through ``mission/fleet/test_fleet``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, cast

from pydantic import ValidationError

from viaspline.mission.fleet.fleet_parts import FleetParts
from viaspline.mission.fleet.member_parts import kind_in, robot_of, route_of, spline_of
from viaspline.mission.fleet.member_spec import MemberSpec, Rest
from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.partial_mission import PartialMission
from viaspline.mission.resolve_files import ResolvedFiles
from viaspline.mission.route_spec import EndPoint, Route, ViaPoint
from viaspline.mission.space.planar_keys import planar_keys_of
from viaspline.mission.unplaced_faults import Path, children, list_items
from viaspline.mission.world_spec import WorldSpec


@dataclass(frozen=True)
class PartialMember:
    """What could be read of a robot.

    Attributes:
        path: Where the robot stands in the fleet.
        home: Where its route stands: ``path``, or that of its mission's file.
        name: None if it is faulty.
        kind: The name of its kind; empty if it says none, None if it has a mission or that is
            faulty.
        parts: Its robot, if that is known, its route and its spline, with paths from ``home``.
        end: The point at which its route ends; None if that can't be said.
        rest: What it does there; None if that is faulty.
        departs_twice: Whether it says ``depart_s``, and its route does, too.
        is_patrol: Whether its route is a patrol that never ends.
        planar_keys: Keys of its route, and of its robot if that stands in a mission's file, that
            are for missions in the plane.
    """

    path: Path
    home: Path
    name: str | None
    kind: str | None
    parts: PartialMission
    end: ViaPoint | None
    rest: Rest | None
    departs_twice: bool = False
    is_patrol: bool = False
    planar_keys: tuple[Path, ...] = ()


@dataclass(frozen=True)
class PartialFleet:
    """What could be read of a fleet.

    Attributes:
        world: Its world.
        separation: Free space between two bodies [m]; None if it is faulty.
        kinds: The kinds of robots by name; None where one is faulty.
        members: The robots, those left out of which nothing could be read.
    """

    world: PartialMission
    separation: float | None
    kinds: Mapping[str, PartialMission]
    members: tuple[PartialMember, ...]

    @classmethod
    def of(cls, fleet: FleetParts, resolved: ResolvedFiles) -> PartialFleet:
        """A whole fleet as a partial one."""
        return cls(
            world=_world_of(fleet.world, resolved),
            separation=fleet.separation_m,
            kinds={
                name: PartialMission(robot=robot, robot_path=("robots", name))
                for name, robot in fleet.robots.items()
            },
            members=tuple(_members_of(fleet)),
        )

    @classmethod
    def salvage(cls, resolved: ResolvedFiles) -> PartialFleet:
        """What is sound in data that is not."""
        top = children(resolved.data) or {}
        world = PartialMission.salvage(replace(resolved, data={"world": top.get("world")}))
        kinds = {
            name: replace(_salvaged({"robot": robot}), robot_path=("robots", name))
            for name, robot in (children(top.get("robots")) or {}).items()
            if isinstance(name, str)
        }
        members = []
        for i, item in list_items(top.get("fleet")):
            keys = children(item)
            if keys is not None:
                members.append(_salvaged_member(i, keys, kinds, top.get("spline", {})))
        separation = _attempt({"fleet": _ANYBODY, "separation_m": top.get("separation_m", 0.5)})
        return cls(
            world=world,
            separation=None if separation is None else separation.separation_m,
            kinds=kinds,
            members=tuple(members),
        )


_ANYBODY = [{"name": "r1", "route": {"start": [0, 0]}}]


def _attempt(data: Any) -> FleetParts | None:
    try:
        return FleetParts.model_validate(data)
    except ValidationError:
        return None


def _world_of(world: WorldSpec, resolved: ResolvedFiles) -> PartialMission:
    route = Route(start=EndPoint(at=(0.0, 0.0)))
    parts = MissionParts.model_construct(world=world, route=route)
    return replace(PartialMission.of(parts, resolved), points=[], robot=None, spline=None)


def _members_of(fleet: FleetParts) -> Iterator[PartialMember]:
    """The robots of a sound fleet."""
    # All have these default values: to make them for each robot takes longer than all else here.
    others = dict(MissionParts.model_construct(route=Route(start=EndPoint(at=(0.0, 0.0)))))
    for i, one in enumerate(fleet.fleet):
        path: Path = ("fleet", i)
        home = path if one.asked is None else (*path, "mission")
        route = route_of(one)
        parts = MissionParts.model_construct(
            **{**others, "route": route, "spline": spline_of(one, fleet)}
        )
        yield PartialMember(
            path=path,
            home=home,
            name=one.name,
            kind=None if one.asked is not None else one.robot or "",
            parts=replace(
                PartialMission.of(parts, ResolvedFiles(None)), robot=robot_of(one, fleet)
            ),
            end=_end_of(route),
            rest=one.rest,
            departs_twice=_departs_twice(one),
            is_patrol=route.is_patrol,
            planar_keys=_planar_keys(route, one.asked),
        )


def _planar_keys(route: Any, asked: MissionParts | None) -> tuple[Path, ...]:
    """See `PartialMember`."""
    own = {} if asked is None else {"robot": asked.robot}
    return tuple(planar_keys_of({"route": route, **own}))


def _departs_twice(one: MemberSpec) -> bool:
    given = one.route is not None and "depart_s" in one.route.model_fields_set
    return given and one.depart_s is not None


def _end_of(route: Route) -> ViaPoint | None:
    """Where a route ends; the last via point may be another if they are put in order."""
    if route.closed:
        return route.start
    if route.goal is not None or not route.via:
        return route.goal
    return route.via[-1] if route.order == "given" else None


def _salvaged(data: Mapping[str, Any]) -> PartialMission:
    """What is sound in some parts of a mission."""
    found = PartialMission.salvage(ResolvedFiles(data))
    return found if "robot" in data else replace(found, robot=None)


def _salvaged_member(
    i: int, keys: Mapping[Any, Any], kinds: Mapping[str, PartialMission], spline: Any
) -> PartialMember:
    asked = keys.get("asked")
    name, rest = keys.get("name"), keys.get("rest", "stay")
    kind = _said_kind(keys)
    if asked is not None:
        parts = _salvaged({"route": asked.route, "spline": asked.spline})
        parts = replace(parts, robot=asked.robot)
    else:
        given = keys.get("spline")
        parts = _salvaged(
            {"route": keys.get("route"), "spline": spline if given is None else given}
        )
        known = None if kind is None else kind_in(kinds, kind or None)
        parts = replace(parts, robot=None if known is None else known.robot)
    return PartialMember(
        path=("fleet", i),
        home=("fleet", i) if asked is None else ("fleet", i, "mission"),
        name=name if isinstance(name, str) and name else None,
        kind=kind,
        parts=parts,
        end=parts.points[-1][1] if parts.has_goal else parts.points[0][1] if parts.closed else None,
        rest=cast(Rest, rest) if rest in ("stay", "leave") else None,
        planar_keys=_planar_keys(keys.get("route") if asked is None else asked.route, asked),
    )


def _said_kind(keys: Mapping[Any, Any]) -> str | None:
    """The kind that a robot says, see `PartialMember`."""
    kind = keys.get("robot")
    if keys.get("mission") is not None or keys.get("asked") is not None:
        return None
    if kind is None:
        return ""
    return kind if isinstance(kind, str) and kind else None
