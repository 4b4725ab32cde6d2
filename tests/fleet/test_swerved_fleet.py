"""Paths led aside so that robots wait less: never later, apart by samples, and as was asked for."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.fleet.crossing_paths import CrossingPaths, crossing_paths
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.laying.swerving import may_swerve
from viaspline.fleet.swerved_fleet import swerved_fleet
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.kernels.arrays import Floats
from viaspline.planner import Plan

RADIUS_M, SEPARATION_M = 0.5, 1.0
FAR_S = 20.0


def fleet_of(routes: list[dict[str, Any]], **more: Any) -> vs.Fleet:
    members = [{"name": f"r{k}", **more, "route": one} for k, one in enumerate(routes)]
    robot = {"radius_m": RADIUS_M, "max_speed_mps": 2.0, "max_lateral_accel_mps2": 0.8}
    return vs.Fleet.model_validate(
        {"separation_m": SEPARATION_M, "robots": {"cart": robot}, "fleet": members}
    )


def shallow(**more: Any) -> vs.Fleet:
    """Two that come towards each other on paths that cross at seven degrees."""
    return fleet_of(
        [{"start": [0, 0], "goal": [160, 0]}, {"start": [160, -10], "goal": [0, 10]}], **more
    )


def timed(fleet: vs.Fleet) -> tuple[TimedFleet, CrossingPaths]:
    paths = crossing_paths(fleet)
    return TimedFleet.by_priority(FleetWays.of(fleet, paths)), paths


def swerved(fleet: vs.Fleet, budget: float = FAR_S) -> tuple[TimedFleet, TimedFleet]:
    """The fleet as it was, and as it is with swerves."""
    before, paths = timed(fleet)
    assert paths.laid.kept is not None
    after, left = swerved_fleet(before, paths.laid.kept.rests, fleet.separation_m, budget)
    assert 0.0 <= left <= budget
    return before, after


def places(plan: Plan, times: Floats) -> Floats:
    return np.asarray(plan.path.at_distance(plan.trajectory.distance_at(times)))


def least_distance(found: TimedFleet) -> float:
    """Between the middles of any two robots, looked at every 10 ms [m]."""
    plans = list(found.planar_plans().values())
    times = np.arange(0.0, max(plan.trajectory.end_time for plan in plans) + 1.0, 0.01)
    tracks = [places(plan, times) for plan in plans]
    return min(float(np.hypot(*(a - b).T).min()) for k, a in enumerate(tracks) for b in tracks[:k])


def late(found: TimedFleet) -> float:
    """How much later all are than alone along the paths that they had at first [s]."""
    return float((found.arrivals() - found.ways.rides.alone).sum())


def test_two_that_would_meet_head_on_for_long_hardly_wait() -> None:
    before, after = swerved(shallow())
    assert late(before) > 3.0
    assert late(after) < 0.5 * late(before)
    assert least_distance(after) >= 2.0 * RADIUS_M + SEPARATION_M - 1e-6
    assert certify_fleet(after.ways.courses, after.timing.laws, SEPARATION_M).holds


@pytest.mark.parametrize("angle_deg", [90, 120, 150])
def test_of_two_that_cross_at_once_one_passes_behind_the_other(angle_deg: int) -> None:
    x, y = 60.0 * np.cos(np.radians(angle_deg)), 60.0 * np.sin(np.radians(angle_deg))
    before, after = swerved(
        fleet_of([{"start": [-60, 0], "goal": [60, 0]}, {"start": [-x, -y], "goal": [x, y]}])
    )
    assert late(before) > 1.5
    assert late(after) < 0.4 * late(before)
    assert least_distance(after) >= 2.0 * RADIUS_M + SEPARATION_M - 1e-6


def test_who_is_late_by_then_is_swerved_for_as_it_drives() -> None:
    """The third one would meet the second one only because that waits for the first."""
    first = {"start": [-60, 0], "goal": [60, 0]}
    second = {"start": [1, -62], "goal": [1, 60]}
    third = {"start": [-85, 20], "goal": [55, 20]}
    alone, _ = timed(fleet_of([second, third]))
    assert late(alone) == pytest.approx(0.0, abs=1e-6)
    before, after = swerved(fleet_of([first, second, third]))
    pair, _ = timed(fleet_of([first, second]))
    assert late(before) > late(pair) + 0.8
    assert late(after) < late(pair) + 0.2
    assert least_distance(after) >= 2.0 * RADIUS_M + SEPARATION_M - 1e-6


def test_what_others_take_alone_stays_what_it_was() -> None:
    before, after = swerved(shallow())
    assert after.ways.rides.alone.tolist() == before.ways.rides.alone.tolist()
    changed = [a is not b for a, b in zip(before.ways.plans, after.ways.plans, strict=True)]
    assert sum(changed) == 1
    plan = after.ways.planar[changed.index(True)]
    assert plan.certificate.holds
    alone = before.ways.planar[changed.index(True)]
    assert plan.path.length > alone.path.length


def test_without_a_budget_nothing_changes() -> None:
    before, after = swerved(shallow(), budget=0.0)
    assert after is before


def test_paths_of_which_the_mission_says_how_they_run_stay() -> None:
    route = {"start": [0, 0], "via": [[80, 5]], "goal": [160, 0]}
    kept: list[dict[str, Any]] = [
        {"route": {**route, "detours": "local"}},
        {"route": {**route, "corridor": {"left_m": 4.0, "right_m": 4.0}}},
        {"route": route, "spline": {"tension": 0.5}},
        {"route": route, "spline": {"tangents": "cardinal"}},
        {"route": route, "robot": {"min_turn_radius_m": 3.0}},
    ]
    for mission in kept:
        assert not may_swerve(vs.plan(vs.Mission.model_validate(mission)))
    assert may_swerve(vs.plan(vs.Mission.model_validate({"route": route})))


def test_swerves_keep_clear_of_what_stands() -> None:
    walls = [{"polygon": [[20, y], [140, y], [140, y + 1], [20, y + 1]]} for y in (-6.5, 5.5)]
    fleet = vs.Fleet.model_validate({**shallow().model_dump(), "world": {"known": walls}})
    before, after = swerved(fleet)
    assert late(after) <= late(before)
    for plan in after.planar_plans().values():
        path = np.asarray(plan.path.evaluate(np.linspace(*plan.path.domain, 4000)))
        for wall in walls:
            (x0, y0), (x1, y1) = wall["polygon"][0], wall["polygon"][2]
            off = np.maximum(np.abs(path - [(x0 + x1) / 2, (y0 + y1) / 2]) - [60, 0.5], 0.0)
            assert np.hypot(*off.T).min() >= RADIUS_M - 1e-6


def rounds(seed: int, count: int, kinds: int) -> vs.Fleet:
    """Closed rounds through three places each, in 90 m x 90 m, of robots of some kinds."""
    rng = np.random.default_rng(seed)
    robots = {
        f"k{k}": {"radius_m": 0.4 + 0.2 * k, "max_speed_mps": 1.0 + k, "max_accel_mps2": 1.0}
        for k in range(kinds)
    }
    members = []
    for k in range(count):
        home = [10.0 + 14.0 * (k % 6), 20.0 + 30.0 * (k // 6)]
        via = rng.uniform(10.0, 80.0, (2, 2)).tolist()
        route = {"start": home, "via": via, "closed": True}
        members.append({"name": f"r{k}", "robot": f"k{k % kinds}", "route": route})
    return vs.Fleet.model_validate({"separation_m": 0.8, "robots": robots, "fleet": members})


def test_of_more_timings_with_what_lies_ahead_the_soonest_is_taken() -> None:
    ways = timed(rounds(11, 12, 1))[0].ways
    one, more, again = (ways.timed_ahead(times) for times in (1, 8, 8))
    assert one is not None
    assert more is not None
    assert again is not None
    assert late(TimedFleet(ways, more)) < late(TimedFleet(ways, one)) - 0.1
    assert certify_fleet(ways.courses, more.laws, 0.8).holds
    assert more.laws.packed.arrive.tobytes() == again.laws.packed.arrive.tobytes()


@settings(max_examples=6, deadline=None)
@given(seed=st.integers(0, 10_000), count=st.integers(2, 9), kinds=st.integers(1, 2))
def test_no_fleet_is_later_and_all_keep_apart(seed: int, count: int, kinds: int) -> None:
    fleet = rounds(seed, count, kinds)
    before, after = swerved(fleet)
    assert after.rank <= before.rank
    plans = after.planar_plans()
    assert len(plans) == count - len(before.blocked)
    names = list(plans)
    end = max(plan.trajectory.end_time for plan in plans.values())
    times = np.arange(0.0, end + 1.0, 0.02)
    tracks = {name: places(plan, times) for name, plan in plans.items()}
    for k, one in enumerate(names):
        for other in names[:k]:
            bodies = sum(plans[name].mission.robot.radius_m for name in (one, other))
            apart = np.hypot(*(tracks[one] - tracks[other]).T).min()
            assert apart >= bodies + fleet.separation_m - 1e-6
    for member in fleet.members:
        path = np.asarray(plans[member.name].path.evaluate(
            np.linspace(*plans[member.name].path.domain, 4001)
        ))  # fmt: skip
        for via in member.mission.route.via:
            assert np.hypot(*(path - via.at[:2]).T).min() < 0.2


def test_the_same_fleet_gets_the_same_bytes() -> None:
    first, second = (swerved(rounds(5, 9, 1))[1] for _ in range(2))
    for one, other in zip(first.ways.planar, second.ways.planar, strict=True):
        assert one.path.spans.tobytes() == other.path.spans.tobytes()
    assert first.timing.laws.packed.arrive.tobytes() == second.timing.laws.packed.arrive.tobytes()


def test_many_robots_are_sooner_where_time_is_given(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("viaspline.fleet.plan_fleet.MANY", 2)
    fleet = shallow()
    plan, better = vs.plan_fleet(fleet), vs.plan_fleet(fleet, improve=1.0)
    arrivals = [
        sum(one.trajectory.end_time for one in found.plans.values()) for found in (plan, better)
    ]
    assert better.served
    assert arrivals[1] < arrivals[0] - 1.0
    assert better.certificate.separation >= SEPARATION_M
