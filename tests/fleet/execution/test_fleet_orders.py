"""Orders of fleets: who passes first, where the other one waits, and that it comes to an end."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from straight_drives import CROSS, driven_on, timed_lines

import viaspline as vs
from viaspline.errors import GeometryError
from viaspline.fleet.execution.fleet_orders import orders_led, orders_of
from viaspline.fleet.fleet_laws import FleetLaws


def test_the_second_waits_before_the_crossing_until_the_first_has_left_it() -> None:
    for order in ([0, 1], [1, 0]):
        orders = orders_of(driven_on(CROSS, order))
        first, second = order
        assert orders.leaders.tolist() == [first]
        packed = orders.packed
        bars = slice(packed.first[second], packed.first[second + 1])
        assert (packed.other[bars] == first).all()
        # discs of 1 m touch where their centres are 2 m apart; cells are 0.5 m long
        assert 17.0 <= packed.place[bars][0] <= 18.0
        assert 22.0 <= packed.passed[bars][-1] <= 23.0
        assert (np.diff(packed.place[bars]) >= 0.0).all()
        assert (np.diff(packed.passed[bars]) > 0.0).all()


def test_orders_are_those_of_who_is_there_first_by_the_laws() -> None:
    lines = timed_lines(3, 9)
    fleet = driven_on(lines)
    courses, laws, robots = fleet.courses.packed, fleet.laws.packed, fleet.crossings.packed.robots
    orders = orders_of(fleet)
    assert len(robots) > 3
    for c, pair in enumerate(robots):
        middle = fleet.crossings.packed.span[c].reshape(2, 2).mean(axis=1)
        times = []
        for robot, place in zip(pair, middle, strict=True):
            nodes = slice(courses.first[robot], courses.first[robot + 1])
            times.append(np.interp(place, courses.distance[nodes], laws.arrive[nodes]))
        assert orders.leaders[c] == pair[int(np.argmin(times))]


def test_a_ring_of_robots_that_wait_for_each_other_is_named() -> None:
    """Three streets in a triangle: each robot would let the one pass that lets the next one."""
    lines = [((0.0, 0.0), (40.0, 0.0)), ((36.0, -8.0), (12.0, 34.0)), ((28.0, 34.0), (4.0, -8.0))]
    fleet = driven_on(lines)
    robots = fleet.crossings.packed.robots.tolist()
    assert robots == [[0, 1], [0, 2], [1, 2]]
    own = np.ones(3, np.bool_)
    # each of them comes to the street of the one that is to pass before it first
    rings = [np.array(ring) for ring in ([0, 2, 1], [1, 0, 2])]
    refused = []
    for ring in rings:
        try:
            orders_led(fleet, ring, own)
        except GeometryError as error:
            refused.append(str(error))
    assert len(refused) == 1
    assert re.fullmatch(
        r"the orders have a cycle: (r\d waits at \d+\.\d m for r\d to come to \d+\.\d m, ){2}"
        r"r\d waits .*; time the fleet anew",
        refused[0],
    )


def test_a_ring_that_one_robot_has_left_is_none_any_more() -> None:
    """So it is with orders that were swapped under way: from the start on they may have a cycle."""
    lines = [((0.0, 0.0), (40.0, 0.0)), ((36.0, -8.0), (12.0, 34.0)), ((28.0, 34.0), (4.0, -8.0))]
    fleet, own = driven_on(lines), np.ones(3, np.bool_)
    for ring in (np.array([0, 2, 1]), np.array([1, 0, 2])):
        come = np.array([40.0, 0.0, 0.0])
        orders = orders_led(fleet, ring, own, progress=come)
        assert sorted(orders.sequence(come).tolist()) == list(range(orders.packed.place.size))
        short = np.full(3, 0.05)
        assert orders_led(fleet, ring, own, short, come).packed.short[0] > 0.0


def test_a_ring_with_a_robot_that_never_gets_on_is_none() -> None:
    """The others wait for that one, and not for each other; without it all do."""
    lines = [((0.0, 0.0), (40.0, 0.0)), ((36.0, -8.0), (12.0, 34.0)), ((28.0, 34.0), (4.0, -8.0))]
    fleet, own = driven_on(lines), np.ones(3, np.bool_)
    for ring in (np.array([0, 2, 1]), np.array([1, 0, 2])):
        for dead in range(3):
            orders = orders_led(fleet, ring, own, fixed=np.arange(3) == dead)
            assert orders.leaders.tolist() == ring.tolist()


def test_laws_that_meet_keep_no_order() -> None:
    fleet = driven_on(CROSS)
    alone = FleetLaws(fleet.alone)
    with pytest.raises(GeometryError, match=r"r0 and r1 are too near each other between 1[78]\.\d"):
        orders_of(replace(fleet, laws=alone))


@pytest.mark.slow
@given(seed=st.integers(0, 10_000), count=st.integers(1, 12))
@settings(max_examples=25, deadline=None)
def test_orders_of_laws_that_keep_apart_are_acyclic(seed: int, count: int) -> None:
    fleet = driven_on(timed_lines(seed, count))
    orders = orders_of(fleet)
    assert sorted(orders.sequence().tolist()) == list(range(orders.packed.place.size))
    assert (orders.leaders >= 0).all()


def test_laws_that_keep_clear_of_what_both_covers_have_in_common_alone_have_one_order() -> None:
    """The second comes a little before the cells of either robot say that the first has left."""
    fleet = driven_on(CROSS, [0, 1])
    bars = orders_of(fleet).packed
    nodes = slice(fleet.courses.packed.first[1], fleet.courses.packed.first[2])
    kept = []
    for sooner in np.arange(0.0, 2.0, 0.05):
        packed = fleet.laws.packed
        arrive, leave = packed.arrive.copy(), packed.leave.copy()
        arrive[nodes] -= sooner
        leave[nodes] -= sooner
        laws = FleetLaws(packed._replace(arrive=arrive, leave=leave))
        try:
            orders = orders_of(replace(fleet, laws=laws))
        except GeometryError:
            break
        assert orders.leaders.tolist() == [0]
        mine = slice(orders.packed.first[1], orders.packed.first[2])
        kept.append((orders.packed.place[mine][0], orders.packed.passed[mine][-1]))
    assert len(kept) > 2
    held = slice(bars.first[1], bars.first[2])
    first, last = bars.place[held][0], bars.passed[held][-1]
    assert all(abs(place - first) <= 0.5 and abs(until - last) <= 0.5 for place, until in kept)


@pytest.mark.slow
def test_twenty_carts_in_a_warehouse_drive_as_far_apart_as_is_asked() -> None:
    """Their laws are on both sides of the cells of a crossing, which were taken for two."""
    examples = Path(__file__).parents[3] / "examples"
    run = vs.simulate_fleet(vs.load(examples / "warehouse-carts.yaml"))
    assert run.certificate.holds
