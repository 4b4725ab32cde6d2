"""Fleets in space as wholes, against exact gaps of the test's own, seen every 10 ms."""

from __future__ import annotations

import math
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import viaspline as vs
from viaspline.errors import GeometryError
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.space.spatial_plan import SpatialPlan

Floats = NDArray[np.float64]
SLACK = 2e-6
FLAT = {"radius_m": 0.4, "half_height_m": 0.2, "clearance_m": 0.5, "max_speed_mps": 4,
        "max_accel_mps2": 1.5, "max_climb_mps": 2, "max_descent_mps": 1}  # fmt: skip
BALL = {"radius_m": 0.5, "clearance_m": 0.3, "max_speed_mps": 3, "max_accel_mps2": 2,
        "tracking_error_m": 0.1}  # fmt: skip


def drone(name: str, *points: Any, **more: Any) -> dict[str, Any]:
    start, *via, goal = points
    return {"name": name, "robot": "flat", "route": {"start": start, "via": via, "goal": goal},
            **more}  # fmt: skip


def planned(*robots: dict[str, Any], separation: float = 1.0, **world: Any) -> FleetPlan:
    plan = vs.plan_fleet(vs.Fleet.model_validate({
        "world": world, "separation_m": separation, "robots": {"flat": FLAT, "ball": BALL},
        "fleet": list(robots),
    }))  # fmt: skip
    assert isinstance(plan, FleetPlan)
    return plan


def size(plan: SpatialPlan) -> tuple[float, float, float]:
    """Radius, half height and margin of its body."""
    robot = plan.mission.robot
    off = robot.tracking_error_m or 0.0
    if robot.half_height_m is None:
        return 0.0, 0.0, robot.radius_m + off
    return robot.radius_m, robot.half_height_m, off


def places(plan: SpatialPlan, times: Floats) -> Floats:
    return np.asarray(plan.path.at_distance(plan.trajectory.distance_at(times)))


def gaps(plan: FleetPlan) -> tuple[Floats, Floats]:
    """Instants and the least free space between any two bodies then."""
    flown = list(plan.plans.items())
    end = max(one.trajectory.end_time for _, one in flown)
    times = np.arange(0.0, end + 0.01, 0.01)
    least = np.full(len(times), math.inf)
    leaves = {one.name for one in plan.fleet.members if one.rest == "leave"}
    for (a, one), (b, other) in combinations(flown, 2):
        assert isinstance(one, SpatialPlan)
        assert isinstance(other, SpatialPlan)
        off = places(one, times) - places(other, times)
        (r, h, m), (s, g, n) = size(one), size(other)
        level = np.maximum(np.hypot(off[:, 0], off[:, 1]) - r - s, 0.0)
        upright = np.maximum(np.abs(off[:, 2]) - h - g, 0.0)
        there = np.ones(len(times), bool)
        for name, its in ((a, one), (b, other)):
            if name in leaves:
                there &= times <= its.trajectory.end_time
        least = np.minimum(least, np.where(there, np.hypot(level, upright) - m - n, math.inf))
    return times, least


def check(plan: FleetPlan, separation: float) -> None:
    """Bodies are apart, the proof isn't above what is seen and little below, limits are kept."""
    if len(plan.plans) > 1:
        _, least = gaps(plan)
        assert least.min() >= separation - SLACK
        assert plan.certificate.holds
        if not plan.not_served:
            assert plan.certificate.separation <= least.min() + 1e-6
            assert plan.certificate.separation >= least.min() - 0.1
    for one in plan.plans.values():
        assert isinstance(one, SpatialPlan)
        assert one.certificate.holds
        law, robot = one.trajectory, one.mission.robot
        times = np.arange(law.start_time, law.end_time, 0.01)
        along = np.asarray(law.distance_at(times))
        assert (np.diff(along) >= -1e-9).all()
        at = places(one, times)
        rates = np.diff(at, axis=0) / 0.01
        assert np.linalg.norm(rates, axis=1).max(initial=0.0) <= robot.max_speed_mps + 1e-6
        assert rates[:, 2].max(initial=0.0) <= robot.climb_speed + 1e-6
        assert rates[:, 2].min(initial=0.0) >= -robot.descent_speed - 1e-6


def fleet_of(seed: int) -> tuple[list[dict[str, Any]], float]:
    """Robots at random places of a small room, apart where they start and end."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 6))
    taken: list[Floats] = []

    def place() -> list[float]:
        while True:
            at = rng.uniform((0, 0, 3), (25, 25, 15)).round(2)
            if all(np.linalg.norm(at - other) > 4.5 for other in taken):
                taken.append(at)
                return at.tolist()  # type: ignore[no-any-return]

    robots = []
    for k in range(count):
        via = [place()] if rng.random() < 0.3 else []
        robots.append(
            drone(f"d{k}", place(), *via, place(), robot=str(rng.choice(["flat", "ball"])),
                  rest=str(rng.choice(["stay", "leave"])), depart_s=float(rng.integers(0, 3)),
                  priority=float(rng.integers(0, 3)))
        )  # fmt: skip
    return robots, float(rng.uniform(0.3, 2.0))


@settings(max_examples=25)
@given(seed=st.integers(0, 100_000))
def test_robots_stay_apart_and_within_their_limits(seed: int) -> None:
    robots, separation = fleet_of(seed)
    plan = planned(*robots, separation=separation)
    check(plan, separation)
    assert plan.served


def test_two_pass_one_above_the_other_without_waiting() -> None:
    plan = planned(drone("a", [0, 0, 10], [40, 0, 10]), drone("b", [20, -20, 12], [20, 20, 12]))
    assert plan.precedences == ()
    assert plan.certificate.separation == pytest.approx(1.6, abs=2e-3)


def test_one_waits_where_they_are_too_near_above_each_other() -> None:
    plan = planned(drone("a", [0, 0, 10], [40, 0, 10]), drone("b", [20, -20, 11], [20, 20, 11]))
    (one,) = plan.precedences
    assert one.waits_s > 0.0
    check(plan, 1.0)


def test_who_has_priority_passes_first() -> None:
    robots = [drone("a", [0, 0, 10], [40, 0, 10]),
              drone("b", [20, -20, 10], [20, 20, 10], priority=1)]  # fmt: skip
    (one,) = planned(*robots).precedences
    assert (one.first, one.second) == ("b", "a")


def test_two_that_change_places_are_led_round_each_other() -> None:
    plan = planned(drone("a", [0, 0, 10], [40, 0, 10]), drone("b", [40, 0, 10], [0, 0, 10]))
    assert plan.served
    check(plan, 1.0)


def test_it_is_told_that_other_paths_are_sought() -> None:
    told: list[tuple[str, float]] = []
    one, other = [0, 0, 5], [40, 0, 5]
    fleet = vs.Fleet.model_validate({
        "separation_m": 1.0, "robots": {"flat": FLAT},
        "fleet": [drone("a", one, other), drone("b", other, one)],
    })  # fmt: skip
    assert vs.plan_fleet(fleet, progress=lambda stage, share: told.append((stage, share))).served
    assert "looking for other paths" in dict(told)
    assert all(0.0 <= share <= 1.0 for _, share in told)


def test_a_path_goes_round_a_robot_that_hovers() -> None:
    plan = planned(drone("a", [0, 0, 10], [40, 0, 10]),
                   drone("b", [20, 0.3, 10], [20, 30, 10], depart_s=1000))  # fmt: skip
    assert plan.plans["a"].trajectory.end_time < 60
    assert plan.plans["a"].path.length > 40.05
    check(plan, 1.0)


def test_take_off_and_landing_side_by_side_are_apart() -> None:
    def there(name: str, y: float) -> dict[str, Any]:
        route = {"start": [0, y], "takeoff": {"to_agl_m": 8}, "via": [[20, 0, 8]],
                 "land": {"at": [40, y]}}  # fmt: skip
        return {"name": name, "robot": "flat", "route": route}

    plan = planned(there("a", 0), there("b", 2), there("c", 4), ground={"flat_m": 0})
    assert plan.served
    check(plan, 1.0)


def test_robots_go_round_what_stands_and_past_each_other() -> None:
    tower = {"circle": {"center": [20, 0], "radius": 4}, "height_m": [0, 30]}
    plan = planned(drone("a", [0, 0, 10], [40, 0, 10]), drone("b", [40, 1, 12], [0, 2, 9]),
                   drone("c", [20, -15, 10], [20, 15, 11]), known=[tower])  # fmt: skip
    assert plan.served
    check(plan, 1.0)
    for one in plan.plans.values():
        at = np.asarray(one.path.at_distance(np.linspace(0, one.path.length, 4000)))
        assert (np.hypot(at[:, 0] - 20, at[:, 1]) - 4.4).min() >= 0.5 - 1e-6


def test_a_robot_with_a_limit_of_vertical_acceleration_waits_where_it_stands() -> None:
    robots = [drone("a", [0, 0, 10], [40, 0, 10], priority=1),
              drone("b", [20, -20, 10], [20, 20, 10])]  # fmt: skip
    data = {"separation_m": 1, "robots": {"flat": {**FLAT, "max_vertical_accel_mps2": 0.5}},
            "fleet": robots}  # fmt: skip
    plan = vs.plan_fleet(vs.Fleet.model_validate(data))
    check(plan, 1.0)
    assert plan.served
    law = plan.plans["b"].trajectory
    assert law.start_time == 0.0
    assert float(law.distance_at(plan.precedences[0].waits_s * 0.9)) == pytest.approx(0.0, abs=1e-6)


def test_a_robot_without_a_path_is_named_with_the_reason_and_stands_in_the_way() -> None:
    cage = {"box": {"min": [-3, -3, 5], "max": [3, 3, 7]}}
    walls = [
        {"box": {"min": [-3, -3, 0], "max": [3, -2.5, 7]}},
        {"box": {"min": [-3, 2.5, 0], "max": [3, 3, 7]}},
        {"box": {"min": [-3, -3, 0], "max": [-2.5, 3, 7]}},
        {"box": {"min": [2.5, -3, 0], "max": [3, 3, 7]}},
    ]
    plan = planned(drone("shut in", [0, 0, 2.5], [30, 0, 10]), drone("free", [0, 9, 3], [30, 9, 3]),
                   known=[cage, *walls], ground={"flat_m": 0}, altitude={"max_m": 40})  # fmt: skip
    assert list(plan.plans) == ["free"]
    (missing,) = plan.not_served
    assert missing.name == "shut in"
    assert missing.outcome in ("refused", "gave up")
    assert not plan.served


def test_two_that_both_have_to_hold_one_place_for_good_are_given_up_in_words() -> None:
    blocker = drone("b", [20, 0, 10], [20, 0.5, 10.2])
    plan = planned(blocker, drone("a", [0, 0, 10], [20, 0.2, 10], [40, 0, 10]))
    (missing,) = plan.not_served
    assert missing.outcome == "gave up"
    assert "'" in missing.reason
    assert missing.obstacles
    assert not plan.served


def test_a_plan_with_sooner_orders_is_no_later_in_all() -> None:
    robots, separation = fleet_of(7)
    data = {"separation_m": separation, "robots": {"flat": FLAT, "ball": BALL}, "fleet": robots}
    fleet = vs.Fleet.model_validate(data)
    first, sooner = vs.plan_fleet(fleet), vs.plan_fleet(fleet, improve=0.5)
    ends = [sum(one.trajectory.end_time for one in each.plans.values()) for each in (first, sooner)]
    assert ends[1] <= ends[0] + 1e-9
    check(sooner, separation)


def test_the_same_fleet_gets_the_same_plan() -> None:
    robots, separation = fleet_of(11)
    one, other = (planned(*robots, separation=separation) for _ in range(2))
    assert one.certificate == other.certificate
    for name in one.plans:
        assert np.array_equal(one.plans[name].path.spans, other.plans[name].path.spans)
        assert np.array_equal(one.plans[name].trajectory.times, other.plans[name].trajectory.times)


def test_paths_of_the_plane_are_not_laid_for_a_fleet_in_space() -> None:
    from viaspline.fleet.crossing_paths import crossing_paths

    fleet = vs.Fleet.model_validate({
        "robots": {"flat": FLAT}, "fleet": [drone("a", [0, 0, 9], [9, 0, 9])],
    })  # fmt: skip
    with pytest.raises(GeometryError, match="this is a fleet in space"):
        crossing_paths(fleet)
