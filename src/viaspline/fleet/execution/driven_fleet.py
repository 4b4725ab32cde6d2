"""What is driven: courses, where they cross, the laws that were planned, and what robots can do.

Tested through ``fleet/execution/test_fleet_orders``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.patrols.driven_laps import seams_of
from viaspline.fleet.patrols.take_off_first import spans_before_laps
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.alone_laws import alone_laws
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides


@dataclass(frozen=True, eq=False)
class DrivenFleet:
    """A fleet with its plan, as it is driven.

    Attributes:
        courses: Of the robots.
        crossings: Where these come near each other.
        laws: That were planned: they say who passes first.
        rides: How each robot drives where nobody is in its way; who departs at infinity never does.
        separation: The free space that the plan keeps between bodies [m].
        rounds: How far each patrol drives in a period, again and again [m], 0 for robots that end,
            (n,); None: all end.
        lead_ins: What each drives once, before all that [m], (n,); None where nobody does.
    """

    courses: FleetCourses
    crossings: FleetCrossings
    laws: FleetLaws
    rides: PackedRides
    separation: float
    rounds: Floats | None = None
    lead_ins: Floats | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """The robots, in the order of the courses."""
        return self.courses.names

    @property
    def flies(self) -> bool:
        """Whether its robots are in space."""
        return self.courses.bodies is not None

    @property
    def lengths(self) -> Floats:
        """Of the robots' paths [m], (n,)."""
        packed = self.courses.packed
        lengths: Floats = packed.distance[packed.first[1:] - 1]
        return lengths

    @property
    def fastest(self) -> Floats:
        """The largest speed of each robot [m/s], (n,)."""
        if not self.names:
            return np.empty(0)
        first = self.courses.packed.first[:-1]
        return np.sqrt(np.maximum.reduceat(self.rides.square, first))

    def course(self, robot: int) -> tuple[Floats, Floats]:
        """Distances and places of the nodes of a robot's course [m], (m,) and (m, 2 or 3)."""
        packed = self.courses.packed
        nodes = slice(int(packed.first[robot]), int(packed.first[robot + 1]))
        return packed.distance[nodes], packed.place[nodes]

    def place_at(self, robot: int, distance: float) -> Floats:
        """Where a distance along a robot's course is [m], (2,) or (3,)."""
        along, places = self.course(robot)
        return np.array([np.interp(distance, along, row) for row in places.T])

    @cached_property
    def alone(self) -> PackedLaws:
        """The laws of robots that set out at 0 s and never wait for another."""
        return alone_laws(self.courses.packed.first, self.rides)


def driven_fleet_of(plan: FleetPlan) -> DrivenFleet:
    """What is driven of a plan: robots that are not served stay at their starts for ever.

    They have a law by which they stand there; none is driven by it.
    """
    served = np.array([name in plan.plans for name in plan.courses.names], np.bool_)
    rides, laws = plan.rides.packed, plan.laws.packed
    departs = np.where(served, rides.depart, np.inf)
    return DrivenFleet(
        plan.courses,
        plan.crossings,
        FleetLaws(laws._replace(is_timed=laws.is_timed & served)),
        rides._replace(depart=departs),
        plan.fleet.separation_m,
        *rounds_of(plan),
    )


def rounds_of(plan: FleetPlan) -> tuple[Floats | None, Floats | None]:
    """How far patrols drive in a period, and once before that [m], (n,) each; None: there are none.

    The latter is None as well where no patrol drives anything before its laps.
    """
    if plan.patrols is None:
        return None, None
    rounds, lead_ins = (np.zeros(len(plan.courses.names)) for _ in range(2))
    for name, laps in plan.patrols.laps.items():
        one = plan.plans[name]
        robot = plan.courses.names.index(name)
        seams = seams_of(one.path, one.mission.route.laps, spans_before_laps(one))
        rounds[robot], lead_ins[robot] = seams[laps] - seams[0], seams[0]
    return rounds, lead_ins if lead_ins.any() else None
