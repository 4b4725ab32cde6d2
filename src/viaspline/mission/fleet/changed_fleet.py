"""A sound fleet with a robot more, or with another mission of one: only that robot is looked at."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

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
    near = _maybe_too_near(beside, changed, before.separation_m)
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


def _maybe_too_near(
    members: Sequence[FleetMember], other: FleetMember, separation: float
) -> list[FleetMember]:
    """Those that may stand too near a robot at one of their ends: all that are asked at once."""
    if not members:
        return []
    ends = [place for one in members for place in _ends(one)]
    counts = [_count_ends(one) for one in members]
    at = np.array(ends, float)
    apart = np.array([np.hypot(*(at - place).T) for place in _ends(other)]).min(axis=0)
    nearest = np.minimum.reduceat(apart, np.cumsum([0, *counts[:-1]]))
    kept = separation + ROUND_OFF_M + _radius(other)
    return [
        one
        for one, gap in zip(members, nearest.tolist(), strict=True)
        if gap <= kept + _radius(one)
    ]


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


def _count_ends(one: FleetMember) -> int:
    """How many places ``_ends`` has."""
    route = one.mission.route
    return 1 + (1 if route.goal is not None else len(route.via))
