"""How long robots stand at their stations: the navigator of a fleet counts it.

A robot isn't let beyond a station before it has stood there for as long as it has to: from the
first report that it stands there on.

Tested through ``fleet/execution/test_dwells``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.kernels.arrays import Floats, Ints

STANDS_MPS = 0.05
"""Who is no faster stands."""
NEAR_M = 1e-3
"""So much farther from a station a robot is there all the same, for rounding."""


@dataclass(frozen=True, eq=False)
class FleetStations:
    """The stations of a fleet, along the paths of its robots.

    Attributes:
        first: Of each robot, (n + 1,).
        place: Along its path [m], (k,).
        dwell: How long it has to stand there [s], (k,).
        departs: When each robot may set out [s], (n,).
    """

    first: Ints
    place: Floats
    dwell: Floats
    departs: Floats

    @classmethod
    def of(cls, fleet: DrivenFleet) -> FleetStations:
        """The stations at which the robots of a fleet have to stand for some time."""
        nodes = np.flatnonzero(fleet.rides.stays > 0.0)
        first = np.searchsorted(nodes, fleet.courses.packed.first).astype(np.int64)
        place, stays = fleet.courses.packed.distance[nodes], fleet.rides.stays[nodes]
        return cls(first, place, stays, fleet.rides.depart)

    def next_of(self, robot: int, served: int) -> int:
        """The number of a robot's next station after so many; -1: there is none."""
        station = int(self.first[robot]) + served
        return station if station < self.first[robot + 1] else -1

    def stands_until(self, state: FleetProgressState, robot: int) -> float | None:
        """When a robot may go on from the station at which it stands [s]; None: it is at none."""
        station = self.next_of(robot, int(state.stations[robot]))
        since = float(state.stands[robot])
        return since + float(self.dwell[station]) if station >= 0 and since < np.inf else None


def dwell(stations: FleetStations, state: FleetProgressState, near: float) -> None:
    """Count who stands at a station, and hold each robot before the next one that it has.

    Args:
        stations: Of the fleet.
        state: With what was reported; it is written to.
        near: How near to a station a robot stands there [m].
    """
    state.packed.halt[:] = state.stops_at
    for robot in np.flatnonzero(np.diff(stations.first)).tolist():
        while (station := stations.next_of(robot, int(state.stations[robot]))) >= 0:
            place = float(stations.place[station])
            is_there = state.places[robot] >= place - near - NEAR_M
            if is_there and state.speeds[robot] <= STANDS_MPS:
                since = max(state.heard[robot], stations.departs[robot])
                state.stands[robot] = min(state.stands[robot], since)
            if state.time < state.stands[robot] + stations.dwell[station]:
                state.packed.halt[robot] = min(state.stops_at[robot], place)
                break
            state.stations[robot] += 1
            state.stands[robot] = np.inf
