"""A fleet in a few words; light enough for ``viaspline check``.

Tested through ``report/files/test_fleet_results``.
"""

from __future__ import annotations

import math
from collections import Counter
from itertools import pairwise
from typing import Final

from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.route_spec import Route
from viaspline.report.remarks import FOLLOWED_EXACTLY, keeps_nothing, remarks
from viaspline.report.summary import counted, robot_words, world_words
from viaspline.report.units import metres

MAX_KINDS_NAMED: Final = 6
"""How many kinds of robots are told one by one."""

UNUSED_SENSOR: Final = (
    "a kind of robot has a sensor, but a fleet is planned on what is known: its robots go round "
    "nothing else"
)


def fleet_summary(fleet: Fleet) -> list[tuple[str, str]]:
    """Robots, kinds, separation, rounds and world: what each of them is, on one line."""
    members = fleet.members
    lengths = [_straight(one.mission.route) for one in members]
    rounds = f"{metres(sum(lengths) / len(lengths), 1)} from point to point in the mean"
    if min(lengths) < max(lengths):
        rounds += f", {metres(min(lengths), 1)} to {metres(max(lengths), 1)}"
    return [
        ("robots", _robots(members)),
        *_kinds(fleet),
        ("apart", f"{fleet.separation_m:g} m between any two bodies"),
        ("rounds", rounds),
        ("world", world_words(fleet.world)),
    ]


def fleet_remarks(fleet: Fleet) -> list[str]:
    """What is sound in a fleet, but may not be what was meant; each once."""
    used = {one.robot for one in fleet.fleet}
    found = [
        f"no robot is of the kind '{name}'"
        for name in fleet.robots
        if name not in used and not (None in used and len(fleet.robots) == 1)
    ]
    firsts: dict[str, FleetMember] = {}
    for one, member in zip(fleet.fleet, fleet.members, strict=True):
        firsts.setdefault(one.robot or member.name, member)
    found += (words for member in firsts.values() for words in remarks(member.mission))
    if any(member.mission.robot.sensor is not None for member in firsts.values()):
        found.append(UNUSED_SENSOR)
    return list(dict.fromkeys(found))


def fleet_plan_remarks(fleet: Fleet) -> list[str]:
    """What to know of a fleet's plan that it doesn't say itself."""
    followed = any(keeps_nothing(one.mission.robot) for one in fleet.members)
    return [FOLLOWED_EXACTLY] if followed else []


def _robots(members: tuple[FleetMember, ...]) -> str:
    words = [counted(len(members), "robot")]
    endless = sum(one.mission.route.is_patrol for one in members)
    closed = sum(one.mission.route.closed for one in members) - endless
    leaving = sum(one.rest == "leave" for one in members)
    late = sum(one.mission.route.depart_s > 0.0 for one in members)
    told = (
        (endless, "on patrols that never end"),
        (closed, "on closed rounds"),
        (leaving, "leaving at the goal"),
        (late, "departing later"),
    )
    return ", ".join([*words, *(f"{many} {what}" for many, what in told if many)])


def _kinds(fleet: Fleet) -> list[tuple[str, str]]:
    """A line for each kind that is used; the first one has the title."""
    used = Counter(_kind_name(fleet, one.robot, one.mission) for one in fleet.fleet)
    lines = []
    for name, many in list(used.items())[:MAX_KINDS_NAMED]:
        robot = fleet.robots.get(name)
        words = "" if robot is None else f": {robot_words(robot)}"
        lines.append(f"{name} ({many}){words}")
    if len(used) > MAX_KINDS_NAMED:
        lines.append(f"… and {len(used) - MAX_KINDS_NAMED} more")
    return [("kinds" if i == 0 else "", line) for i, line in enumerate(lines)]


def _kind_name(fleet: Fleet, name: str | None, mission: str | None) -> str:
    if name is not None:
        return name
    if mission is None and len(fleet.robots) == 1:
        return next(iter(fleet.robots))
    return "of missions of their own" if mission is not None else "of the defaults"


def _straight(route: Route) -> float:
    """How long a route is from point to point, seen from above, all laps [m]."""
    places = [point.at[:2] for _, point in route.points()]
    if route.land is not None:
        places.append(route.land.at)
    if route.closed:
        places.append(places[0])
    return route.laps * sum(math.dist(a, b) for a, b in pairwise(places))
