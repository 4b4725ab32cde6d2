"""Do robots stand apart from each other where they start, and where they end for good?

A start on the goal of another robot is no fault: who goes first is the planner's.

Tested through ``mission/fleet/test_fleet``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from viaspline.mission.clearances import ROUND_OFF_M
from viaspline.mission.fleet.partial_fleet import PartialFleet, PartialMember
from viaspline.mission.route_spec import ViaPoint
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number


class _Stand(NamedTuple):
    """A robot that stands somewhere for long.

    Attributes:
        label: What it is called.
        path: Where its place stands in the fleet.
        place: x, y [m].
        radius: Of its body, with what it may be beside its path [m].
        is_start: Whether it stands at its start.
    """

    label: str
    path: Path
    place: tuple[float, float]
    radius: float
    is_start: bool


def standing_faults(partial: PartialFleet) -> list[UnplacedFault]:
    """Starts that are too near each other, and goals at which two robots stay."""
    separation = partial.separation
    if separation is None:
        return []
    starts = [stand for each in partial.members for stand in _start(each)]
    goals = [stand for each in partial.members for stand in _goal(each)]
    faults = [_fault(*pair, separation) for pair in _too_near(starts, separation)]
    faults += [
        _fault(*pair, separation)
        for pair in _too_near(goals, separation)
        if not (pair[0].is_start and pair[1].is_start)  # said of their starts
    ]
    return faults


def _start(member: PartialMember) -> Iterator[_Stand]:
    path, point = member.parts.points[0]
    if point is not None:
        yield from _stand(member, (*path, "at"), point, is_start=True)


def _goal(member: PartialMember) -> Iterator[_Stand]:
    if member.end is None or member.rest != "stay":
        return
    if member.parts.closed:
        yield from _stand(member, ("route", "start", "at"), member.end, is_start=True)
    else:
        path, _ = member.parts.points[-1]
        yield from _stand(member, (*path, "at"), member.end, is_start=False)


def _stand(
    member: PartialMember, path: Path, point: ViaPoint, *, is_start: bool
) -> Iterator[_Stand]:
    robot = member.parts.robot
    if robot is None:
        return
    label = "this robot" if member.name is None else f"'{member.name}'"
    x, y = point.at[:2]
    radius = robot.outer_radius + (robot.tracking_error_m or 0.0)
    yield _Stand(label, (*member.home, *path), (x, y), radius, is_start)


def _too_near(stands: Sequence[_Stand], separation: float) -> Iterator[tuple[_Stand, _Stand]]:
    """For each robot that stands too near others, the first of these and the robot itself."""
    places = np.array([stand.place for stand in stands]).reshape(-1, 2)
    radii = np.array([stand.radius for stand in stands])
    for j in range(1, len(stands)):
        gaps = np.hypot(*(places[:j] - places[j]).T) - radii[:j] - radii[j]
        near = np.flatnonzero(gaps < separation - ROUND_OFF_M)
        if near.size:
            yield stands[near[0]], stands[j]


def _fault(first: _Stand, second: _Stand, separation: float) -> UnplacedFault:
    apart = math.dist(first.place, second.place)
    needed = first.radius + second.radius + separation
    both_start = first.is_start and second.is_start  # a round ends there as well
    verb = "starts" if both_start else "stays for good"
    problem = (
        f"{second.label} {verb} {number(apart)} m from where {first.label} does: with their "
        f"bodies and separation_m {number(separation)} they have to be {number(needed)} m apart"
    )
    at_goal = [one.label for one in (first, second) if not one.is_start]
    remedy = apart_remedy(apart - first.radius - second.radius, at_goal)
    return UnplacedFault(second.path, problem, remedy)


def apart_remedy(gap: float, at_goal: Sequence[str]) -> str:
    """What would have two robots stand apart.

    Args:
        gap: Free space between them [m]; negative where their bodies overlap.
        at_goal: Which of them stay where they end.

    >>> apart_remedy(0.2504, ["'r1'"])
    "move one of them, or set separation_m to at most 0.25, or set rest: leave for 'r1'"
    """
    remedies = ["move one of them"]
    spare = math.floor((gap + ROUND_OFF_M) * 1e3) / 1e3  # rounded down, so that it is enough
    if spare >= 0.0:
        remedies.append(f"set separation_m to at most {number(spare)}")
    if at_goal:
        who = at_goal[0] if len(at_goal) == 1 else "one of them"
        remedies.append(f"set rest: leave for {who}")
    return ", or ".join(remedies)
