"""Fleets in space among things that move, against exact gaps of the test's own, every 10 ms."""

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
from viaspline.fleet.execution.delays import Delays
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.space import timed_past_moving
from viaspline.space.spatial_plan import SpatialPlan

Floats = NDArray[np.float64]
SLACK = 2e-6
KINDS = {
    "flat": {"radius_m": 0.4, "half_height_m": 0.2, "clearance_m": 0.5, "max_speed_mps": 4,
             "max_accel_mps2": 1.5, "max_climb_mps": 2, "max_descent_mps": 1},
    "ball": {"radius_m": 0.5, "clearance_m": 0.2, "max_speed_mps": 3, "max_accel_mps2": 2,
             "tracking_error_m": 0.1},
}  # fmt: skip


def drone(name: str, *points: Any, robot: str = "flat", **more: Any) -> dict[str, Any]:
    start, *via, goal = points
    route = {"start": start, "via": via, "goal": goal, **more.pop("route", {})}
    return {"name": name, "robot": robot, "route": route, **more}


def ball(start: Any, velocity: Any, radius: float = 1.5, name: str = "balloon") -> dict[str, Any]:
    return {"name": name, "ball": {"center": [0, 0, 0], "radius": radius},
            "motion": {"from": start, "velocity_mps": velocity}}  # fmt: skip


def lift(frames: list[list[float]], after: str, radius: float, half: float) -> dict[str, Any]:
    """A cylinder that goes from keyframe to keyframe: each of time, x, y, z."""
    return {"name": "lift", "circle": {"center": [0, 0], "radius": radius},
            "height_m": [-half, half],
            "motion": {"keyframes": [[t, x, y, 0, z] for t, x, y, z in frames],
                       "after": after}}  # fmt: skip


def fleet_of(*robots: dict[str, Any], moving: list[dict[str, Any]], separation: float = 1.0,
             **world: Any) -> vs.Fleet:  # fmt: skip
    return vs.Fleet.model_validate({
        "world": {"known": moving, **world}, "separation_m": separation, "robots": KINDS,
        "fleet": list(robots),
    })  # fmt: skip


def body(plan: SpatialPlan) -> tuple[float, float, float]:
    """Radius, half height and margin of a robot."""
    robot = plan.mission.robot
    off = robot.tracking_error_m or 0.0
    if robot.half_height_m is None:
        return 0.0, 0.0, robot.radius_m + off
    return robot.radius_m, robot.half_height_m, off


def gap(off: Floats, one: tuple[float, float, float], other: tuple[float, float, float]) -> Floats:
    """Free space between two upright cylinders with margins."""
    level = np.maximum(np.hypot(off[:, 0], off[:, 1]) - one[0] - other[0], 0.0)
    upright = np.maximum(np.abs(off[:, 2]) - one[1] - other[1], 0.0)
    return np.asarray(np.hypot(level, upright) - one[2] - other[2])


def thing_at(thing: dict[str, Any], times: Floats) -> Floats:
    """Where something is, by formulas of the test's own."""
    motion = thing["motion"]
    if "from" in motion:
        return np.asarray(motion["from"]) + times[:, None] * np.asarray(motion["velocity_mps"])
    frames = np.array([[f[0], f[1], f[2], f[4]] for f in motion["keyframes"]], np.float64)
    span = frames[-1, 0] - frames[0, 0]
    late = times - frames[0, 0]
    if motion["after"] == "bounce":
        late = span - np.abs(late % (2 * span) - span)
    elif motion["after"] == "loop":
        late = late % span
    late = late + frames[0, 0]
    return np.column_stack([np.interp(late, frames[:, 0], frames[:, k]) for k in (1, 2, 3)])


def size_of(thing: dict[str, Any]) -> tuple[float, float, float]:
    if "ball" in thing:
        return 0.0, 0.0, thing["ball"]["radius"]
    low, high = thing["height_m"]
    return thing["circle"]["radius"], 0.5 * (high - low), 0.0


def check(plan: FleetPlan, moving: list[dict[str, Any]], separation: float = 1.0) -> None:
    """Robots are clear of what moves while they are asked to be, and of each other always."""
    members = {one.name: one for one in plan.fleet.members}
    end = max((one.trajectory.end_time for one in plan.plans.values()), default=0.0)
    times = np.arange(0.0, end + 30.0, 0.01)
    places = {}
    for name, one in plan.plans.items():
        assert isinstance(one, SpatialPlan)
        law = one.trajectory
        at = np.asarray(one.path.at_distance(law.distance_at(times)))
        places[name] = at
        stays = members[name].rest == "stay"
        until = law.end_time + (one.mission.route.hold_s if stays else 0.0)
        flies = (times >= law.start_time) & (times <= until)
        least = min(
            float(gap((thing_at(thing, times) - at)[flies], body(one), size_of(thing)).min())
            for thing in moving
        )
        assert least >= one.mission.robot.clearance_m - SLACK
        assert one.moving is not None
        assert one.moving.holds
        assert one.moving.clearance <= least + 1e-6
        rates = np.diff(at[flies], axis=0) / 0.01
        robot = one.mission.robot
        assert np.linalg.norm(rates, axis=1).max(initial=0.0) <= robot.max_speed_mps + 1e-6
        assert rates[:, 2].max(initial=0.0) <= robot.climb_speed + 1e-6
        assert law.start_time == members[name].mission.route.depart_s
    for a, b in combinations(places, 2):
        one, other = plan.plans[a], plan.plans[b]
        there = np.ones(len(times), bool)
        for name, its in ((a, one), (b, other)):
            if members[name].rest == "leave":
                there &= times <= its.trajectory.end_time
        assert isinstance(one, SpatialPlan)
        assert isinstance(other, SpatialPlan)
        apart = gap(places[a] - places[b], body(one), body(other))
        assert np.where(there, apart, math.inf).min() >= separation - SLACK
    if len(places) > 1:
        assert plan.certificate.holds


CROSSING = (drone("a", [0, 0, 10], [40, 0, 10]), drone("b", [20, -20, 10], [20, 20, 10]))


def test_robots_that_cross_let_what_moves_pass_as_well() -> None:
    moving = [ball([8, -16, 10], [0, 4, 0])]
    plan = vs.plan_fleet(fleet_of(*CROSSING, moving=moving))
    assert plan.served
    check(plan, moving)
    bare = vs.plan_fleet(fleet_of(*CROSSING, moving=[ball([500, 0, 10], [0, 1, 0])]))
    assert plan.plans["a"].trajectory.end_time > bare.plans["a"].trajectory.end_time


def test_robots_that_nothing_comes_near_fly_as_if_nothing_moved() -> None:
    plan = vs.plan_fleet(fleet_of(*CROSSING, moving=[ball([500, 0, 10], [0, 1, 0])]))
    still = vs.plan_fleet(fleet_of(*CROSSING, moving=[]))
    for name, one in still.plans.items():
        assert plan.plans[name].trajectory.times.tolist() == one.trajectory.times.tolist()


def test_each_keeps_its_own_clearance() -> None:
    """A ball keeps 0.2 m and passes below; a flat one keeps 0.5 m and can't."""
    moving = [ball([-30, 0, 12.35], [2, 0, 0])]
    robots = [drone("low", [0, -9, 10], [0, 9, 10], robot="ball")]
    plan = vs.plan_fleet(fleet_of(*robots, moving=moving))
    check(plan, moving)
    alone = plan.plans["low"].trajectory
    other = [drone("high", [6, -9, 10], [6, 9, 10]), *robots]
    both = vs.plan_fleet(fleet_of(*other, moving=moving))
    check(both, moving)
    assert both.plans["low"].trajectory.times.tolist() == alone.times.tolist()


def test_what_passes_a_goal_later_than_asked_doesnt_keep_a_robot_from_it() -> None:
    moving = [lift([[0, 40, -60, 10], [60, 40, 60, 10]], "bounce", 1.0, 1.0)]
    early, long = (
        vs.plan_fleet(fleet_of(drone("a", [0, 0, 10], [40, 0, 10], route={"hold_s": hold}),
                               moving=moving)) for hold in (0.0, 30.0)
    )  # fmt: skip
    check(early, moving)
    check(long, moving)
    assert early.plans["a"].trajectory.end_time < 15.0
    assert long.plans["a"].trajectory.end_time > 30.0


def test_what_passes_a_start_before_its_robot_may_depart_doesnt_matter() -> None:
    moving = [ball([0, -20, 10], [0, 4, 0])]
    plan = vs.plan_fleet(fleet_of(drone("a", [0, 0, 10], [40, 0, 10], depart_s=9), moving=moving))
    assert plan.served
    check(plan, moving)
    over = vs.plan_fleet(fleet_of(drone("a", [0, 0, 10], [40, 0, 10], depart_s=5), moving=moving))
    assert [one.name for one in over.not_served] == ["a"]


def test_what_moves_is_looked_at_for_longer_where_robots_wait_longer(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(timed_past_moving, "WATCHED_S", 0.0)
    monkeypatch.setattr(timed_past_moving, "WATCHED_SHARE", 1.0)
    moving = [ball([12, -14, 10], [0, 2, 0], radius=2.0)]
    plan = vs.plan_fleet(fleet_of(*CROSSING, moving=moving))
    assert plan.served
    check(plan, moving)
    late = [one.trajectory.end_time - plan.alone[name] for name, one in plan.plans.items()]
    assert max(late) > 0.0


def test_one_that_comes_head_on_all_the_time_is_led_round() -> None:
    moving = [lift([[0, 40, 0, 10], [10, 0, 0, 10]], "bounce", 1.0, 1.0)]
    plan = vs.plan_fleet(
        fleet_of(drone("a", [-5, 0, 10], [45, 0, 10]), drone("b", [20, -9, 10], [20, 9, 10]),
                 moving=moving)
    )  # fmt: skip
    assert plan.served
    check(plan, moving)


def test_a_patrol_among_things_that_move_is_told_to_end() -> None:
    route = {"start": [0, 0, 9], "via": [[9, 0, 9], [9, 9, 9]], "closed": True}
    moving = [ball([500, 0, 10], [0, 1, 0])]
    plan = vs.plan_fleet(fleet_of({"name": "round", "robot": "flat", "route": route},
                                  drone("a", [0, 20, 9], [20, 20, 9]), moving=moving))  # fmt: skip
    (missing,) = plan.not_served
    assert missing.name == "round"
    assert "number of laps" in missing.remedy
    assert list(plan.plans) == ["a"]


def test_sooner_orders_are_clear_of_what_moves_too() -> None:
    robots, moving, separation = random_fleet(5)
    fleet = fleet_of(*robots, moving=moving, separation=separation)
    first, sooner = vs.plan_fleet(fleet), vs.plan_fleet(fleet, improve=0.3)
    check(sooner, moving, separation)
    ends = [sum(one.trajectory.end_time for one in each.plans.values()) for each in (first, sooner)]
    assert ends[1] <= ends[0] + 1e-9


def test_a_drive_keeps_to_the_clock_and_delays_are_refused() -> None:
    fleet = fleet_of(*CROSSING, moving=[ball([8, -16, 10], [0, 4, 0])])
    plan = vs.plan_fleet(fleet)
    run = vs.simulate_fleet(fleet, plan=plan)
    assert run.reached
    with pytest.raises(GeometryError, match="waits for nobody"):
        vs.simulate_fleet(fleet, Delays(slowed=0.3), plan)


def random_fleet(seed: int) -> tuple[list[dict[str, Any]], list[dict[str, Any]], float]:
    """Robots at random places, apart where they start and end, and things that wander."""
    rng = np.random.default_rng(seed)
    taken: list[Floats] = []

    def place() -> list[float]:
        while True:
            at = rng.uniform((0, 0, 3), (25, 25, 15)).round(2)
            if all(np.linalg.norm(at - other) > 4.5 for other in taken):
                taken.append(at)
                return at.tolist()  # type: ignore[no-any-return]

    moving = []
    for _ in range(int(rng.integers(1, 4))):
        at = rng.uniform((0, 0, 3), (25, 25, 15)).round(2)
        if rng.random() < 0.5:
            way = rng.uniform(-3, 3, 3).round(2)
            moving.append(ball((at - 4.0 * way).tolist(), way.tolist(), name=f"b{len(moving)}"))
            continue
        frames = [[float(4 * k), *rng.uniform((0, 0, 3), (25, 25, 15)).round(2).tolist()]
                  for k in range(3)]  # fmt: skip
        after = str(rng.choice(["bounce", "stay"]))
        moving.append(lift(frames, after, 1.0, 0.8) | {"name": f"l{len(moving)}"})
    robots = [
        drone(f"d{k}", place(), *([place()] if rng.random() < 0.3 else []), place(),
              robot=str(rng.choice(["flat", "ball"])), rest=str(rng.choice(["stay", "leave"])),
              depart_s=float(rng.integers(0, 3)), priority=float(rng.integers(0, 3)))
        for k in range(int(rng.integers(2, 5)))
    ]  # fmt: skip
    return robots, moving, float(rng.uniform(0.3, 2.0))


@settings(max_examples=8, deadline=None)
@given(seed=st.integers(0, 100_000))
def test_whatever_is_served_is_clear_of_what_moves_and_apart(seed: int) -> None:
    robots, moving, separation = random_fleet(seed)
    plan = vs.plan_fleet(fleet_of(*robots, moving=moving, separation=separation))
    check(plan, moving, separation)
    for one in plan.not_served:
        assert one.reason
        assert one.remedy
