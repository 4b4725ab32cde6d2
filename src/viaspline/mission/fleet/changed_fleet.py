"""A sound fleet with a robot more, or with another mission of one: only that robot is looked at."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from viaspline.errors import MissionError
from viaspline.mission.clearances import ROUND_OFF_M
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.fleet.fleet_parts import FleetParts

GIVEN: Final = frozenset(("name", "mission", "asked", "priority", "rest"))
"""What is said of a robot that is given with its mission."""


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
    """``Fleet.of(members)``, which are known to be sound together in the world of another fleet.

    What is said of those that are in that fleet already, as missions of their own, is taken over.
    """
    kept = {
        id(one): spec
        for one, spec in zip(before.members, before.fleet, strict=True)
        if spec.model_fields_set == GIVEN and spec.asked is not None
    }
    asked = [kept.get(id(one)) or _as_given(one) for one in members]
    parts = FleetParts.model_validate(
        {"world": before.world, "separation_m": before.separation_m, "fleet": asked}
    )
    return Fleet.model_construct(parts.model_fields_set, **dict(parts))


def _as_given(one: FleetMember) -> dict[str, object]:
    """A robot as ``Fleet.of`` asks for it, its mission being read already."""
    return {
        "name": one.name, "mission": None, "asked": one.mission, "priority": one.priority,
        "rest": one.rest,
    }  # fmt: skip


def _maybe_too_near(
    members: Sequence[FleetMember], other: FleetMember, separation: float
) -> list[FleetMember]:
    """Those that may stand too near a robot at one of their ends: all that are asked at once."""
    if not members:
        return []
    ends = [_ends(one) for one in members]
    counts = [len(places) for places in ends]
    at = np.array([place for places in ends for place in places], float)
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


def _ends(one: FleetMember) -> list[tuple[float, ...]]:
    """Where a route starts, and where it may end."""
    route = one.mission.route
    if route.goal is not None:
        return [route.start.at[:2], route.goal.at[:2]]
    return [route.start.at[:2], *[via.at[:2] for via in route.via]]
