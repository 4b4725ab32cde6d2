"""Patrols that never end and robots that do, timed together.

Patrols are timed first, in a period that is common to them all. So many of their laps are laid out
that all others arrive while they last, and a whole period in which nobody but patrols moves comes
after that. The others are timed past these laps as past robots that have their laws.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from viaspline.errors import GaveUpError
from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.laying.rest_in_the_way import rest_in_the_way
from viaspline.fleet.laying.resting_places import rests_of
from viaspline.fleet.patrols.driven_laps import (
    driven_laps,
    laws_in_a_row,
    repeated_law,
    seams_of,
    set_out,
    write_law,
)
from viaspline.fleet.patrols.fleet_patrols import FleetPatrols
from viaspline.fleet.patrols.homes_in_the_way import PatrolMeetings
from viaspline.fleet.patrols.patrol_rhythm import PatrolRhythm, patrol_rhythm
from viaspline.fleet.patrols.take_off_first import (
    after_ascent,
    ascent_of,
    lap_of,
    on_its_laps,
    spans_before_laps,
    takes_off,
)
from viaspline.fleet.patrols.timed_ascents import timed_ascents
from viaspline.fleet.space.hover_places import hover_in_the_way, hovers_of
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.timing.time_paths import copied_laws
from viaspline.kernels.arrays import Flags
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.trajectory.trajectory import Trajectory

MOST_LAPS = 3000
"""Of all patrols together, until all others have arrived and a period after that."""
MOST_ROUNDS = 30
"""How often more laps are laid out, or a patrol begins later."""
MOST_EXTENSIONS = 3
"""So often a robot that finds no time between laps is let try among twice as many."""
SPARE_SHARE = 1.2
"""Of the time until all others would have arrived if they were alone, for which laps are laid out
at first."""

SAME_SHARE = 1e-9
"""Of a period, which is rounding."""

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
    asked = _AskedPatrols.of(ways, separation)
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


@dataclass(frozen=True, eq=False)
class _AskedPatrols:
    """What is timed.

    Attributes:
        ways: With one lap of each patrol.
        separation: Free space between any two bodies [m].
        flags: Which robots are patrols, (n,).
        laps: One lap of each patrol, without what it flies before the first, by name.
        meetings: Where patrols pass places at which others stand.
    """

    ways: FleetWays
    separation: float
    flags: Flags
    laps: Mapping[str, AnyPlan]
    meetings: PatrolMeetings

    @classmethod
    def of(cls, ways: FleetWays, separation: float) -> _AskedPatrols:
        """The patrols among some robots."""
        flags = np.array([one.mission.route.is_patrol for one in ways.members], np.bool_)
        vanishes = ways.rides.packed.vanishes
        rise = np.array([takes_off(one) for one in ways.plans], np.bool_) & flags
        meetings = PatrolMeetings.of(ways.courses, ways.crossings, vanishes, flags, rise)
        each = zip(ways.courses.names, ways.plans, flags.tolist(), strict=True)
        laps = {name: lap_of(plan) for name, plan, is_patrol in each if is_patrol}
        return cls(ways, separation, flags, laps, meetings)

    @property
    def names(self) -> tuple[str, ...]:
        """The robots that have a path."""
        return self.ways.courses.names

    def hopeless(self) -> dict[int, int]:
        """See ``PatrolMeetings.hopeless``."""
        return self.meetings.hopeless(self.flags)

    def unrolled(
        self, rhythm: PatrolRhythm, later: Mapping[str, int], until: float
    ) -> tuple[FleetWays, dict[str, int]]:
        """The ways with as many laps of each patrol as it takes.

        Args:
            rhythm: Of the patrols.
            later: So many periods later than it could each sets out, by name.
            until: The laps last until then at least [s].

        Returns:
            The ways; and so many periods later each sets out, more where one can't have taken off
            by then.

        Raises:
            GaveUpError: There would be too many laps.
        """
        period, plans, laws = rhythm.period, {}, {}
        rounds = {
            name: max(math.ceil((until - law.start_time) / period - later[name] - SAME_SHARE), 1)
            for name, law in rhythm.laws.items()
        }
        most = max(rounds, key=lambda name: rounds[name] * rhythm.laps[name])
        if sum(rounds[name] * rhythm.laps[name] for name in rounds) > MOST_LAPS:
            raise GaveUpError(
                f"'{most}' would drive {rounds[most] * rhythm.laps[most]} laps until all others "
                "have arrived",
                where=rhythm.rounds[most].path.stops[0][0].at,
                remedy=f"let '{most}' drive a longer lap, or the others depart sooner",
                tried=("laps laid out until all others have arrived",),
            )
        for name, lap in self.laps.items():
            if name in rounds:
                laps = rhythm.laps[name]
                plans[name] = driven_laps(lap, laps * rounds[name])
                seams = seams_of(plans[name].path, laps * rounds[name])[::laps]
                law = repeated_law(rhythm.laws[name], seams, period)
                laws[name] = law.delayed(later[name] * period)
        ascents = timed_ascents(self._rising(plans), plans, laws, self.separation)
        late = {
            name: math.ceil((law.end_time - laws[name].start_time) / period - SAME_SHARE)
            for name, law in ascents.items()
            if law.end_time > laws[name].start_time + SAME_SHARE * period
        }
        if late:
            return self.unrolled(rhythm, {n: by + late.get(n, 0) for n, by in later.items()}, until)
        whole = {
            name: self._with_ascent(name, plans[name]) if name in plans else plan
            for name, plan in zip(self.names, self.ways.plans, strict=True)
        }
        begins = {name: set_out(law).start_time for name, law in laws.items()}
        laws |= {name: _behind(ascent, laws[name]) for name, ascent in ascents.items()}
        ways = replace(self.ways, settled=laws).along(whole, self.separation)
        return self._compared(ways, rhythm, begins), dict(later)

    def _rising(self, plans: Mapping[str, AnyPlan]) -> list[tuple[FleetMember, SpatialPlan]]:
        """The patrols that take off, and their ascents."""
        each = zip(self.ways.members, self.ways.plans, strict=True)
        return [
            (one, ascent_of(plan))
            for one, plan in each
            if one.name in plans and isinstance(plan, SpatialPlan) and takes_off(plan)
        ]

    def _with_ascent(self, name: str, laps: AnyPlan) -> AnyPlan:
        """Several laps of a patrol, and what it flies before them."""
        laid = self.ways.plans[self.names.index(name)]
        if isinstance(laid, SpatialPlan) and isinstance(laps, SpatialPlan) and takes_off(laid):
            return after_ascent(laid, laps)
        return laps

    def _compared(
        self, ways: FleetWays, rhythm: PatrolRhythm, begins: Mapping[str, float]
    ) -> FleetWays:
        """The ways with patrols that, if they were alone, would begin each round when they do.

        Args:
            ways: With all of their laps.
            rhythm: Of the patrols.
            begins: When each begins its first one [s], by name.
        """
        first, rides = ways.courses.packed.first, ways.rides
        alone, by_clock = rides.alone.copy(), FleetLaws(copied_laws(rides.laws.packed))
        for robot, name in enumerate(self.names):
            if name not in begins:
                continue
            laps, plan = rhythm.laps[name], ways.plans[robot]
            ends = seams_of(plan.path, plan.mission.route.laps, spans_before_laps(plan))[::laps]
            begun = rhythm.rounds[name].trajectory
            begun = begun.delayed(begins[name] - begun.start_time)
            law = repeated_law(begun, ends - ends[0], rhythm.period)
            if ends[0] > 0.0:
                laid = self.ways.plans[robot]
                assert isinstance(laid, SpatialPlan)
                up = ascent_of(laid).trajectory
                law = _behind(up.delayed(law.start_time - up.end_time), law)
            write_law(law, ways.courses, robot, by_clock)
            by_clock.packed.arrive[first[robot]] = rides.packed.depart[robot]
            alone[robot] = law.end_time - rides.packed.depart[robot]
        return replace(ways, rides=replace(rides, alone=alone, laws=by_clock))

    def reasons(self, out: dict[int, int]) -> dict[int, tuple[str, str]]:
        """Why robots aren't served, and what would help, where a place is in the way."""
        found = {}
        for robot, other in out.items():
            passer, stands = (robot, other) if self.flags[robot] else (other, robot)
            is_start = [passer, stands] in self.meetings.starts.tolist()
            if not is_start and [passer, stands] not in self.meetings.goals.tolist():
                continue
            found[robot] = _, remedy = self._in_the_way(passer, stands, is_start=is_start)
            if self.flags[stands]:
                name, (_, _, aside) = self.names[stands], remedy.partition(", or ")
                found[robot] = (
                    f"'{name}' comes back to its start every lap, where '{self.names[passer]}' "
                    "has to pass",
                    f"let '{name}' {aside or 'start elsewhere'}",
                )
        return found

    def _in_the_way(self, passer: int, stands: int, *, is_start: bool) -> tuple[str, str]:
        """Why one robot can't get past the place where another rests, and what would let it."""
        name, plan, member = self.names[passer], self.ways.plans[passer], self.ways.members[stands]
        if isinstance(plan, SpatialPlan):
            its = self.ways.plans[stands]
            assert isinstance(its, SpatialPlan)
            hovers = list(hovers_of(member, its))
            return hover_in_the_way(name, plan, hovers[0 if is_start else -1])
        rests = list(rests_of(member, self._reach(stands)))
        return rest_in_the_way(name, plan, rests[0 if is_start else -1], self._reach(passer))

    def _reach(self, robot: int) -> float:
        return float(self.ways.courses.packed.reach[robot])


def _behind(ascent: Trajectory, laps: Trajectory) -> Trajectory:
    """The law of a patrol that hovers from when it has taken off until its laps begin."""
    return laws_in_a_row([ascent, laps.moved(float(ascent.distances[-1]))])


def _among(
    asked: _AskedPatrols, rhythm: PatrolRhythm, out: dict[int, int], periods: int, serve: Serve
) -> TimedFleet | dict[int, int]:
    """The fleet timed past its patrols; or the patrols that can't be served, and why.

    Who starts where a patrol passes leaves before that one sets out. Where this or a later arrival
    takes more laps, all is timed anew.
    """
    period, names = rhythm.period, asked.names
    later = dict.fromkeys(rhythm.laws, 0)
    rides = asked.ways.rides
    ends = (rides.packed.depart + rides.alone)[~asked.flags].max(initial=0.0)
    begins = max(law.start_time for law in rhythm.laws.values())
    until = max(SPARE_SHARE * float(ends), begins) + periods * period
    extensions = 0
    for _ in range(MOST_ROUNDS):
        ways, later = asked.unrolled(rhythm, later, until)
        begins = max(law.start_time + later[n] * period for n, law in rhythm.laws.items())
        timed = serve(ways, out)
        blocked = {robot: by for robot, by in timed.timing.blocked.items() if robot not in out}
        held = {
            names[patrol]
            for robot in blocked
            for patrol in asked.meetings.start_passed_by(robot)
            if names[patrol] in later
        }
        if held:
            soonest = float(min(rides.packed.depart[robot] for robot in blocked))
            later = {
                name: max(n + 1, math.floor((soonest - rhythm.laws[name].start_time) / period))
                if name in held
                else n
                for name, n in later.items()
            }
            begins = max(law.start_time + later[n] * period for n, law in rhythm.laws.items())
            until = max(until, begins + periods * period)
            if max(later.values()) * period > SPARE_SHARE * float(ends) + 2.0 * period:
                return {
                    names.index(name): robot
                    for robot in blocked
                    for name in held
                    if names.index(name) in asked.meetings.start_passed_by(robot)
                }
            continue
        waits_on = [robot for robot, by in blocked.items() if names[by] in later]
        if waits_on and extensions < MOST_EXTENSIONS:  # its turn may come after the laps laid out
            extensions += 1
            until += until - begins + periods * period
            continue
        last = max(timed.last_arrival(), begins)
        if last + periods * period <= until:
            laps = FleetPatrols(
                period,
                rhythm.laps,
                {n: law.start_time + later[n] * period for n, law in rhythm.laws.items()},
                last,
                until,
            )
            return replace(timed, patrols=laps)
        until = last + periods * period
    raise GaveUpError(
        "the robots that end don't arrive, however many laps their patrols drive",
        where=next(iter(rhythm.rounds.values())).path.stops[0][0].at,
        remedy="give patrols a number of laps",
        tried=(f"{MOST_ROUNDS} times more laps",),
    )
