"""Robots with paths and laws: by priority, past those that can't be timed, one of them anew.

Tested through ``fleet/test_plan_fleet``.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np

from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.fleet_ways import FleetWays, planar_plans
from viaspline.fleet.patrols.fleet_patrols import FleetPatrols
from viaspline.fleet.timing.law_search import priority_weights
from viaspline.fleet.timing.rides import goal_stays
from viaspline.fleet.timing.time_paths import Timing, standing_laws
from viaspline.fleet.timing.timed_trajectory import timed_trajectory
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.yielding_ride import CLEAR, timed_in_order
from viaspline.planner import Plan
from viaspline.trajectory.trajectory import Trajectory

NOBODY: Mapping[int, int] = MappingProxyType({})

MOST_TRIED_AGAIN = 40
"""Robots that stand at their starts and are tried once more when others do too: so many,"""
TRIED_AGAIN_BOXES = 10_000_000
"""and as many as have no more boxes of the fleet's crossings than that to look at in all."""


@dataclass(frozen=True, eq=False)
class TimedFleet:
    """Robots with paths, and when they drive along them.

    Attributes:
        ways: Their paths.
        timing: When each drives among the others.
        patrols: What never ends; None where all do.
        reasons: Why some of those that are blocked are, and what would help.
    """

    ways: FleetWays
    timing: Timing
    patrols: FleetPatrols | None = None
    reasons: Mapping[int, tuple[str, str]] = field(default_factory=dict)

    @classmethod
    def by_priority(cls, ways: FleetWays, left_out: Mapping[int, int] = NOBODY) -> TimedFleet:
        """Robots timed by priority, and by the orders that are forced.

        Args:
            ways: Their paths.
            left_out: Robots that stand at their starts, each with one that is in its way.
        """
        timing = ways.timed(sorted(left_out))
        return cls(ways, replace(timing, blocked={**timing.blocked, **left_out}))

    def with_ways(self, ways: FleetWays, robot: int) -> TimedFleet:
        """One robot timed anew, along another path, among all others as they are timed.

        Args:
            ways: In which this robot alone has another path.
            robot: Which one.
        """
        laws = standing_laws(ways.courses)
        old, new = self.ways.courses.packed.first, ways.courses.packed.first
        given = self.timing.laws.packed
        for k in range(len(ways.members)):
            if k == robot:
                continue
            was, now = slice(old[k], old[k + 1]), slice(new[k], new[k + 1])
            for one, other in zip(laws.packed[:3], given[:3], strict=True):
                one[now] = other[was]
            laws.packed.is_timed[k] = given.is_timed[k]
        packed, crossings = ways.courses.packed, ways.crossings.packed
        failed = timed_in_order(
            packed, crossings, passages_of(packed, crossings), ways.rides.packed, laws.packed,
            np.array([robot], np.int64),
        )  # fmt: skip
        blocked = {k: by for k, by in self.timing.blocked.items() if k != robot}
        if failed[0] != CLEAR:
            blocked[robot] = int(crossings.other[failed[0]])
        return replace(self, ways=ways, timing=Timing(laws, blocked))

    @property
    def blocked(self) -> tuple[str, ...]:
        """The robots that could not be timed."""
        return tuple(self.ways.courses.names[k] for k in sorted(self.timing.blocked))

    def plans(self) -> dict[str, AnyPlan]:
        """The plans of those that are timed, with their laws by the clock of the fleet, by name."""
        return {
            member.name: replace(plan, trajectory=self._trajectory(k))
            for k, (member, plan) in enumerate(zip(self.ways.members, self.ways.plans, strict=True))
            if k not in self.timing.blocked
        }

    def planar_plans(self) -> dict[str, Plan]:
        """As ``plans``, of a fleet in the plane."""
        plans = self.plans()
        return dict(zip(plans, planar_plans(tuple(plans.values())), strict=True))

    def _trajectory(self, robot: int) -> Trajectory:
        """The time law of a robot, by the clock of the fleet.

        One that keeps its pace changes its acceleration between nodes as well: where its law is
        settled, it is the very one.
        """
        ways, laws = self.ways, self.timing.laws
        settled = ways.settled.get(ways.courses.names[robot])
        if settled is not None and ways.rides.packed.keeps_pace[robot]:
            depart = float(ways.rides.packed.depart[robot])
            waits = settled.start_time - depart
            return settled.delayed(-waits).waiting(0.0, waits) if waits > 0.0 else settled
        static = ways.plans[robot].trajectory
        return timed_trajectory(static, ways.courses, ways.rides, laws, robot)

    def past_standing_ones(self, left_out: Collection[int] = ()) -> TimedFleet:
        """With those that could not be timed standing at their starts, in the way of others.

        Args:
            left_out: Those of them that are to stand there, and aren't tried once more.
        """
        blocked = dict(self.timing.blocked)
        timing = self._around(blocked)
        while timing.blocked:
            blocked |= timing.blocked
            timing = self._around(blocked)
        to_try = [k for k in blocked if k not in left_out]
        by_priority = sorted(to_try, key=lambda k: (-self.ways.members[k].priority, k))
        most = TRIED_AGAIN_BOXES // max(len(self.ways.crossings.packed.cell), 1)
        most = min(most, MOST_TRIED_AGAIN)
        for robot in by_priority[:most]:  # in whose way others stand that don't now
            fewer = {k: by for k, by in blocked.items() if k != robot}
            again = self._around(fewer)
            if not again.blocked:
                blocked, timing = fewer, again
        return replace(self, timing=replace(timing, blocked=blocked))

    def _around(self, standing: Mapping[int, int]) -> Timing:
        """All others timed by priority, round those that stand at their starts."""
        return self.ways.timed(sorted(standing))

    def improved(
        self, seconds: float, progress: Callable[[float], None] | None = None
    ) -> TimedFleet:
        """With sooner laws, for so much work [s on the reference machine]."""
        found = replace(self, timing=self.ways.improved(self.timing, seconds, progress))
        if self.patrols is None:
            return found
        last = max(found.last_arrival(), *self.patrols.begins.values())
        if last + self.patrols.period > self.patrols.planned_until:
            return self  # somebody would arrive after the laps that are laid out
        return replace(found, patrols=replace(self.patrols, repeats_from=last))

    @property
    def rank(self) -> tuple[int, float]:
        """How many have no law, and when the others arrive, weighed by priority: less is better."""
        weight = priority_weights([one.priority for one in self.ways.members])
        return self.timing.rank(self.ways.courses, weight)

    def arrivals(self) -> Floats:
        """When each robot has arrived, and stood at its goal as long as it has to [s], (n,).

        Infinite for those that have no law.
        """
        return self.timing.arrivals(self.ways.courses) + goal_stays(
            self.ways.courses, self.ways.rides
        )

    def last_arrival(self) -> float:
        """When the last robot that ends has arrived [s]; minus infinity if none is under way."""
        ends = np.array([not one.mission.route.is_patrol for one in self.ways.members], np.bool_)
        arrivals = self.arrivals()[self.timing.laws.packed.is_timed & ends]
        return float(arrivals[np.isfinite(arrivals)].max(initial=-np.inf))
