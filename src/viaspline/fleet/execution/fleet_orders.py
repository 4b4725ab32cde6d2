"""Who passes first wherever two paths of a fleet come near each other, and that this ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.handed_in import check_kind
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.crossing_bars import crossing_bars, set_bar_times
from viaspline.kernels.fleet.crossing_leaders import UNSETTLED, crossing_leaders
from viaspline.kernels.fleet.order_flow import order_flow
from viaspline.kernels.fleet.order_times import OrderTimes, order_times
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.fleet.sorted_bars import sorted_bars

END_M = 1e-9
"""So near its end a place is the end of a path."""


@dataclass(frozen=True, eq=False)
class FleetOrders:
    """The orders of a fleet: an acyclic graph of who waits for whose coming where.

    As long as every robot goes on when it may, all arrive, whatever the delays.

    Attributes:
        names: The robots.
        packed: As kernels see them.
        leaders: Who passes each crossing first, by the plan; negative: a robot in it has no law,
            (c,).
        by_second: Whether the bars of the second robot of a crossing are made from its own boxes,
            else from the leader's, (c,).
    """

    names: tuple[str, ...]
    packed: PackedOrders
    leaders: Ints
    by_second: Flags

    def sequence(self, progress: Floats | None = None) -> Ints:
        """Bars in an order in which they can be passed, (m,): all of them if there is no cycle.

        Args:
            progress: How far each robot has come [m], (n,); nowhere if it isn't given.
        """
        orders, count = self.packed, len(self.names)
        come, none = np.zeros(count) if progress is None else progress, np.zeros(count, np.bool_)
        rows, _ = order_flow(orders, self.leaders, come, orders.first[:-1].copy(), none)
        return np.concatenate([np.empty(0, np.int64), *(np.arange(*row) for row in rows.tolist())])

    def arrivals(self, begin: Floats) -> Floats:
        """When robots arrive that set out at some times [s], less what they take alone, (n,)."""
        return times_of(self.packed, self.leaders, begin).last


def index_of(names: tuple[str, ...], name: str) -> int:
    """The number of a robot.

    Raises:
        GeometryError: There is no robot of that name.
    """
    check_kind("name", name, str, "give the name of a robot")
    if name not in names:
        known = ", ".join(names[:5]) + (", …" if len(names) > 5 else "")
        raise GeometryError(f"there is no robot {name!r} in this fleet; it has {known or 'none'}")
    return names.index(name)


def orders_of(fleet: DrivenFleet, short: Floats | None = None) -> FleetOrders:
    """The orders that the laws of a fleet keep.

    Args:
        fleet: With laws that keep clear of all crossings.
        short: How far before a bar, but not before its end, each robot may stand and be believed
            to be farther back still [m], (n,); 0 if it isn't given.

    Raises:
        GeometryError: The laws keep no order in a crossing, or the orders have a cycle: each of
            some robots waits for the next one.
    """
    leaders, by_second = decided(fleet)
    return orders_led(fleet, leaders, by_second, short)


def decided(fleet: DrivenFleet) -> tuple[Ints, Flags]:
    """Who passes each crossing first by the laws of a fleet, and by whose boxes.

    Returns:
        ``leaders`` and ``by_second``, as ``orders_led`` takes them.

    Raises:
        GeometryError: The laws keep no order in a crossing.
    """
    leaders, by_second = laws_order(fleet)
    check_settled(fleet, leaders)
    return leaders, by_second


def laws_order(fleet: DrivenFleet) -> tuple[Ints, Flags]:
    """Who passes each crossing first by the laws of a fleet, and by whose boxes.

    Returns:
        ``leaders`` and ``by_second``, as ``orders_led`` takes them; a leader is ``UNSETTLED`` where
        the laws keep no order.
    """
    return crossing_leaders(fleet.courses.packed, fleet.crossings.packed, fleet.laws.packed)


def check_settled(fleet: DrivenFleet, leaders: Ints) -> None:
    """Refuse crossings in which neither robot passes first.

    Raises:
        GeometryError: There is one.
    """
    crossings = fleet.crossings
    if (leaders == UNSETTLED).any():
        c = int(np.flatnonzero(leaders == UNSETTLED)[0])
        one, two = (fleet.names[r] for r in crossings.robots[c])
        begin, end = crossings.span[c, :2]
        raise GeometryError(
            f"{one} and {two} are too near each other between {begin:.1f} m and {end:.1f} m along "
            f"the path of {one}: neither passes first; time the fleet anew"
        )


def orders_led(
    fleet: DrivenFleet, leaders: Ints, by_second: Flags, short: Floats | None = None,
    progress: Floats | None = None, fixed: Flags | None = None,
) -> FleetOrders:  # fmt: skip
    """The orders in which given robots pass each crossing first.

    Args:
        fleet: Its laws don't matter.
        leaders: Who passes each crossing first; negative: there is no order in it, (c,).
        by_second: Whether the second robot is kept away by its own boxes, else by the leader's,
            (c,).
        short: As for ``orders_of``.
        progress: How far each robot has come [m], (n,); nowhere if it isn't given. Orders that were
            swapped under way need have no cycle from there on only.
        fixed: Whether a robot never gets on any more, (n,); none if it isn't given. Those that wait
            for such a one, and who waits for them, are in no cycle for that.

    Raises:
        GeometryError: The orders have a cycle.
    """
    drawn = drawn_orders(fleet, leaders, by_second, short)
    stuck = stuck_in(drawn.packed, leaders, progress, fixed)
    if (stuck >= 0).any():
        raise GeometryError(cycle_words(fleet.names, drawn.packed, stuck))
    return drawn


def stuck_in(
    orders: PackedOrders, leaders: Ints, progress: Floats | None = None, fixed: Flags | None = None
) -> Ints:
    """The bar at which each robot is stuck that is in a cycle or behind one, or -1, (n,).

    Args:
        orders: With all bars.
        leaders: Who passes each crossing first, (c,).
        progress: As for ``orders_led``.
        fixed: As for ``orders_led``.
    """
    count = len(orders.length)
    stands = np.zeros(count, np.bool_) if fixed is None else fixed
    come = np.zeros(count) if progress is None else progress
    _, stuck = order_flow(orders, leaders, come, orders.first[:-1].copy(), stands)
    stuck[_held_up(orders, stuck, stands)] = -1
    return stuck


def times_of(
    orders: PackedOrders, leaders: Ints, begin: Floats, progress: Floats | None = None,
    fixed: Flags | None = None,
) -> OrderTimes:  # fmt: skip
    """When robots pass their bars, as far as they get.

    Args:
        orders: With all bars.
        leaders: Who passes each crossing first, (c,).
        begin: When robots set out [s], (n,).
        progress: As for ``orders_led``.
        fixed: As for ``orders_led``.
    """
    count = len(orders.length)
    stands = np.zeros(count, np.bool_) if fixed is None else fixed
    come = np.zeros(count) if progress is None else progress
    return order_times(orders, leaders, come, orders.first[:-1].copy(), stands, begin)


def _held_up(orders: PackedOrders, stuck: Ints, fixed: Flags) -> Flags:
    """Which robots never get on, or are stuck behind one that doesn't, (n,)."""
    waits = np.flatnonzero(stuck >= 0)
    ahead, held = orders.other[stuck[waits]], fixed.copy()
    while (more := waits[held[ahead] & ~held[waits]]).size:
        held[more] = True
    return held


def drawn_orders(
    fleet: DrivenFleet, leaders: Ints, by_second: Flags, short: Floats | None = None
) -> FleetOrders:
    """Orders with the bars of all crossings, which may have a cycle.

    Args:
        fleet: As for ``orders_led``, as are the others.
        leaders: As there.
        by_second: As there.
        short: As there.
    """
    courses, crossings = fleet.courses.packed, fleet.crossings.packed
    who, where = crossing_bars(courses, crossings, leaders, by_second)
    lengths, vanishes = fleet.lengths, fleet.rides.vanishes
    first, other, crossing, place, passed = sorted_bars(who, where, len(fleet.names))
    at_end = passed >= lengths[other] - END_M
    passed[at_end & vanishes[other]] = np.inf
    may_lead = np.ones((len(leaders), 2), np.bool_)
    never = (at_end & ~vanishes[other]) | (place <= 0.0)
    side = (crossings.robots[crossing, 1] == other).astype(np.int64)
    may_lead[crossing[never], side[never]] = False
    orders = PackedOrders(
        first=first,
        place=place,
        other=other,
        passed=passed,
        crossing=crossing,
        comes=np.empty(len(place)),
        other_comes=np.empty(len(place)),
        robots=crossings.robots,
        final=np.empty((len(leaders), 2)),
        most=np.empty((len(leaders), 2)),
        may_lead=may_lead,
        length=lengths,
        vanishes=vanishes,
        short=np.zeros(len(fleet.names)) if short is None else short,
    )
    set_bar_times(courses, fleet.alone, orders)
    return FleetOrders(fleet.names, orders, leaders, by_second)


def ring_of(orders: PackedOrders, stuck: Ints) -> list[int]:
    """Robots each of which waits for the next one, and the last for the first, (k,).

    Where none do, it is two: the latter has arrived, where the former wants to pass.

    Args:
        orders: With all bars.
        stuck: The bar at which each robot is stuck, or -1; some are, (n,).
    """
    robot, met = int(np.flatnonzero(stuck >= 0)[0]), list[int]()
    while robot not in met:
        met.append(robot)
        if stuck[robot] < 0:
            return met[-2:]
        robot = int(orders.other[stuck[robot]])
    return met[met.index(robot) :]


def cycle_words(names: tuple[str, ...], orders: PackedOrders, stuck: Ints) -> str:
    """Who waits for whom, and for whom that one waits, until somebody comes again."""
    words = []
    for one in ring_of(orders, stuck):
        if stuck[one] >= 0:
            bar = stuck[one]
            words.append(
                f"{names[one]} waits at {orders.place[bar]:.1f} m for {names[orders.other[bar]]} "
                f"to come to {orders.passed[bar]:.1f} m"
            )
    remedy = "time the fleet anew"
    if orders.short.any():
        remedy = f"let robots stop within less than {orders.short.max():g} m, or {remedy}"
    return "the orders have a cycle: " + ", ".join(words) + "; " + remedy
