"""What each robot of a fleet is to do, from how far it may go.

Tested through ``fleet/execution/test_fleet_navigator``.
"""

from __future__ import annotations

import numpy as np

from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.dwells import FleetStations
from viaspline.fleet.execution.fleet_messages import FleetCommand
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.dispatching import states_ahead

ROUNDING_M = 1e-9
"""A place that is so little beyond a grant is where that ends [m]."""


def commands_of(
    fleet: DrivenFleet, stations: FleetStations, state: FleetProgressState, grants: Floats,
    period: float,
) -> dict[str, FleetCommand]:  # fmt: skip
    """A command for each robot that drives, by name.

    Args:
        fleet: What is driven.
        stations: Its stations.
        state: How far it has come.
        grants: How far each robot may go [m], (n,).
        period: Until the next step [s].
    """
    orders, packed, commands = state.orders.packed, state.packed, {}
    rides = fleet.rides._replace(stays=np.zeros_like(fleet.rides.stays))  # grants end at stations
    places, speeds = states_ahead(
        fleet.courses.packed, rides, packed.progress, state.speeds, grants, period
    )
    beyond = places - grants
    places = np.where((beyond > 0.0) & (beyond < ROUNDING_M), grants, places)
    sets_out = fleet.rides.depart < state.time + period
    for robot, name in enumerate(fleet.names):
        if state.out[robot]:
            continue
        bar, recall = int(packed.head[robot]), int(packed.recall[robot])
        waits, opens = None, None
        if recall >= 0:
            one, two = orders.robots[recall].tolist()
            waits = fleet.names[two if one == robot else one]
        elif bar < orders.first[robot + 1] and orders.place[bar] <= grants[robot]:
            other = int(orders.other[bar])
            waits, opens = fleet.names[other], float(orders.passed[bar] + state.driven[other])
        commands[name] = FleetCommand(
            name=name,
            time=state.time,
            granted=float(grants[robot] + state.driven[robot]),
            distance=float(places[robot] + state.driven[robot]) if sets_out[robot] else 0.0,
            speed=float(speeds[robot]) if sets_out[robot] else 0.0,
            waits_for=waits,
            opens_at=opens,
            arrived=bool(state.arrived[robot]),
            stands_until=stations.stands_until(state, robot),
            path=int(state.paths[robot]),
        )
    return commands
