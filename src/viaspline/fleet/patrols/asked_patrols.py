"""Patrols that are asked for, and where others stand in their way.

Tested through ``fleet/patrols/test_timed_patrols``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.laying.rest_in_the_way import rest_in_the_way
from viaspline.fleet.laying.resting_places import rests_of
from viaspline.fleet.patrols.homes_in_the_way import PatrolMeetings
from viaspline.fleet.patrols.take_off_first import lap_of, takes_off
from viaspline.fleet.space.hover_places import hover_in_the_way, hovers_of
from viaspline.kernels.arrays import Flags
from viaspline.space.spatial_plan import SpatialPlan


@dataclass(frozen=True, eq=False)
class AskedPatrols:
    """The patrols of a fleet, among robots that end.

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
    def of(cls, ways: FleetWays, separation: float) -> AskedPatrols:
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
