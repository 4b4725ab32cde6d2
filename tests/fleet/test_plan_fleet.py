"""Promises of fleets, looked at every 10 ms on the exact curves, with no code of the planner's."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.errors import GeometryError
from viaspline.fleet.execution.delays import Delays
from viaspline.fleet.execution.fleet_navigator import FleetNavigator
from viaspline.fleet.execution.simulate_fleet import simulate_fleet
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.plan_fleet import plan_fleet
from viaspline.kernels.arrays import Floats
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import Plan

SEPARATION = 0.5


def robot(points: Any, depart_s: float = 0.0, **kind: Any) -> dict[str, Any]:
    """A robot of its own kind, from point to point."""
    start, *via, goal = [[float(x) for x in point] for point in points]
    return {
        "kind": {"radius_m": 0.4, "clearance_m": 0.1, **kind},
        "route": {"start": start, "via": via, "goal": goal},
        "depart_s": depart_s,
    }


def fleet_of(*robots: dict[str, Any], **more: Any) -> Fleet:
    named = {f"r{k}": one for k, one in enumerate(robots)}
    return Fleet.model_validate(
        {
            "separation_m": SEPARATION,
            "robots": {name: one["kind"] for name, one in named.items()},
            "fleet": [
                {"name": name, "robot": name, **{k: v for k, v in one.items() if k != "kind"}}
                for name, one in named.items()
            ],
            **more,
        }
    )


def places(plan: Plan, times: Floats) -> Floats:
    law = plan.trajectory
    along = np.interp(times, law.times, law.distances)  # outside of the law it stands
    between, _, _ = law.state_at(np.clip(times, law.start_time, law.end_time))
    inside = (times > law.start_time) & (times < law.end_time)
    return np.asarray(plan.path.at_distance(np.where(inside, between, along)))


def free_space(planned: FleetPlan) -> float:
    """Between the two bodies that are nearest, every 10 ms [m]."""
    plans = list(planned.plans.values())
    if len(plans) < 2:
        return np.inf
    end = max(plan.trajectory.end_time for plan in plans)
    times = np.arange(-0.5, end + 1.0, 0.01)
    tracks = [places(plan, times) for plan in plans]
    radii = [plan.mission.robot.outer_radius for plan in plans]
    return min(
        float(np.hypot(*(tracks[i] - tracks[j]).T).min()) - radii[i] - radii[j]
        for i, j in combinations(range(len(plans)), 2)
    )


def random_fleet(seed: int, count: int, side: float = 40.0) -> Fleet:
    """Robots from anywhere to anywhere, with a via point each, apart at both ends."""
    random = np.random.default_rng(seed)
    ends: list[Floats] = []
    robots: list[dict[str, Any]] = []
    while len(robots) < count:
        points = random.uniform(0.0, side, (3, 2))
        rests = points[[0, 2]]
        if all(np.hypot(*(one - other)) > 2.0 for one in rests for other in ends):
            ends += list(rests)
            speed = float(random.choice([0.7, 1.5, 3.0]))
            robots.append(
                robot(
                    points,
                    float(random.choice([0.0, 3.0])),
                    max_speed_mps=speed,
                    radius_m=float(random.choice([0.2, 0.5])),
                )
            )
    return fleet_of(*robots)


@given(seed=st.integers(0, 100_000), count=st.integers(2, 9))
@settings(max_examples=25)
@example(seed=1, count=9)
def test_who_is_served_is_apart_from_all_others_at_every_instant(seed: int, count: int) -> None:
    planned = plan_fleet(random_fleet(seed, count))
    looked_at = free_space(planned)
    assert planned.certificate.holds
    assert planned.certificate.separation <= looked_at + 1e-9
    assert len(planned.plans) + len(planned.not_served) == count
    if np.isfinite(looked_at):
        assert looked_at >= SEPARATION - 1e-6
        assert planned.certificate.separation >= looked_at - 0.045  # and bows of curves


@given(seed=st.integers(0, 100_000))
@settings(max_examples=15)
def test_who_passes_no_resting_place_and_whose_own_none_passes_is_served(seed: int) -> None:
    planned = plan_fleet(random_fleet(seed, 6, side=60.0))
    assert planned.served
    for name, plan in planned.plans.items():
        assert plan.certificate.holds
        assert plan.trajectory.duration >= planned.alone[name] - 1e-9


@given(seed=st.integers(0, 100_000))
@settings(max_examples=12)
def test_what_is_driven_late_stays_apart_and_arrives(seed: int) -> None:
    fleet = random_fleet(seed, 7)
    planned = plan_fleet(fleet)
    delays = Delays(slowed=0.3, halts=0.5, halts_s=20, lost=0.2)
    for trouble in (Delays(), delays):
        run = simulate_fleet(fleet, trouble, planned, seed=seed)
        assert set(run.arrivals) == set(planned.plans)
        assert run.certificate.separation >= SEPARATION - 0.045


def test_ten_that_meet_in_the_middle_are_led_past_each_other_and_driven() -> None:
    angles = np.linspace(0.0, 2.0 * np.pi, 10, endpoint=False)
    ends = 15.0 * np.column_stack([np.cos(angles), np.sin(angles)])
    planned = plan_fleet(fleet_of(*(robot([end, -end]) for end in ends)))
    assert planned.served
    assert free_space(planned) >= SEPARATION - 1e-6
    run = simulate_fleet(planned.fleet, Delays(slowed=0.3), planned)
    assert len(run.arrivals) == 10
    assert run.certificate.separation >= SEPARATION - 0.045


def test_a_fleet_gets_the_same_laws_each_time() -> None:
    fleet = random_fleet(7, 8)
    first, second = (plan_fleet(fleet, improve=0.05) for _ in range(2))
    for name, plan in first.plans.items():
        assert plan.trajectory.times.tobytes() == second.plans[name].trajectory.times.tobytes()
    assert first.certificate == second.certificate


def test_who_has_the_higher_priority_is_let_pass() -> None:
    crossing = [robot([(0, 0), (40, 0)]), robot([(20, -20), (20, 20)])]
    for k in range(2):
        robots = [{**one, "priority": float(i == k)} for i, one in enumerate(crossing)]
        planned = plan_fleet(fleet_of(*robots))
        assert planned.plans[f"r{k}"].trajectory.duration == planned.alone[f"r{k}"]
        (passing,) = planned.precedences
        assert (passing.first, passing.second) == (f"r{k}", f"r{1 - k}")
        late = planned.plans[f"r{1 - k}"].trajectory.duration - planned.alone[f"r{1 - k}"]
        assert passing.waits_s == pytest.approx(late, abs=0.01)
        assert late > 0.5


def test_a_fleet_of_one_drives_as_if_alone() -> None:
    planned = plan_fleet(fleet_of(robot([(0, 0), (20, 5), (40, 0)])))
    assert planned.served
    assert planned.certificate.pair is None
    assert planned.precedences == ()


def test_robots_that_can_be_slowed_nowhere_wait_at_home() -> None:
    first = {**robot([(0, 0), (40, 0)]), "priority": 1}
    planned = plan_fleet(fleet_of(first, robot([(20, -20), (20, 20)], max_jerk_mps3=1.0)))
    assert planned.served
    law = planned.plans["r1"].trajectory
    assert law.distances[0] == law.distances[1] == 0.0
    assert free_space(planned) >= SEPARATION - 1e-6


def test_a_stay_at_a_station_is_kept_and_waits_count() -> None:
    stops = robot([(20, -20), (20, 20)])
    stops["route"]["via"] = [{"at": [20, -10], "dwell_s": 7}]
    planned = plan_fleet(fleet_of(robot([(0, 0), (40, 0)], depart_s=8.0), stops))
    assert planned.served
    law = planned.plans["r1"].trajectory
    stands = np.flatnonzero((np.diff(law.distances) == 0.0) & (law.distances[:-1] > 5.0))
    assert sum(np.diff(law.times)[stands]) >= 7.0 - 1e-9


@pytest.mark.parametrize("improve", [-1.0, np.nan, "soon"])
def test_what_is_no_time_to_spend_is_refused(improve: Any) -> None:
    with pytest.raises(GeometryError, match="improve"):
        plan_fleet(fleet_of(robot([(0, 0), (9, 0)])), improve)


def test_a_fleet_its_plan_its_run_and_its_navigator_are_shown_on_a_line_each() -> None:
    fleet = fleet_of(robot([(0, 0), (40, 0)]), robot([(20, -20), (20, 20)]))
    plan = plan_fleet(fleet)
    run, nav = simulate_fleet(fleet, plan=plan), FleetNavigator(plan)
    assert repr(fleet) == str(fleet) == "Fleet(2 robots, 0.5 m apart, 0 obstacles)"
    assert "2 of 2 robots served" in repr(plan)
    assert "'r0' and 'r1'" in repr(plan) or "'r1' and 'r0'" in repr(plan)
    shown = float(repr(plan).partition("proven ")[2].partition(" m")[0])
    assert plan.certificate.separation - 1e-3 <= shown <= plan.certificate.separation
    assert "2 of 2 robots arrived" in repr(run)
    assert repr(nav) == "FleetNavigator(2 robots before the first step, 0 arrived, 0 out)"
    assert "2 robots at 1.0 s" in repr(nav.step([], 1.0)[1])
    alone = plan_fleet(fleet_of(robot([(0, 0), (40, 0)])))
    for shown_thing in (fleet, plan, run, nav, alone):
        assert len(repr(shown_thing)) < 150
        assert "\n" not in repr(shown_thing)
