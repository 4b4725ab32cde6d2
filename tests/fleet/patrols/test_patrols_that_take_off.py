"""Patrols in space that take off, and never end: against gaps of the test's own, every 10 ms."""

from __future__ import annotations

import math
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import viaspline as vs
from viaspline.fleet.execution.fleet_messages import ProgressReport
from viaspline.fleet.patrols.take_off_first import lap_of
from viaspline.space.spatial_plan import SpatialPlan

Floats = NDArray[np.float64]
RADIUS, HALF, SEPARATION, GROUND = 0.4, 0.2, 1.0, 50.0
DRONE = {"radius_m": RADIUS, "half_height_m": HALF, "clearance_m": 0.1, "max_speed_mps": 4,
         "max_accel_mps2": 1.5, "max_climb_mps": 2, "max_descent_mps": 1,
         "max_yaw_rate_dps": 60}  # fmt: skip
WORLD = {"ground": {"flat_m": GROUND}, "altitude": {"min_m": 3, "max_m": 60}}


def patrol(start: Any, *points: Any, up: float = 10.0, **more: Any) -> dict[str, Any]:
    """Over points that are so high above the ground."""
    via = [{"at": point[:2], "agl_m": point[2]} for point in points]
    depart = {"depart_s": more.pop("depart_s")} if "depart_s" in more else {}
    route = {"start": start, "takeoff": {"to_agl_m": up}, "via": via, "closed": True, **more}
    return {"route": route, **depart}


def ride(start: Any, goal: Any, **more: Any) -> dict[str, Any]:
    above = [[*point[:2], point[2] + GROUND] for point in (start, goal)]
    return {"route": {"start": above[0], "goal": above[1]}, **more}


def planned(*robots: dict[str, Any]) -> vs.FleetPlan:
    named = [{"name": f"r{k}", **one} for k, one in enumerate(robots)]
    data = {"world": WORLD, "separation_m": SEPARATION, "robots": {"d": DRONE}, "fleet": named}
    return vs.plan_fleet(vs.Fleet.model_validate(data))


SQUARE = ([0, 0], [20, 0, 10], [20, 20, 12], [0, 20, 10])
ACROSS = ([10, -10], [10, 10, 11], [30, 10, 11])


def gap(off: Floats) -> Floats:
    """Free space between two of the drones."""
    level = np.maximum(np.hypot(off[..., 0], off[..., 1]) - 2 * RADIUS, 0.0)
    return np.asarray(np.hypot(level, np.maximum(np.abs(off[..., 2]) - 2 * HALF, 0.0)))


def places(plan: vs.FleetPlan, name: str, times: Floats) -> Floats:
    """By nothing but what comes before the first lap, and the first period."""
    one, patrols = plan.plans[name], plan.patrols
    if patrols is not None and name in patrols.begins:
        begin = patrols.begins[name]
        times = np.where(times < begin, times, begin + (times - begin) % patrols.period)
    at = np.array(one.path.at_distance(one.trajectory.distance_at(times)))
    leaves = {member.name for member in plan.fleet.members if member.rest == "leave"}
    at[(times > one.trajectory.end_time) & (name in leaves)] = np.nan
    return at


def check(plan: vs.FleetPlan) -> None:
    """The proof is no more than samples meet, over periods after all others are there."""
    patrols = plan.patrols
    assert patrols is not None
    assert plan.certificate.holds
    times = np.arange(0.0, patrols.repeats_from + 3 * patrols.period, 0.01)
    where = {name: places(plan, name, times) for name in plan.plans}
    for a, b in combinations(where, 2):
        apart = float(np.nanmin(gap(where[a] - where[b])))
        assert apart >= SEPARATION - 2e-6
        assert apart >= plan.certificate.separation - 1e-6
    for name, begin in patrols.begins.items():
        one = plan.plans[name]
        assert isinstance(one, SpatialPlan)
        asked = next(member for member in plan.fleet.members if member.name == name)
        assert one.trajectory.start_time == asked.mission.route.depart_s
        start = np.array(one.path.at_distance(0.0))
        assert start == pytest.approx([*asked.mission.route.start.at, GROUND + HALF])
        takeoff = asked.mission.route.takeoff
        assert takeoff is not None
        top = np.array([*start[:2], GROUND + takeoff.to_agl_m])
        assert places(plan, name, np.array([begin - 1e-6, begin + patrols.period])) == (
            pytest.approx(np.array([top, top]), abs=1e-4)
        )
        rates = np.diff(where[name], axis=0) / 0.01
        assert np.linalg.norm(rates, axis=1).max() <= DRONE["max_speed_mps"] + 1e-6
        assert rates[:, 2].max() <= DRONE["max_climb_mps"] + 1e-6
        assert where[name][times > begin, 2].min() >= GROUND + 3.0 - 1e-6  # it stays in the air


@pytest.fixture(scope="module")
def crossing() -> vs.FleetPlan:
    """Two whose laps cross, the second of which sets out later."""
    return planned(patrol(*SQUARE), patrol(*ACROSS, depart_s=3.0))


def test_patrols_take_off_once_and_then_fly_their_laps_for_ever(crossing: vs.FleetPlan) -> None:
    assert crossing.served
    check(crossing)


def test_one_takes_off_beside_one_that_begins_in_the_air_and_one_that_ends() -> None:
    air = {"route": {"start": [10, -10, 61], "via": [[10, 10, 61], [30, 10, 61]], "closed": True}}
    plan = planned(patrol(*SQUARE, depart_s=4.0), air, ride([-20, 10, 10], [40, 12, 11]))
    assert plan.served
    assert plan.patrols is not None
    times = np.arange(0.0, plan.patrols.repeats_from + 2 * plan.patrols.period, 0.01)
    where = [places(plan, name, times) for name in plan.plans]
    assert min(float(np.nanmin(gap(a - b))) for a, b in combinations(where, 2)) >= SEPARATION - 2e-6


def test_one_above_whose_pad_another_flies_takes_off_between_its_laps() -> None:
    """The other one passes 5 m above its pad, on the way to 10 m."""
    plan = planned(patrol(*SQUARE), patrol([-15, 0], [15, 0.01, 5], [-15, 8, 5], up=5.0))
    assert plan.served
    check(plan)


def test_one_that_passes_where_the_laps_of_another_begin_is_told_so() -> None:
    plan = planned(patrol(*SQUARE), patrol([-15, 0], [0, 0.5, 10], [-15, 8, 10]))
    (refused,) = plan.not_served
    assert refused.name == "r1"
    assert "comes back to its start every lap" in refused.reason


def test_the_headings_of_a_lap_are_those_of_every_lap() -> None:
    route = patrol([0, 0], [20, 0, 10], [20, 20, 12])
    route["route"]["start"] = {"at": [0, 0], "look_at": [-9, 3, GROUND]}
    plan = planned(route)
    one = plan.plans["r0"]
    assert isinstance(one, SpatialPlan)
    up, laps = one.airborne[0], one.mission.route.laps
    lap = (one.path.length - up) / laps
    along = np.linspace(0.0, lap, 300)
    facing = one.yaw.at(up + along)
    for k in range(1, laps):
        turned = one.yaw.at(up + k * lap + along[1:-1]) - facing[1:-1]
        assert np.abs(np.sin(turned)).max() < 1e-6
    asked = math.atan2(3, -9)
    assert np.abs(np.sin(one.yaw.at(np.array([0.0, up])) - asked)).max() < 1e-9


def test_a_lap_is_laid_as_it_is_with_its_take_off() -> None:
    plan = vs.plan(vs.Mission.model_validate(
        {"world": WORLD, "robot": DRONE, "route": patrol(*SQUARE)["route"]}))  # fmt: skip
    assert isinstance(plan, SpatialPlan)
    lap = lap_of(plan)
    up = plan.airborne[0]
    assert up == pytest.approx(10.0 - HALF)
    along = np.linspace(0.0, lap.path.length, 200)
    assert np.array(lap.path.at_distance(along)) == pytest.approx(
        np.array(plan.path.at_distance(np.minimum(up + along, plan.path.length))), abs=1e-9
    )
    assert lap.mission.route.takeoff is None


def test_a_saved_plan_of_such_patrols_is_loaded_and_equal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, crossing: vs.FleetPlan
) -> None:
    monkeypatch.setattr(
        "viaspline.report.files.fleet_results.fleet_picture", lambda plan, name: b""
    )
    crossing.save(tmp_path)
    again = vs.load_fleet_plan(tmp_path)
    assert again == crossing


def test_one_that_turns_back_at_its_start_is_loaded_and_equal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It stood too short for its turn there, and alone it was timed otherwise than planned."""
    monkeypatch.setattr(
        "viaspline.report.files.fleet_results.fleet_picture", lambda plan, name: b""
    )
    slow = {**DRONE, "max_vertical_accel_mps2": 0.7, "max_lateral_accel_mps2": 0.8}
    there = patrol([30.73, 14.72], [2.93, 16.67, 13.26], up=9.11)
    farther = patrol([35.2, 49.26], [23.02, 1.98, 19.5], up=12.0)
    named = [{"name": f"r{k}", "robot": "d", **one} for k, one in enumerate((there, farther))]
    data = {"world": WORLD, "separation_m": SEPARATION, "robots": {"d": slow}, "fleet": named}
    plan = vs.plan_fleet(vs.Fleet.model_validate(data))
    assert plan.served
    plan.save(tmp_path)
    assert vs.load_fleet_plan(tmp_path) == plan


def test_a_navigator_leads_them_longer_than_their_plans(crossing: vs.FleetPlan) -> None:
    plan = crossing
    assert plan.patrols is not None
    nav = vs.FleetNavigator(plan, period=0.25)
    come, speed = dict.fromkeys(plan.plans, 0.0), dict.fromkeys(plan.plans, 0.0)
    ups = {name: one.airborne[0] for name, one in plan.plans.items()
           if isinstance(one, SpatialPlan)}  # fmt: skip
    laps = {name: (one.path.length - ups[name]) / one.mission.route.laps
            for name, one in plan.plans.items()}  # fmt: skip
    for time in np.arange(0.0, 6.0 * plan.patrols.period, 0.25):
        reports = [ProgressReport(name, time, come[name], speed[name]) for name in come]
        commands, nav = nav.step(reports, float(time))
        for name, command in commands.items():
            come[name] = max(come[name], min(command.distance, command.granted))
            speed[name] = command.speed
        at = []
        for name, one in plan.plans.items():
            late = come[name] - ups[name]
            along = come[name] if late < 0.0 else ups[name] + late % laps[name]
            at.append(np.asarray(one.path.at_distance(along)))
        assert float(gap(at[0] - at[1])) >= SEPARATION - 1e-6
    for name, one in plan.plans.items():
        assert come[name] > one.path.length + laps[name]


@pytest.mark.parametrize("seed", [0, 1])
def test_whatever_takes_off_stays_apart_for_ever(seed: int) -> None:
    rng = np.random.default_rng(seed)

    def points(count: int) -> list[list[float]]:
        return rng.uniform((0, 0, 4), (30, 30, 18), (count, 3)).round(1).tolist()  # type: ignore[no-any-return]

    robots = []
    for _ in range(3):
        (x, y, up), *via = points(3)
        robots.append(patrol([x, y], *via, up=up, depart_s=float(rng.integers(0, 9))))
    starts = [np.array(one["route"]["start"]) for one in robots]
    if min(np.linalg.norm(a - b) for a, b in combinations(starts, 2)) < 2.5:
        return
    plan = planned(*robots)
    assert all(one.remedy for one in plan.not_served)
    if plan.patrols is not None:
        check(plan)
