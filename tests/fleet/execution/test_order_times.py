"""When robots pass their bars, by an oracle that looks at every bar of every robot."""

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st
from straight_drives import driven_on, timed_lines
from test_grown_orders import under_way

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.order_flow import order_flow
from viaspline.kernels.fleet.order_times import OrderTimes, order_times
from viaspline.kernels.fleet.packed_orders import PackedOrders


def looked_at(
    orders: PackedOrders, leaders: Ints, progress: Floats, head: Ints, fixed: Flags, begin: Floats
) -> tuple[Ints, Floats, Floats]:
    """How far robots get, when they would have set out to pass each bar, and to get there."""
    reached, come, last = head.copy(), progress.copy(), begin.copy()
    shift = np.full(len(orders.place), np.inf)
    moves = True
    while moves:
        moves = False
        for robot in np.flatnonzero(~fixed):
            end = orders.first[robot + 1]
            while reached[robot] < end:
                b = reached[robot]
                other = orders.other[b]
                if leaders[orders.crossing[b]] == other:
                    if come[other] < orders.passed[b]:
                        break
                    low = orders.first[other]
                    passed = min(orders.passed[b], orders.length[other])
                    places = orders.place[low : orders.first[other + 1]]
                    before = low + np.searchsorted(places, passed) - 1
                    earlier = begin[other] if before < head[other] else shift[before]
                    then = earlier + orders.other_comes[b] - orders.comes[b]
                    last[robot] = max(last[robot], then)
                shift[b] = last[robot]
                reached[robot], moves = b + 1, True
            ends = np.inf if orders.vanishes[robot] else orders.length[robot]
            if reached[robot] < end:
                ends = orders.place[reached[robot]] - orders.short[robot]
            moves |= ends > come[robot]
            come[robot] = max(come[robot], ends)
    return reached, shift, last


def shifts_of(times: OrderTimes, head: Ints, robot: int, orders: PackedOrders) -> Floats:
    """When a robot would have set out to pass each bar from its head on."""
    bars = np.arange(head[robot], orders.first[robot + 1])
    found = np.full(len(bars), times.begin[robot])
    delays, at = [], times.final[robot]
    while at >= 0:
        delays.append(at)
        at = times.bars[at, 1]
    for at in reversed(delays):
        found[bars >= times.bars[at, 0]] = times.delays[at, 1]
    found[bars >= times.reached[robot]] = np.inf
    return found


@given(
    seed=st.integers(0, 2_000), steps=st.integers(1, 30), by_leader=st.booleans(),
    dead=st.sampled_from([(), (0,), (1, 4)]),
)  # fmt: skip
@example(seed=3, steps=14, by_leader=True, dead=())  # with orders that were swapped
@example(seed=8, steps=6, by_leader=False, dead=(2,))
@settings(max_examples=20, deadline=None)
def test_they_are_those_of_all_bars_looked_at_one_by_one(
    seed: int, steps: int, by_leader: bool, dead: tuple[int, ...]
) -> None:
    fleet = driven_on(timed_lines(seed, 10))
    state = under_way(fleet, steps, seed, by_leader)
    orders, packed = state.orders.packed, state.packed
    fixed = np.isin(np.arange(len(fleet.names)), dead)
    given_ones = (packed.leaders, packed.progress, packed.head, fixed, packed.begin)
    times = order_times(orders, *given_ones)
    reached, shift, last = looked_at(orders, *given_ones)
    assert times.reached.tolist() == reached.tolist()
    assert times.last.tolist() == last.tolist()
    for robot in range(len(fleet.names)):
        own = slice(packed.head[robot], orders.first[robot + 1])
        assert shifts_of(times, packed.head, robot, orders).tolist() == shift[own].tolist()
    is_stuck = (reached < orders.first[1:]) & ~fixed
    assert times.stuck.tolist() == np.where(is_stuck, reached, -1).tolist()
    rows, stuck = order_flow(orders, *given_ones[:4])
    assert stuck.tolist() == times.stuck.tolist()
    passed = np.concatenate([np.empty(0, np.int64), *(np.arange(*row) for row in rows)])
    assert sorted(passed) == [
        b for r in range(len(reached)) for b in range(packed.head[r], reached[r])
    ]
