"""Fleets among things that move: every robot clear of them by its own law, looked at by samples."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import GeometryError
from viaspline.fleet.crossing_paths import crossing_paths
from viaspline.fleet.execution.delays import Delays
from viaspline.fleet.execution.fleet_navigator import FleetNavigator
from viaspline.fleet.execution.simulate_fleet import simulate_fleet
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.plan_fleet import plan_by_priority, plan_fleet
from viaspline.mission.fleet.fleet import Fleet

RADIUS, CLEARANCE, TRAM_M, SEPARATION = 0.4, 0.1, 1.0, 0.5


def fleet_of(*robots: dict[str, Any], motion: dict[str, Any]) -> Fleet:
    """Robots among one disc that moves."""
    tram = {"name": "tram", "circle": {"center": [0, 0], "radius": TRAM_M}, "motion": motion}
    return Fleet.model_validate(
        {
            "world": {"known": [tram]},
            "separation_m": SEPARATION,
            "robots": {"cart": {"radius_m": RADIUS, "clearance_m": CLEARANCE}},
            "fleet": [{"name": f"r{k}", "robot": "cart", **one} for k, one in enumerate(robots)],
        }
    )


def ride(start: list[float], goal: list[float], **more: Any) -> dict[str, Any]:
    return {"route": {"start": start, "goal": goal}, **more}


def straight(begin: tuple[float, float], velocity: tuple[float, float]) -> dict[str, Any]:
    return {"from": begin, "velocity_mps": velocity}


def keeps_clear(plan: FleetPlan, motion: dict[str, Any]) -> None:
    """By samples, robots are clear of the disc while they drive, and of each other always."""
    assert plan.certificate.holds
    end = max((one.trajectory.end_time for one in plan.plans.values()), default=0.0)
    times = np.arange(0.0, end + 5.0, 0.01)
    disc = np.array(motion["from"]) + times[:, None] * np.array(motion["velocity_mps"])
    where = {}
    for name, one in plan.plans.items():
        law = one.trajectory
        where[name] = np.asarray(one.path.at_distance(law.distance_at(times)))
        drives = (times >= law.start_time) & (times <= law.end_time)
        apart = np.hypot(*(where[name] - disc)[drives].T)
        assert apart.min() >= RADIUS + CLEARANCE + TRAM_M - 1e-6
        proof = one.moving_certificate
        assert proof is not None
        assert proof.holds
        assert proof.clearance <= apart.min() - RADIUS - TRAM_M + 1e-6
    for one_name, two_name in combinations(where, 2):
        apart = np.hypot(*(where[one_name] - where[two_name]).T)
        assert apart.min() >= 2.0 * RADIUS + SEPARATION - 1e-6


CROSSING = [ride([0, 0], [40, 0]), ride([20, -20], [20, 20])]


def test_robots_that_cross_let_what_moves_pass_as_well() -> None:
    motion = straight((12.0, -12.0), (0.0, 2.0))
    plan = plan_fleet(fleet_of(*CROSSING, motion=motion))
    assert plan.served
    keeps_clear(plan, motion)
    still = plan_fleet(fleet_of(*CROSSING, motion=straight((500.0, 0.0), (0.0, 1.0))))
    assert still.served
    arrivals = [[one.plans[n].trajectory.end_time for n in ("r0", "r1")] for one in (still, plan)]
    assert arrivals[1] != arrivals[0]


def test_robots_that_nothing_comes_near_drive_as_if_nothing_moved() -> None:
    motion = straight((500.0, 0.0), (0.0, 1.0))
    asked = fleet_of(*CROSSING, motion=motion)
    plan = plan_fleet(asked)
    bare = Fleet.model_validate(
        {
            "separation_m": SEPARATION,
            "robots": {"cart": {"radius_m": RADIUS, "clearance_m": CLEARANCE}},
            "fleet": [{"name": f"r{k}", "robot": "cart", **one} for k, one in enumerate(CROSSING)],
        }
    )
    for name, one in plan_fleet(bare).plans.items():
        assert plan.plans[name].trajectory.times.tolist() == one.trajectory.times.tolist()
        assert plan.plans[name].moving_certificate is not None


def test_nobody_waits_for_a_robot_that_comes_otherwise_past_what_moves() -> None:
    first = ride([18, -8], [18, 30], priority=1)
    asked = [ride([0, 12], [40, 12]), first]
    waits = plan_fleet(fleet_of(*asked, motion=straight((500.0, 0.0), (0.0, 1.0))))
    assert waits.plans["r0"].trajectory.end_time > waits.alone["r0"] + 2.0
    motion = straight((22.0, -1.5), (-1.0, 0.0))  # before which the first has to give way
    plan = plan_fleet(fleet_of(*asked, motion=motion))
    keeps_clear(plan, motion)
    assert plan.plans["r0"].trajectory.end_time < waits.alone["r0"] + 0.5
    assert plan.plans["r1"].trajectory.end_time < waits.alone["r1"] + 0.5


def test_a_patrol_among_things_that_move_is_told_to_end() -> None:
    endless = {"route": {"start": [0, 0], "via": [[20, 0], [20, 20]], "closed": True}}
    motion = straight((500.0, 0.0), (0.0, 1.0))
    plan = plan_fleet(fleet_of(endless, ride([0, 9], [-30, 9]), motion=motion))
    (refused,) = plan.not_served
    assert refused.name == "r0"
    assert "number of laps" in refused.remedy
    twice = {"route": {**endless["route"], "laps": 2}}
    assert plan_fleet(fleet_of(twice, motion=motion)).served


def test_a_robot_that_is_run_over_where_it_starts_is_not_served_and_the_others_are() -> None:
    late = ride([0, 0], [30, 0], depart_s=20)
    early = ride([0, -12], [30, -12])
    plan = plan_fleet(fleet_of(late, early, motion=straight((0.0, -20.0), (0.0, 1.0))))
    assert [one.name for one in plan.not_served] == ["r0"]
    assert list(plan.plans) == ["r1"]


def test_among_things_that_move_a_drive_keeps_to_the_clock_and_delays_are_refused() -> None:
    motion = straight((12.0, -12.0), (0.0, 2.0))
    asked = fleet_of(*CROSSING, motion=motion)
    plan = plan_fleet(asked)
    run = simulate_fleet(asked, plan=plan)
    assert run.reached
    assert run.arrivals == {name: one.trajectory.end_time for name, one in plan.plans.items()}
    with pytest.raises(GeometryError, match="waits for nobody"):
        simulate_fleet(asked, Delays(slowed=0.3), plan)
    with pytest.raises(GeometryError, match="waits for nobody"):
        FleetNavigator(plan)


def test_a_drive_by_the_clock_is_where_the_plan_has_it_between_nodes_too() -> None:
    """Of laws that change their acceleration it was millimetres off."""
    data = fleet_of(*CROSSING, motion=straight((10.0, -30.0), (0.0, 1.0))).model_dump(
        mode="json", by_alias=True, exclude_none=True
    )
    data["robots"]["cart"]["max_jerk_mps3"] = 0.8
    plan = plan_fleet(Fleet.model_validate(data))
    run = simulate_fleet(plan.fleet, Delays(), plan)
    assert plan.plans
    for name, one in plan.plans.items():
        times = np.arange(-1.0, one.trajectory.end_time + 1.0, 0.01)
        off = np.abs(run.distance_at(name, times) - one.trajectory.distance_at(times))
        assert off.max() < 1e-9


def test_by_priority_alone_robots_keep_clear_of_what_moves() -> None:
    motion = straight((12.0, -12.0), (0.0, 2.0))
    asked = fleet_of(*CROSSING, motion=motion)
    plan = plan_by_priority(asked, crossing_paths(asked))
    keeps_clear(plan, motion)


@settings(max_examples=8, deadline=None)
@given(
    st.tuples(st.integers(0, 30), st.integers(-20, 20)),
    st.sampled_from([(0.0, 1.0), (1.0, 0.0), (-1.0, 0.5), (0.7, -1.2)]),
    st.booleans(),
)
def test_whatever_is_served_is_clear_of_what_moves(
    begin: tuple[int, int], velocity: tuple[float, float], leaves: bool
) -> None:
    motion = straight((float(begin[0]), float(begin[1])), velocity)
    rest = "leave" if leaves else "stay"
    robots = [ride([0, 0], [30, 0], rest=rest), ride([15, -12], [15, 12]), ride([28, 8], [2, -8])]
    asked = fleet_of(*robots, motion=motion)
    plan = plan_fleet(asked)
    if not leaves:
        keeps_clear(plan, motion)
    assert {one.name for one in plan.not_served} | set(plan.plans) == {"r0", "r1", "r2"}
