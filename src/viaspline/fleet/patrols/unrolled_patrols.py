"""The laps of patrols laid out behind each other, with laws, until all others have arrived.

Tested through ``fleet/patrols/test_timed_patrols`` and
``fleet/patrols/test_patrols_that_take_off``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from viaspline.errors import GaveUpError
from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.patrols.asked_patrols import AskedPatrols
from viaspline.fleet.patrols.driven_laps import driven_laps, seams_of, write_law
from viaspline.fleet.patrols.patrol_rhythm import PatrolRhythm
from viaspline.fleet.patrols.repeated_laws import laws_in_a_row, repeated_law, set_out
from viaspline.fleet.patrols.take_off_first import (
    after_ascent,
    ascent_of,
    spans_before_laps,
    takes_off,
)
from viaspline.fleet.patrols.timed_ascents import timed_ascents
from viaspline.fleet.timing.time_paths import copied_laws
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.trajectory.trajectory import Trajectory

MOST_LAPS = 3000
"""Of all patrols together, until all others have arrived and a period after that."""
SAME_SHARE = 1e-9
"""Of a period, which is rounding."""


def unrolled(
    asked: AskedPatrols, rhythm: PatrolRhythm, later: Mapping[str, int], until: float
) -> tuple[FleetWays, dict[str, int]]:
    """The ways of a fleet with as many laps of each patrol as it takes.

    Args:
        asked: With one lap of each patrol.
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
    rounds = _rounds(rhythm, later, until)
    for name, lap in asked.laps.items():
        if name in rounds:
            laps = rhythm.laps[name]
            plans[name] = driven_laps(lap, laps * rounds[name])
            seams = seams_of(plans[name].path, laps * rounds[name])[::laps]
            law = repeated_law(rhythm.laws[name], seams, period)
            laws[name] = law.delayed(later[name] * period)
    ascents = timed_ascents(_rising(asked, plans), plans, laws, asked.separation)
    late = {
        name: math.ceil((law.end_time - laws[name].start_time) / period - SAME_SHARE)
        for name, law in ascents.items()
        if law.end_time > laws[name].start_time + SAME_SHARE * period
    }
    if late:
        postponed = {name: by + late.get(name, 0) for name, by in later.items()}
        return unrolled(asked, rhythm, postponed, until)
    whole = {
        name: _with_ascent(asked, name, plans[name]) if name in plans else plan
        for name, plan in zip(asked.names, asked.ways.plans, strict=True)
    }
    begins = {name: set_out(law).start_time for name, law in laws.items()}
    laws |= {name: _behind(ascent, laws[name]) for name, ascent in ascents.items()}
    ways = replace(asked.ways, settled=laws).along(whole, asked.separation)
    return _compared(asked, ways, rhythm, begins), dict(later)


def _rounds(rhythm: PatrolRhythm, later: Mapping[str, int], until: float) -> dict[str, int]:
    """How many periods each patrol has to drive so that it does until then [s], by name.

    Raises:
        GaveUpError: That would be too many laps.
    """
    period = rhythm.period
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
    return rounds


def _rising(
    asked: AskedPatrols, plans: Mapping[str, AnyPlan]
) -> list[tuple[FleetMember, SpatialPlan]]:
    """The patrols that take off, and their ascents."""
    each = zip(asked.ways.members, asked.ways.plans, strict=True)
    return [
        (one, ascent_of(plan))
        for one, plan in each
        if one.name in plans and isinstance(plan, SpatialPlan) and takes_off(plan)
    ]


def _with_ascent(asked: AskedPatrols, name: str, laps: AnyPlan) -> AnyPlan:
    """Several laps of a patrol, and what it flies before them."""
    laid = asked.ways.plans[asked.names.index(name)]
    if isinstance(laid, SpatialPlan) and isinstance(laps, SpatialPlan) and takes_off(laid):
        return after_ascent(laid, laps)
    return laps


def _compared(
    asked: AskedPatrols, ways: FleetWays, rhythm: PatrolRhythm, begins: Mapping[str, float]
) -> FleetWays:
    """The ways with patrols that, if they were alone, would begin each round when they do.

    Args:
        asked: With one lap of each patrol.
        ways: With all of their laps.
        rhythm: Of the patrols.
        begins: When each begins its first one [s], by name.
    """
    first, rides = ways.courses.packed.first, ways.rides
    alone, by_clock = rides.alone.copy(), FleetLaws(copied_laws(rides.laws.packed))
    for robot, name in enumerate(asked.names):
        if name not in begins:
            continue
        laps, plan = rhythm.laps[name], ways.plans[robot]
        ends = seams_of(plan.path, plan.mission.route.laps, spans_before_laps(plan))[::laps]
        begun = set_out(rhythm.rounds[name].trajectory)
        begun = begun.delayed(begins[name] - begun.start_time)
        law = repeated_law(begun, ends - ends[0], rhythm.period)
        if ends[0] > 0.0:
            laid = asked.ways.plans[robot]
            assert isinstance(laid, SpatialPlan)
            up = ascent_of(laid).trajectory
            law = _behind(up.delayed(law.start_time - up.end_time), law)
        write_law(law, ways.courses, robot, by_clock)
        by_clock.packed.arrive[first[robot]] = rides.packed.depart[robot]
        alone[robot] = law.end_time - rides.packed.depart[robot]
    return replace(ways, rides=replace(rides, alone=alone, laws=by_clock))


def _behind(ascent: Trajectory, laps: Trajectory) -> Trajectory:
    """The law of a patrol that hovers from when it has taken off until its laps begin."""
    return laws_in_a_row([ascent, laps.moved(float(ascent.distances[-1]))])
