"""Orders that delays have made foolish are swapped, and all can still arrive."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from obeying_carts import carts_of, start
from straight_drives import driven_on, timed_lines

from viaspline.fleet.execution.fleet_messages import ProgressReport
from viaspline.fleet.execution.fleet_navigator import FleetNavigator


def all_can_arrive(nav: FleetNavigator) -> bool:
    """By brute force: robots drive on in turns, as far as those before them let them."""
    orders, packed = nav._state.orders.packed, nav._state.packed
    come, count = packed.progress.copy(), len(nav.names)
    while True:
        before = come.copy()
        for robot in range(count):
            come[robot] = max(come[robot], orders.length[robot])
            for b in range(orders.first[robot], orders.first[robot + 1]):
                other = orders.other[b]
                is_open = come[other] >= orders.passed[b] if other != robot else True
                if packed.leaders[orders.crossing[b]] == other and not is_open:
                    come[robot] = max(before[robot], orders.place[b] - orders.short[robot])
                    break
        if (come == before).all():
            return bool((come >= orders.length).all())


@pytest.mark.slow
@given(seed=st.integers(0, 10_000), lost=st.floats(0.0, 0.3))
@settings(max_examples=8, deadline=None)
@example(seed=5, lost=0.0)
def test_after_each_swap_all_can_still_arrive(seed: int, lost: float) -> None:
    """Carts that stand still for a while now and then, so that orders become foolish."""
    random = np.random.default_rng(seed)
    nav = FleetNavigator.of(driven_on(timed_lines(seed, 9)), period=1.0)
    carts = carts_of(nav)
    stalled = np.zeros(len(carts))
    swaps = 0
    assert all_can_arrive(nav)
    for tick in range(400):
        time = float(tick)
        reports = [cart.report(time) for cart in carts if random.uniform() >= lost]
        commands, nav = nav.step(reports, time)
        if any(event.kind == "swapped" for event in nav.events):
            swaps += 1
            assert all_can_arrive(nav)
        for k, cart in enumerate(carts):
            if random.uniform() < 0.03 and cart.speed < 1.0:
                stalled[k] = time + random.uniform(10.0, 60.0)
            if random.uniform() >= lost:
                cart.hear(commands[cart.name])
                if time >= stalled[k]:
                    cart.drive(commands[cart.name])
                    continue
            slower = max(cart.speed - 1.0, 0.0)
            cart.place = min(cart.place + 0.5 * (cart.speed + slower), cart.holds)
            cart.speed = slower
        if nav.reached:
            break
    assert nav.reached or any(stalled > 300.0)


def test_an_order_is_swapped_when_the_first_says_that_it_stops_before_the_crossing() -> None:
    """r0 stands still before the crossing; r1 is at its bar."""
    nav = start()
    carts = {"r0": (10.0, 40.0), "r1": (0.0, 40.0)}
    commands, nav = nav.step([], 0.0)
    bar = commands["r1"].granted
    carts["r1"] = (bar, bar)
    swapped = []
    for time in np.arange(20.0, 60.0, 0.5).tolist():
        reports = [
            ProgressReport(name, time, place, holds=holds, heard=time - 0.5)
            for name, (place, holds) in carts.items()
        ]
        commands, nav = nav.step(reports, time)
        swapped += [event for event in nav.events if event.kind == "swapped"]
        if swapped:
            break
        place, _ = carts["r0"]
        carts["r0"] = (place, commands["r0"].granted)  # it takes up whatever it hears
    assert [(event.name, event.other) for event in swapped] == [("r1", "r0")]
    assert commands["r1"].granted == 40.0
    assert 17.0 <= commands["r0"].granted <= 18.0
    assert commands["r0"].waits_for == "r1"


def test_no_order_is_swapped_while_the_first_does_not_say_what_it_holds() -> None:
    nav = start()
    commands, nav = nav.step([], 0.0)
    for time in np.arange(20.0, 60.0, 0.5).tolist():
        reports = [
            ProgressReport("r0", time, 10.0),
            ProgressReport("r1", time, commands["r1"].granted),
        ]
        commands, nav = nav.step(reports, time)
        assert not [event for event in nav.events if event.kind == "swapped"]
        assert commands["r1"].waits_for == "r0"
