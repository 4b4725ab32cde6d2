"""The orders of a fleet under way with one robot more: only those of its own crossings are new."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.fleet.crossings import FleetCrossings, with_boxes_of
from viaspline.fleet.execution.fleet_orders import (
    FleetOrders,
    check_settled,
    drawn_orders,
    laws_order,
)
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.execution.grown_fleet import GrownFleet
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.renewed_bars import renewed_bars


def grown_orders(state: FleetProgressState, grown: GrownFleet, short: Floats) -> FleetOrders:
    """Who passes each crossing first: as it is, and where the new path crosses others by the laws.

    It isn't looked at whether that has a cycle.

    Args:
        state: Under way, without the robot.
        grown: With it and its law.
        short: As for ``orders_of``.

    Raises:
        GeometryError: The laws keep no order in a crossing.
    """
    fleet, number, planned = grown.fleet, grown.number, state.orders
    stays, was = number >= 0, state.packed.leaders
    is_new = np.ones(len(grown.fresh.robots), np.bool_)
    is_new[number[stays]] = False
    leaders, by_second = laws_order(replace(fleet, crossings=FleetCrossings(grown.fresh)))
    leaders[number[stays]] = was[stays]
    check_settled(fleet, leaders)
    by_second[number[stays]] = (was != planned.leaders)[stays] | planned.by_second[stays]
    other_bars = stays & (was != planned.leaders) & ~planned.by_second
    fresh = grown.fresh
    if other_bars.any():  # those of the robot that is the second now are to be of its own boxes
        is_new[number[other_bars]] = True
        fresh = with_boxes_of(fleet.crossings.packed, is_new)
        number = np.where(other_bars, -1, number)
    drawn = drawn_orders(replace(fleet, crossings=FleetCrossings(fresh)), leaders, by_second, short)
    kept = number >= 0
    for key in ("may_lead", "final", "most"):
        getattr(drawn.packed, key)[number[kept]] = getattr(planned.packed, key)[kept]
    return replace(drawn, packed=renewed_bars(planned.packed, number, drawn.packed))
