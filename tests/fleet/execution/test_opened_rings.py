"""Robots that stop short would wait for each other for ever: one of them passes first instead."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from shapely import LineString
from straight_drives import REACH, driven_on, timed_lines

from viaspline.errors import GeometryError
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_messages import ProgressReport
from viaspline.fleet.execution.fleet_navigator import FleetNavigator
from viaspline.fleet.execution.fleet_orders import decided, drawn_orders, orders_led, orders_of
from viaspline.fleet.execution.opened_rings import without_rings


def with_a_ring(seed: int, short: float) -> tuple[DrivenFleet, np.ndarray]:
    """A fleet whose robots would wait for each other for ever, and how far they stop short."""
    fleet = driven_on(timed_lines(seed, 12))
    back = np.full(len(fleet.names), short)
    with pytest.raises(GeometryError, match="the orders have a cycle"):
        orders_of(fleet, back)
    return fleet, back


@pytest.mark.parametrize("seed", [64, 277, 296])
def test_one_robot_of_a_ring_passes_first_and_all_else_is_as_it_was(seed: int) -> None:
    fleet, back = with_a_ring(seed, 1.0)
    planned, by_second = decided(fleet)
    drawn = drawn_orders(fleet, planned, by_second, back)
    orders = without_rings(drawn, fleet.rides.depart)
    assert sorted(orders.sequence().tolist()) == list(range(orders.packed.place.size))
    (swapped,) = np.flatnonzero(orders.leaders != planned)
    assert set(fleet.crossings.packed.robots[swapped]) == {
        planned[swapped],
        orders.leaders[swapped],
    }
    # these orders are ones that anybody may give, and have no cycle if they are
    again = orders_led(fleet, orders.leaders, orders.by_second, back)
    assert again.sequence().tolist() == orders.sequence().tolist()


def test_orders_without_a_ring_stay_as_they_are() -> None:
    fleet = driven_on(timed_lines(64, 12))
    back = np.full(len(fleet.names), 0.05)
    planned, by_second = decided(fleet)
    drawn = drawn_orders(fleet, planned, by_second, back)
    kept, given = without_rings(drawn, fleet.rides.depart), orders_of(fleet, back)
    assert kept.leaders.tolist() == given.leaders.tolist() == planned.tolist()
    assert kept.sequence().tolist() == given.sequence().tolist()


def test_no_robot_is_swapped_that_has_been_let_in() -> None:
    """All of them may be anywhere on their paths already: no order can be another."""
    fleet, back = with_a_ring(64, 1.0)
    drawn = drawn_orders(fleet, *decided(fleet), back)
    with pytest.raises(GeometryError, match="the orders have a cycle"):
        without_rings(drawn, fleet.rides.depart, promised=fleet.lengths)


def test_a_navigator_tells_who_passes_first_in_place_of_whom() -> None:
    nav = FleetNavigator.of(with_a_ring(64, 1.0)[0], stops_within_m=1.0)
    assert [event.message for event in nav.events] == ["r0 passes before r4"]
    assert [event.kind for event in nav.events] == ["swapped"]
    assert nav.step([], 0.0)[1].events == ()


@given(
    seed=st.integers(0, 10_000), count=st.integers(2, 12), short=st.floats(0.05, 8.0),
    parts=st.lists(st.floats(0.0, 1.0), min_size=12, max_size=12),
)  # fmt: skip
@example(seed=64, count=8, short=5.0, parts=[1.0] * 12)
@example(seed=19, count=8, short=5.0, parts=[1.0] * 12)
@example(seed=75, count=8, short=5.0, parts=[0.5] * 12)
@settings(max_examples=15, deadline=None)
def test_robots_that_stop_short_all_arrive_and_never_come_too_near(
    seed: int, count: int, short: float, parts: list[float]
) -> None:
    """Each drives as far as it is let but for its part; between reports it may be anywhere."""
    lines = timed_lines(seed, count)
    fleet = driven_on(lines)
    try:
        nav = FleetNavigator.of(fleet, stops_within_m=short)
    except GeometryError:
        assert short > 0.5  # so far before a bar no order may be without a ring
        return
    places = dict.fromkeys(nav.names, 0.0)
    for k in range(40 * len(nav.names)):
        reports = [
            ProgressReport(name, 30.0 * k, place, arrived=place == fleet.lengths[robot])
            for robot, (name, place) in enumerate(places.items())
        ]
        commands, nav = nav.step(reports, 30.0 * k)
        if nav.reached:
            break
        stretches = []
        for robot, name in enumerate(nav.names):
            granted, before = commands[name].granted, places[name]
            is_end = granted == fleet.lengths[robot]
            places[name] = max(before, granted if is_end else granted - short * parts[robot])
            line = LineString(lines[robot])
            ends = [line.interpolate(at) for at in (before, places[name])]
            stretches.append(LineString(ends))
        for one, other in combinations(stretches, 2):
            assert one.distance(other) >= 2.0 * REACH - 1e-6
    assert nav.reached
