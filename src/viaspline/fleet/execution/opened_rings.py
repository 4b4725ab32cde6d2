"""Orders in which robots that stop short would wait for each other for ever, made others.

Robots in a ring come to their crossings at one time, within what they may stop short. So it is
hardly worse if one of them passes the next one before it, and not after.
"""

from __future__ import annotations

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_orders import (
    FleetOrders,
    cycle_words,
    flow_of,
    packed_orders,
    ring_of,
)
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.order_flow import expected_shifts
from viaspline.kernels.fleet.packed_orders import PackedOrders


def orders_without_rings(
    fleet: DrivenFleet, leaders: Ints, by_second: Flags, short: Floats,
    progress: Floats | None = None, fixed: Flags | None = None, promised: Floats | None = None,
) -> FleetOrders:  # fmt: skip
    """Given orders, but for some of robots that would wait for each other for ever.

    Only such orders are made others whose leader hasn't been let into the crossing.

    Args:
        fleet: Its laws don't matter.
        leaders: As for ``orders_led``, as are all but the last.
        by_second: As there.
        short: As there.
        progress: As there.
        fixed: As there.
        promised: The farthest that each robot may take to be granted [m], (n,); nowhere if it isn't
            given.

    Raises:
        GeometryError: The orders have a cycle, and so have the others that were tried.
    """
    packed = packed_orders(fleet, leaders, by_second, short)
    sequence, stuck = flow_of(packed, leaders, progress, fixed)
    while (stuck >= 0).any():
        may_go = np.zeros(len(stuck)) if promised is None else promised
        best = None
        for crossing, robot in _others_first(packed, leaders, stuck, may_go):
            other = leaders.copy()
            other[crossing] = robot
            passed, left = flow_of(packed, other, progress, fixed)
            late = _lateness(packed, other, passed, fleet.rides.depart)
            if best is None or (-len(passed), late) < best[:2]:
                best = (-len(passed), late, other, passed, left)
        if best is None or len(best[3]) <= len(sequence):  # no other order lets them get farther
            raise GeometryError(cycle_words(fleet.names, packed, stuck))
        _, _, other, sequence, stuck = best
        by_second = by_second | (other != leaders)  # bars of its own boxes are there in any case
        leaders = other
    return FleetOrders(fleet.names, packed, leaders, by_second, sequence)


def _others_first(
    orders: PackedOrders, leaders: Ints, stuck: Ints, promised: Floats
) -> list[tuple[int, int]]:
    """Crossings of a ring, and who may pass each of them first in place of the one that does."""
    found = []
    for robot in ring_of(orders, stuck):
        bar = int(stuck[robot])
        if bar < 0:
            continue
        crossing, leader = int(orders.crossing[bar]), int(orders.other[bar])
        side = 0 if orders.robots[crossing, 0] == robot else 1
        own = slice(int(orders.first[leader]), int(orders.first[leader + 1]))
        entry = orders.place[own][orders.crossing[own] == crossing]
        is_out = entry.size > 0 and promised[leader] <= entry[0]
        if is_out and orders.may_lead[crossing, side]:
            found.append((crossing, robot))
    return found


def _lateness(orders: PackedOrders, leaders: Ints, sequence: Ints, begin: Floats) -> float:
    """How much later than alone all robots get as far as they do, together [s]."""
    sets_out = np.where(np.isfinite(begin), begin, 0.0)
    last = expected_shifts(orders, leaders, sequence, orders.first[:-1].copy(), sets_out)[1]
    return float((last - sets_out).sum())
