"""Patrols in space that never end: one period, proven for ever, against gaps of the test's own."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import viaspline as vs
from viaspline.fleet.execution.fleet_messages import ProgressReport
from viaspline.fleet.execution.fleet_navigator import FleetNavigator
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.patrols.driven_laps import driven_laps, seams_of
from viaspline.space.spatial_plan import SpatialPlan

Floats = NDArray[np.float64]
RADIUS, HALF, SEPARATION = 0.4, 0.2, 1.0
DRONE = {"radius_m": RADIUS, "half_height_m": HALF, "clearance_m": 0.5, "max_speed_mps": 4,
         "max_accel_mps2": 1.5, "max_climb_mps": 2, "max_descent_mps": 1,
         "max_yaw_rate_dps": 60}  # fmt: skip
SQUARE = [[0, 0, 10], [20, 0, 10], [20, 20, 12], [0, 20, 10]]


def patrol(*points: Any, **more: Any) -> dict[str, Any]:
    return {"route": {"start": points[0], "via": list(points[1:]), "closed": True, **more}}


def ride(start: list[float], goal: list[float], **more: Any) -> dict[str, Any]:
    return {"route": {"start": start, "goal": goal}, **more}


def planned(*robots: dict[str, Any], **world: Any) -> FleetPlan:
    named = [{"name": f"r{k}", **one} for k, one in enumerate(robots)]
    data = {"world": world, "separation_m": SEPARATION, "robots": {"drone": DRONE}, "fleet": named}
    plan = vs.plan_fleet(vs.Fleet.model_validate(data))
    assert isinstance(plan, FleetPlan)
    return plan


def gap(off: Floats) -> Floats:
    """Free space between two of the drones."""
    level = np.maximum(np.hypot(off[:, 0], off[:, 1]) - 2 * RADIUS, 0.0)
    return np.asarray(np.hypot(level, np.maximum(np.abs(off[:, 2]) - 2 * HALF, 0.0)))


def places(plan: FleetPlan, name: str, times: Floats) -> Floats:
    """By nothing but the first period of each patrol; not a number where a robot has left."""
    one, patrols = plan.plans[name], plan.patrols
    law = one.trajectory
    if patrols is not None and name in patrols.begins:
        begin = patrols.begins[name]
        times = np.where(times < begin, begin, begin + (times - begin) % patrols.period)
    at = np.array(one.path.at_distance(law.distance_at(times)))
    leaves = {member.name for member in plan.fleet.members if member.rest == "leave"}
    if name in leaves:
        at[times > law.end_time] = np.nan
    return at


def holds_for_ever(plan: FleetPlan) -> None:
    """The proof is no more than what samples meet, over periods after all others are there."""
    assert plan.patrols is not None
    assert plan.certificate.holds
    assert plan.certificate.repeats == (plan.patrols.repeats_from, plan.patrols.period)
    times = np.arange(0.0, plan.patrols.repeats_from + 3 * plan.patrols.period, 0.01)
    where = {name: places(plan, name, times) for name in plan.plans}
    for a, b in combinations(where, 2):
        apart = float(np.nanmin(gap(where[a] - where[b])))
        assert apart >= SEPARATION - 2e-6
        assert apart >= plan.certificate.separation - 1e-6


def test_two_patrols_that_cross_have_one_period_and_never_meet() -> None:
    plan = planned(patrol(*SQUARE), patrol([10, -10, 10], [10, 10, 11], [30, 10, 11]))
    assert plan.served
    holds_for_ever(plan)


def test_patrols_one_above_the_other_fly_as_if_they_were_alone() -> None:
    higher = [[x, y, z + 4] for x, y, z in SQUARE]
    plan = planned(patrol(*SQUARE), patrol(*higher))
    holds_for_ever(plan)
    assert plan.precedences == ()
    assert plan.patrols is not None
    lap = plan.plans["r0"].trajectory.duration / plan.plans["r0"].mission.route.laps
    assert plan.patrols.period == pytest.approx(lap, rel=1e-3)


def test_a_short_lap_is_flown_several_times_in_a_period() -> None:
    plan = planned(patrol([0, 0, 9], [12, 0, 9], [12, 4, 9]), patrol([6, 9, 9], [6, -60, 12]))
    assert plan.served
    assert plan.patrols is not None
    assert plan.patrols.laps["r0"] > plan.patrols.laps["r1"] == 1
    holds_for_ever(plan)


def test_robots_that_end_pass_patrols() -> None:
    plan = planned(patrol(*SQUARE), ride([-20, 10, 10], [40, 10, 11]),
                   ride([5, 30, 10], [5, -30, 10], rest="leave"))  # fmt: skip
    assert plan.served
    holds_for_ever(plan)


def test_a_patrol_that_passes_the_start_of_another_is_told_why() -> None:
    plan = planned(patrol(*SQUARE), patrol([20, 20, 12], [40, 20, 12], [40, 40, 12]))
    (refused,) = plan.not_served
    assert refused.name == "r0"
    assert "comes back to its start every lap" in refused.reason
    assert "height" in refused.remedy
    assert plan.certificate.holds


def test_a_robot_that_would_stay_where_a_patrol_passes_is_told_to_leave() -> None:
    plan = planned(patrol(*SQUARE), ride([20, -20, 10], [20, 20, 12]))
    (refused,) = plan.not_served
    assert refused.name == "r1"
    assert "rest: leave" in refused.remedy


def test_every_lap_is_the_first_one_again_with_its_headings() -> None:
    route = {"start": [0, 0, 9], "via": [{"at": [9, 0, 9], "dwell_s": 3, "look_at": [0, 9, 9]},
             [9, 9, 12]], "closed": True, "yaw": {"to": [30, 0, 9]}}  # fmt: skip
    lap = vs.plan(vs.Mission.model_validate({"robot": DRONE, "route": route}))
    assert isinstance(lap, SpatialPlan)
    three = driven_laps(lap, 3)
    assert isinstance(three, SpatialPlan)
    once = lap.trajectory
    stay = (three.trajectory.duration - 3.0 * once.duration) / 2.0
    assert stay == pytest.approx(0.0, abs=1e-6)
    times = np.linspace(0.0, once.duration, 300)
    for k in range(3):
        along = three.trajectory.distance_at(times + k * once.duration)
        there = three.path.at_distance(along)
        first = lap.path.at_distance(once.distance_at(times))
        assert np.abs(there - first).max() < 1e-4
        turned = three.yaw.at(along) - lap.yaw.at(once.distance_at(times))
        assert np.abs(np.sin(turned)).max() < 1e-3
    assert three.trajectory.speed_at(seams_of(three.path, 3)).max() == 0.0


def test_a_navigator_leads_patrols_in_space_longer_than_their_plans() -> None:
    plan = planned(patrol(*SQUARE), patrol([10, -10, 10], [10, 10, 11], [30, 10, 11]))
    assert plan.patrols is not None
    nav, period = FleetNavigator(plan, period=0.2), plan.patrols.period
    come = dict.fromkeys(plan.plans, 0.0)
    speed = dict.fromkeys(plan.plans, 0.0)
    for time in np.arange(0.0, 6.0 * period, 0.2):
        reports = [ProgressReport(name, time, come[name], speed[name]) for name in come]
        commands, nav = nav.step(reports, float(time))
        for name, command in commands.items():
            room = max(command.granted - come[name], 0.0)
            speed[name] = float(min(speed[name] + 0.2, 3.0, np.sqrt(2.0 * room)))
            come[name] += min(speed[name] * 0.2, room)
        laps = {name: one.path.length / one.mission.route.laps for name, one in plan.plans.items()}
        at = [np.asarray(one.path.at_distance(come[name] % laps[name]))
              for name, one in plan.plans.items()]  # fmt: skip
        assert float(gap((at[0] - at[1])[None])[0]) >= SEPARATION - 1e-6
    for name, one in plan.plans.items():
        assert come[name] > one.path.length


@settings(max_examples=3, deadline=None)
@given(seed=st.integers(0, 100_000))
def test_patrols_and_robots_that_end_stay_apart_for_ever(seed: int) -> None:
    rng = np.random.default_rng(seed)

    def points(count: int) -> list[list[float]]:
        return rng.uniform((0, 0, 3), (30, 30, 18), (count, 3)).round(1).tolist()  # type: ignore[no-any-return]

    robots = [patrol(*points(3)) for _ in range(2)]
    robots += [ride(*points(2), rest="leave") for _ in range(2)]
    starts = [np.array(one["route"]["start"]) for one in robots]
    if min(np.linalg.norm(a - b) for a, b in combinations(starts, 2)) < 2.5:
        return
    plan = planned(*robots)
    for one in plan.not_served:
        assert one.remedy
    if plan.patrols is not None:
        holds_for_ever(plan)
