"""Patrols that never end and robots that do, timed together.

Patrols are timed first, in a period that is common to them all. So many of their laps are laid out
that all others arrive while they last, and a whole period in which nobody but patrols moves comes
after that. The others are timed past these laps as past robots that have their laws.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import replace

import numpy as np

from viaspline.errors import GaveUpError
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.patrols.asked_patrols import AskedPatrols
from viaspline.fleet.patrols.fleet_patrols import FleetPatrols
from viaspline.fleet.patrols.patrol_rhythm import PatrolRhythm, patrol_rhythm
from viaspline.fleet.patrols.take_off_first import on_its_laps
from viaspline.fleet.patrols.unrolled_patrols import unrolled
from viaspline.fleet.timed_fleet import TimedFleet

MOST_ROUNDS = 30
"""How often more laps are laid out, or a patrol begins later."""
MOST_EXTENSIONS = 3
"""So often a robot that finds no time between laps is let try among more of them."""
SPARE_SHARE = 1.2
"""Of the time until all others would have arrived if they were alone, for which laps are laid out
at first."""

Serve = Callable[[FleetWays, dict[int, int]], TimedFleet]
"""Times robots along their ways, but for those that stand at their starts, each with one that is in
its way."""


def timed_patrols(ways: FleetWays, separation: float, periods: int, serve: Serve) -> TimedFleet:
    """Time a fleet with patrols.

    Args:
        ways: With one lap of each patrol.
        separation: Free space between any two bodies [m].
        periods: So many of them at least come after all others have arrived.
        serve: Times those that end.

    Raises:
        GaveUpError: There would be too many laps until all others have arrived.
    """
    asked = AskedPatrols.of(ways, separation)
    out = asked.hopeless()
    while True:
        out = asked.meetings.with_passers(out)
        names = [name for k, name in enumerate(asked.names) if asked.flags[k] and k not in out]
        if not names:
            return replace(serve(ways, out), reasons=asked.reasons(out))
        try:
            rhythm = patrol_rhythm(
                [on_its_laps(one, asked.laps[one.name]) for one in ways.members
                 if one.name in names],
                {name: asked.laps[name] for name in names},
                separation,
            )  # fmt: skip
            found = _among(asked, rhythm, out, periods, serve)
        except GaveUpError as error:
            if len(error.obstacles) != 2:
                raise
            who, whom = (asked.names.index(name) for name in error.obstacles)
            out = {**out, who: whom}
            continue
        if isinstance(found, TimedFleet):
            return replace(found, reasons=asked.reasons(out))
        out = {**out, **found}


def _among(
    asked: AskedPatrols, rhythm: PatrolRhythm, out: dict[int, int], periods: int, serve: Serve
) -> TimedFleet | dict[int, int]:
    """The fleet timed past its patrols; or the patrols that can't be served, and why.

    Who starts where a patrol passes leaves before that one sets out. Where this or a later arrival
    takes more laps, all is timed anew.
    """
    period, names, rides = rhythm.period, asked.names, asked.ways.rides
    ends = (rides.packed.depart + rides.alone)[~asked.flags].max(initial=0.0)
    spare, whole = SPARE_SHARE * float(ends), periods * period
    later, extensions = dict.fromkeys(rhythm.laws, 0), 0
    before: dict[int, int] = {}
    until = max(spare, *_set_out(rhythm, later).values()) + whole
    for _ in range(MOST_ROUNDS):
        ways, later = unrolled(asked, rhythm, later, until)
        begins = _set_out(rhythm, later)
        timed = serve(ways, out)
        blocked = {robot: by for robot, by in timed.timing.blocked.items() if robot not in out}
        held = {
            patrol: robot
            for robot in blocked
            for patrol in asked.meetings.start_passed_by(robot)
            if names[patrol] in later
        }
        if held:
            soonest = float(min(rides.packed.depart[robot] for robot in blocked))
            later = _postponed(rhythm, later, {names[patrol] for patrol in held}, soonest)
            if max(later.values()) * period > spare + 2.0 * period:
                return held
            until = max(until, max(_set_out(rhythm, later).values()) + whole)
            continue
        last_out = max(begins.values())
        waits_on = [robot for robot, by in blocked.items() if names[by] in later]
        if waits_on and extensions < MOST_EXTENSIONS:  # its turn may come after the laps laid out
            extensions += 1
            until += until - last_out + whole
            continue
        last = max(timed.last_arrival(), last_out)
        if last + whole <= until:
            patrols = FleetPatrols(period, rhythm.laps, begins, last, until)
            return replace(timed, patrols=patrols)
        behind = _behind_all_laps(asked, timed, until)
        again = {robot: by for robot, by in behind.items() if robot in before}
        if again:  # there were whole periods more, and nothing was new in them
            return again
        before, until = behind, last + whole
    raise GaveUpError(
        "the robots that end don't arrive, however many laps their patrols drive",
        where=next(iter(rhythm.rounds.values())).path.stops[0][0].at,
        remedy="give patrols a number of laps",
        tried=(f"{MOST_ROUNDS} times more laps",),
    )


def _behind_all_laps(asked: AskedPatrols, timed: TimedFleet, until: float) -> dict[int, int]:
    """Robots that arrive when no laps are laid out any more, each with a patrol that it waits for.

    They find no gap between laps, and wait for these to be over, which they never are.
    """
    packed, arrivals, found = timed.ways.crossings.packed, timed.arrivals(), {}
    comes = np.isfinite(arrivals) & ~asked.flags
    for robot in np.flatnonzero(comes & (arrivals > until)).tolist():
        boxes = slice(int(packed.box_first[robot]), int(packed.box_first[robot + 1]))
        met = packed.other[boxes]
        met = met[asked.flags[met]]
        if len(met):
            found[robot] = int(np.bincount(met).argmax())
    return found


def _set_out(rhythm: PatrolRhythm, later: Mapping[str, int]) -> dict[str, float]:
    """When each patrol sets out, so many periods later than it could [s], by name."""
    return {name: law.start_time + later[name] * rhythm.period for name, law in rhythm.laws.items()}


def _postponed(
    rhythm: PatrolRhythm, later: Mapping[str, int], held: Collection[str], soonest: float
) -> dict[str, int]:
    """So many periods later each sets out where some let others leave that do so then [s]."""
    return {
        name: max(n + 1, math.floor((soonest - rhythm.laws[name].start_time) / rhythm.period))
        if name in held
        else n
        for name, n in later.items()
    }
