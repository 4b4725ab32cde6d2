"""Are robots of a fleet in space apart where they start, and where they end for good?

Tested through ``mission/fleet/test_flying_fleets``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from viaspline.mission.clearances import ROUND_OFF_M
from viaspline.mission.fleet.partial_fleet import PartialMember
from viaspline.mission.fleet.standing_places import apart_remedy
from viaspline.mission.shapes.solids import Place
from viaspline.mission.space.flight_places import ground_height, place_of, standing_height
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.mission.space.ground_spec import GroundSpec
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number


class _Hover(NamedTuple):
    """A robot that is somewhere for long.

    Attributes:
        label: What it is called.
        path: Where its place stands in the fleet.
        place: [m].
        body: What it takes up there.
        is_start: Whether it is where it starts.
    """

    label: str
    path: Path
    place: Place
    body: FlyingBody
    is_start: bool


def standing_in_space(
    members: Sequence[PartialMember], ground: GroundSpec | None, separation: float | None
) -> list[UnplacedFault]:
    """Starts that are too near each other, and places at which two robots stay.

    Args:
        members: The robots.
        ground: Of their world.
        separation: Free space between two bodies [m]; None if it is faulty.
    """
    if separation is None:
        return []
    starts = [hover for one in members for hover in _start(one, ground)]
    ends = [hover for one in members for hover in _end(one, ground)]
    faults = [_fault(*pair, separation) for pair in _too_near(starts, separation)]
    return faults + [
        _fault(*pair, separation)
        for pair in _too_near(ends, separation)
        if not (pair[0].is_start and pair[1].is_start)  # said of their starts
    ]


def _start(member: PartialMember, ground: GroundSpec | None) -> Iterator[_Hover]:
    path, point = member.parts.points[0]
    robot, space = member.parts.robot, member.parts.space
    if point is None or robot is None:
        return
    x, y, z = place_of(point, ground)
    if math.isnan(z) and space is not None and space.has_takeoff:
        z = ground_height(ground, x, y) + standing_height(robot)
    yield from _hover(member, (*path, "at"), (x, y, z), is_start=True)


def _end(member: PartialMember, ground: GroundSpec | None) -> Iterator[_Hover]:
    """Where a robot stays for good, if it does and that can be said."""
    parts = member.parts
    robot, space = parts.robot, parts.space
    if member.rest != "stay" or robot is None:
        return
    if parts.closed:
        yield from _start(member, ground)
    elif space is not None and space.has_land:
        if space.land is not None:
            x, y = space.land.at
            z = ground_height(ground, x, y) + standing_height(robot)
            yield from _hover(member, ("route", "land", "at"), (x, y, z), is_start=False)
    elif member.end is not None:
        path, _ = parts.points[-1]
        place = place_of(member.end, ground)
        yield from _hover(member, (*path, "at"), place, is_start=False)


def _hover(member: PartialMember, path: Path, place: Place, *, is_start: bool) -> Iterator[_Hover]:
    robot = member.parts.robot
    if robot is None or math.isnan(place[2]):
        return
    label = "this robot" if member.name is None else f"'{member.name}'"
    yield _Hover(label, (*member.home, *path), place, FlyingBody.of(robot), is_start)


def _too_near(hovers: Sequence[_Hover], separation: float) -> Iterator[tuple[_Hover, _Hover]]:
    """For each robot that is too near others, the first of these and the robot itself."""
    for j, one in enumerate(hovers):
        for other in hovers[:j]:
            if _gap(other, one) < separation - ROUND_OFF_M:
                yield other, one
                break


def _gap(first: _Hover, second: _Hover) -> float:
    """Free space between two of them [m]."""
    offset = np.subtract(second.place, first.place)[None]
    return float(first.body.gaps(second.body, offset)[0])


def _fault(first: _Hover, second: _Hover, separation: float) -> UnplacedFault:
    both_start = first.is_start and second.is_start  # a round ends there as well
    verb = "starts" if both_start else "stays for good"
    gap = _gap(first, second)
    between = f"{number(max(gap, 0.0))} m of free space" if gap > 0.0 else "no free space"
    problem = (
        f"{second.label} {verb} with {between} between it and where {first.label} does: "
        f"separation_m asks for {number(separation)}"
    )
    at_goal = [one.label for one in (first, second) if not one.is_start]
    return UnplacedFault(second.path, problem, apart_remedy(gap, at_goal))
