"""Robots timed along paths that are given, and those that can't be."""

from __future__ import annotations

import tempfile
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.fleet.crossing_paths import crossing_paths
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.timing.time_paths import time_paths
from viaspline.fleet.timing.timed_trajectory import timed_trajectory


def ways_of(*routes: Any, **more: Any) -> FleetWays:
    data = [
        {"name": f"r{k}", "route": {"start": [*route[0]], "goal": [*route[-1]]}}
        for k, route in enumerate(routes)
    ]
    fleet = vs.Fleet.model_validate({"separation_m": 1, "fleet": data, **more})
    return FleetWays.of(fleet, crossing_paths(fleet))


WALLS = [{"polygon": [[-2, y], [42, y], [42, y + 1], [-2, y + 1]]} for y in (-2.1, 1.1)]
HEAD_ON = ((0, 0), (40, 0)), ((40, 0), (0, 0))


@pytest.fixture(scope="module")
def crossing() -> FleetWays:
    return ways_of(((0, 0), (40, 0)), ((20, -20), (20, 20)), ((30, -20), (30, 25)))


def test_who_is_let_pass_drives_as_alone_to_the_bit(crossing: FleetWays) -> None:
    timed = TimedFleet.by_priority(crossing)
    assert not timed.timing.blocked
    law = timed_trajectory(
        crossing.plans[2].trajectory, crossing.courses, crossing.rides, timed.timing.laws, 2
    )
    assert law.times.tobytes() == crossing.plans[2].trajectory.times.tobytes()


def test_a_delayed_law_is_whole(crossing: FleetWays) -> None:
    laws = TimedFleet.by_priority(crossing).timing.laws
    for k, plan in enumerate(crossing.plans):
        law = timed_trajectory(plan.trajectory, crossing.courses, crossing.rides, laws, k)
        assert law.end_time == pytest.approx(
            laws.packed.arrive[crossing.courses.packed.first[k + 1] - 1]
        )
        gone = np.diff(law.distances)
        mean = 0.5 * (law.speeds[1:] + law.speeds[:-1]) * np.diff(law.times)
        assert np.abs(gone - mean).max() < 1e-9
        assert np.abs(law.accelerations).max() <= 1.0 + 1e-9


def test_head_on_between_walls_one_is_in_the_way_of_the_other() -> None:
    ways = ways_of(*HEAD_ON, world={"known": WALLS})
    timing = TimedFleet.by_priority(ways).timing
    assert timing.blocked in ({0: 1}, {1: 0})


def test_who_stands_for_ever_is_in_the_way_of_all_that_pass_its_start() -> None:
    ways = ways_of(*HEAD_ON, world={"known": WALLS})
    timed = TimedFleet.by_priority(ways).past_standing_ones()
    assert set(timed.blocked) == {"r0", "r1"}


def test_who_is_left_out_keeps_its_place(crossing: FleetWays) -> None:
    timing = time_paths(
        crossing.courses, crossing.crossings, crossing.rides, [0.0] * 3, left_out=[0]
    )
    first = crossing.courses.packed.first[0]
    assert timing.laws.packed.leave[first] == np.inf
    assert not timing.blocked
    for k in (1, 2):  # nobody has to be let pass
        end = timing.laws.packed.arrive[crossing.courses.packed.first[k + 1] - 1]
        assert end == pytest.approx(crossing.rides.alone[k])


@settings(max_examples=15, deadline=None)
@given(
    dwell=st.floats(0.5, 30.0),
    depart=st.floats(0.0, 10.0),
    rest=st.sampled_from(["stay", "leave"]),
    heeds=st.booleans(),
)
def test_a_robot_stands_at_its_goal_as_long_as_asked_also_when_it_was_slowed(
    dwell: float, depart: float, rest: str, heeds: bool
) -> None:
    goal = {"at": [20, 20], "dwell_s": dwell}
    robots = [
        {"name": "a", "priority": 2, "route": {"start": [0, 0], "goal": [40, 0]}},
        {"name": "b", "route": {"start": [20, -20], "goal": goal}, "rest": rest},
        {"name": "c", "depart_s": depart, "route": {"start": [20, 40], "goal": [20, -30]}},
    ]
    if rest == "stay":
        robots.pop()  # it couldn't pass
    if not heeds:
        robots.pop(0)
    plan = vs.plan_fleet(vs.Fleet.model_validate({"separation_m": 1, "fleet": robots}))
    assert plan.served
    law = plan.plans["b"].trajectory
    there = law.times[np.abs(law.distances - plan.plans["b"].path.length) < 1e-9]
    assert np.ptp(there) == pytest.approx(dwell, abs=1e-9)
    if "c" in plan.plans:  # passes there
        times = np.arange(0.0, law.end_time, 0.01)
        places = [
            plan.plans[name].path.at_distance(plan.plans[name].trajectory.distance_at(times))
            for name in "bc"
        ]
        assert np.hypot(*(places[0] - places[1]).T).min() >= 2.0 - 1e-6
    run = vs.simulate_fleet(plan.fleet, None, plan)
    assert run.arrivals["b"] == pytest.approx(law.end_time + run.delays["b"], abs=1e-6)
    assert vs.FleetNavigator(plan, warm=False).expected()["b"] <= law.end_time + 1e-6
    with tempfile.TemporaryDirectory() as folder:
        plan.save(folder)
        assert vs.load_fleet_plan(folder) == plan


@pytest.mark.parametrize("seed", [0, 1])
def test_few_robots_pass_in_an_order_that_a_search_finds_none_sooner_than(seed: int) -> None:
    order = np.random.default_rng(seed).permutation(5)
    ends = [((0, 1.5 * k), (40, 1.5 * int(to))) for k, to in enumerate(order)]
    lanes = [one[:: (-1) ** k] for k, one in enumerate(ends)]  # each other one the other way
    ways = ways_of(*lanes, separation_m=0.4, robots={"cart": {"radius_m": 0.3, "clearance_m": 0.1}})
    timed = TimedFleet.by_priority(ways)
    assert not timed.blocked
    assert timed.arrivals().sum() <= 1.01 * timed.improved(0.2).arrivals().sum()
