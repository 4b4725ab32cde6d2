"""A sound fleet with a robot more, or with another mission of one: only that robot is looked at."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from viaspline.errors import MissionError
from viaspline.mission.clearances import ROUND_OFF_M
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.fleet.fleet_parts import FleetParts


def changed_fleet(before: Fleet, members: Sequence[FleetMember], changed: FleetMember) -> Fleet:
    """What ``Fleet.of(members)`` gives, in time for one robot where all is sound.

    Args:
        before: A sound fleet in the plane.
        members: Its members, one of them replaced, or with one more.
        changed: That one.

    Raises:
        MissionError: With every fault.

    >>> there = {"route": {"start": [0, 0], "goal": [9, 0]}}
    >>> before = Fleet.model_validate({"fleet": [{"name": "r1", **there}]})
    >>> other = FleetMember("r2", before.members[0].mission)
    >>> changed_fleet(before, [*before.members, other], other)
    Traceback (most recent call last):
    viaspline.errors.MissionError: <mission>: fleet[1].mission.route.start.at: 'r2' starts 0 m ...
    """
    if changed.mission.world != before.world:
        return Fleet.of(members, before.separation_m)
    beside = [one for one in members if one.name != changed.name]
    near = [one for one in beside if _may_be_too_near(one, changed, before.separation_m)]
    try:
        Fleet.of([changed, *near], before.separation_m)
    except MissionError:
        return Fleet.of(members, before.separation_m)  # tells where among all others that stands
    return sound_fleet_of(before, members)


def sound_fleet_of(before: Fleet, members: Sequence[FleetMember]) -> Fleet:
    """``Fleet.of(members)``, which are known to be sound together in the world of another fleet."""
    asked = [
        {
            "name": one.name, "mission": None, "asked": one.mission, "priority": one.priority,
            "rest": one.rest,
        }
        for one in members
    ]  # fmt: skip
    parts = FleetParts.model_validate(
        {"world": before.world, "separation_m": before.separation_m, "fleet": asked}
    )
    return Fleet.model_construct(parts.model_fields_set, **dict(parts))


def _may_be_too_near(one: FleetMember, other: FleetMember, separation: float) -> bool:
    """Whether two robots may stand too near each other at one of their ends."""
    reach = separation + ROUND_OFF_M + _radius(one) + _radius(other)
    ends = list(_ends(other))
    return any(math.dist(place, there) <= reach for place in _ends(one) for there in ends)


def _radius(one: FleetMember) -> float:
    robot = one.mission.robot
    return robot.outer_radius + (robot.tracking_error_m or 0.0)


def _ends(one: FleetMember) -> Iterator[tuple[float, ...]]:
    """Where a route starts, and where it may end."""
    route = one.mission.route
    yield route.start.at[:2]
    if route.goal is not None:
        yield route.goal.at[:2]
    elif route.via:
        yield from (via.at[:2] for via in route.via)
