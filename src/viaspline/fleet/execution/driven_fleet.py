"""What is driven: courses, where they cross, the laws that were planned, and what robots can do."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides


@dataclass(frozen=True, eq=False)
class DrivenFleet:
    """A fleet with its plan, as it is driven.

    Tested through ``fleet/execution/test_fleet_orders``.

    Attributes:
        courses: Of the robots.
        crossings: Where these come near each other.
        laws: That were planned: they say who passes first.
        rides: How each robot drives where nobody is in its way.
    """

    courses: FleetCourses
    crossings: FleetCrossings
    laws: FleetLaws
    rides: PackedRides

    @property
    def names(self) -> tuple[str, ...]:
        """The robots, in the order of the courses."""
        return self.courses.names

    @property
    def lengths(self) -> Floats:
        """Of the robots' paths [m], (n,)."""
        packed = self.courses.packed
        lengths: Floats = packed.distance[packed.first[1:] - 1]
        return lengths

    def laws_alone(self) -> PackedLaws:
        """The laws of robots that set out at 0 s and never wait for another."""
        first, rides = self.courses.packed.first, self.rides
        spent = np.concatenate(([0.0], np.cumsum(rides.lasts + rides.stays)[:-1]))
        arrive = spent - np.repeat(spent[first[:-1]], np.diff(first))
        timed = np.ones(len(self.names), np.bool_)
        return PackedLaws(arrive, arrive + rides.stays, np.sqrt(rides.square), timed)
