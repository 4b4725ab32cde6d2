"""Changes of a fleet that may let a robot be served that isn't, the least first.

Tested through ``fleet/test_unserved_fleets``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from viaspline.errors import MissionError
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.unserved.blocked_stretch import BlockedStretch
from viaspline.fleet.unserved.places_aside import place_aside
from viaspline.mission.fleet.fleet import Fleet, FleetMember

SEPARATION_SHARES = (0.5, 0.0)
"""Of the separation that is asked for, with which it is tried."""


@dataclass(frozen=True)
class FleetChange:
    """Something that may be asked for in place of what was asked.

    Attributes:
        words: What to do.
        fleet: What is asked for then.
        lays_all: Whether all paths have to be laid again for it.
    """

    words: str
    fleet: Fleet
    lays_all: bool = False


def fleet_changes(
    fleet: Fleet, timed: TimedFleet, stretches: Sequence[BlockedStretch]
) -> Iterator[FleetChange]:
    """Changes that may let a robot be served, the least first.

    Args:
        fleet: What was asked for.
        timed: What came of it.
        stretches: Where the robot and another one are in each other's way, at least one.
    """
    robot, other = stretches[0].robot, stretches[0].other
    members = timed.ways.members
    mine, its = members[robot], members[other]
    if mine.priority <= its.priority:
        above = its.priority + 1.0
        yield from _with(
            fleet, replace(mine, priority=above), f"give '{mine.name}' priority {above:g}"
        )
    yield from _departures(fleet, timed, stretches)
    for who, rests in ((its, "other_goal"), (mine, "at_goal")):
        if who.rest == "stay" and any(getattr(one, rests) for one in stretches):
            words = f"let '{who.name}' leave (rest: leave)"
            yield from _with(fleet, replace(who, rest="leave"), words, lays_all=True)
    yield from _moved(fleet, timed, stretches)
    for share in SEPARATION_SHARES:
        apart = share * fleet.separation_m
        if apart < fleet.separation_m:
            words = f"ask for a separation of {apart:g} m (separation_m)"
            yield from _fleet(fleet.members, apart, words, lays_all=True)
    rest = [one for one in fleet.members if one.name != its.name]
    yield from _fleet(rest, fleet.separation_m, f"leave '{its.name}' out", lays_all=True)


def leaving_out(fleet: Fleet, names: Sequence[str]) -> FleetChange | None:
    """The fleet without some robots; None where nothing sound is left.

    Args:
        fleet: What was asked for.
        names: Of the robots, at least one.
    """
    quoted = [f"'{name}'" for name in names]
    listed = " and ".join([", ".join(quoted[:-1]), quoted[-1]] if len(quoted) > 1 else quoted)
    members = [one for one in fleet.members if one.name not in names]
    words = f"leave {listed} out"
    return next(_fleet(members, fleet.separation_m, words, lays_all=True), None)


def _departures(
    fleet: Fleet, timed: TimedFleet, stretches: Sequence[BlockedStretch]
) -> Iterator[FleetChange]:
    """Another time at which one of the two departs."""
    robot, other = stretches[0].robot, stretches[0].other
    mine, its = timed.ways.members[robot], timed.ways.members[other]
    takes = timed.ways.rides.alone
    if its.mission.route.depart_s > 0.0 and any(one.other_start for one in stretches):
        yield from _departing(fleet, its, 0.0)
    if any(one.other_goal for one in stretches):
        yield from _departing(fleet, its, mine.mission.route.depart_s + float(takes[robot]))
    if mine.mission.route.depart_s > 0.0 and any(one.at_start for one in stretches):
        yield from _departing(fleet, mine, 0.0)
    if any(one.at_goal for one in stretches):
        yield from _departing(fleet, mine, its.mission.route.depart_s + float(takes[other]))


def _departing(fleet: Fleet, member: FleetMember, time: float) -> Iterator[FleetChange]:
    """A robot that departs at another time [s]."""
    time = round(time, 1)
    route = member.mission.route.model_copy(update={"depart_s": time})
    mission = member.mission.model_copy(update={"route": route})
    words = f"let '{member.name}' depart at {time:g} s (depart_s)"
    yield from _with(fleet, replace(member, mission=mission), words)


def _moved(
    fleet: Fleet, timed: TimedFleet, stretches: Sequence[BlockedStretch]
) -> Iterator[FleetChange]:
    """A resting place aside of the path that passes it."""
    for one in stretches:
        for who, passes, at_start, at_goal in (
            (one.other, one.robot, one.other_start, one.other_goal),
            (one.robot, one.other, one.at_start, one.at_goal),
        ):
            member = timed.ways.members[who]
            route = member.mission.route
            if at_start or (at_goal and route.closed):
                key, place = "start", route.start.at[:2]
            elif at_goal and route.goal is not None:
                key, place = "goal", route.goal.at[:2]
            else:
                continue
            there = place_aside(timed, passes, who, (place[0], place[1]))
            if there is None:
                continue
            end = getattr(route, key).model_copy(update={"at": there})
            mission = member.mission.model_copy(
                update={"route": route.model_copy(update={key: end})}
            )
            x, y = there
            words = f"move the {key} of '{member.name}' to ({x:.1f}, {y:.1f})"
            yield from _with(fleet, replace(member, mission=mission), words, lays_all=True)


def _with(
    fleet: Fleet, changed: FleetMember, words: str, *, lays_all: bool = False
) -> Iterator[FleetChange]:
    """The fleet with one robot asked for otherwise."""
    members = [changed if one.name == changed.name else one for one in fleet.members]
    yield from _fleet(members, fleet.separation_m, words, lays_all=lays_all)


def _fleet(
    members: Sequence[FleetMember], separation: float, words: str, *, lays_all: bool
) -> Iterator[FleetChange]:
    """A fleet of robots, if it is sound."""
    try:
        yield FleetChange(words, Fleet.of(members, separation), lays_all)
    except MissionError:
        return
