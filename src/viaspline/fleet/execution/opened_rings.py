"""Orders in which robots that stop short would wait for each other for ever, made others.

Robots in a ring come to their crossings at one time, within what they may stop short. So it is
hardly worse if one of them passes the next one before it, and not after.
"""

from __future__ import annotations

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.execution.fleet_orders import (
    FleetOrders,
    cycle_words,
    ring_of,
    stuck_in,
    times_of,
)
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.packed_orders import PackedOrders


def without_rings(
    orders: FleetOrders, departs: Floats, progress: Floats | None = None,
    fixed: Flags | None = None, promised: Floats | None = None,
) -> FleetOrders:  # fmt: skip
    """Given orders, but for some of robots that would wait for each other for ever.

    Only such orders are made others whose leader hasn't been let into the crossing.

    Args:
        orders: With all bars.
        departs: When each robot departs [s], (n,).
        progress: As for ``orders_led``.
        fixed: As there.
        promised: The farthest that each robot may take to be granted [m], (n,); nowhere if it isn't
            given.

    Raises:
        GeometryError: The orders have a cycle, and so have the others that were tried.
    """
    packed, leaders, by_second = orders.packed, orders.leaders, orders.by_second
    sets_out = np.where(np.isfinite(departs), departs, 0.0)
    stuck = stuck_in(packed, leaders, progress, fixed)
    may_go = np.zeros(len(stuck)) if promised is None else promised
    while (stuck >= 0).any():
        before = times_of(packed, leaders, sets_out, progress, fixed).reached.sum()
        best = None
        for crossing, robot in _others_first(packed, leaders, stuck, may_go):
            other = leaders.copy()
            other[crossing] = robot
            times = times_of(packed, other, sets_out, progress, fixed)
            passed, late = int(times.reached.sum()), float((times.last - sets_out).sum())
            if best is None or (-passed, late) < best[:2]:
                best = (-passed, late, other)
        if best is None or -best[0] <= before:  # no other order lets them get farther
            raise GeometryError(cycle_words(orders.names, packed, stuck))
        other = best[2]
        stuck = stuck_in(packed, other, progress, fixed)
        by_second = by_second | (other != leaders)  # bars of its own boxes are there in any case
        leaders = other
    return FleetOrders(orders.names, packed, leaders, by_second)


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
