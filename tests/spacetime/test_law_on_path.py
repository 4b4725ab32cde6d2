"""Laws past what moves of bodies that are no discs, and of robots that can't slow down anywhere."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

import viaspline as vs

TRUCK = [[-0.3, -0.5], [2.3, -0.5], [2.3, 0.5], [-0.3, 0.5]]
"""About its rear axle."""
CLEARANCE_M, RADIUS_M = 0.2, 0.4


def truck_among(moving: list[dict[str, Any]], **robot: Any) -> vs.Mission:
    keys = {"footprint": TRUCK, "clearance_m": CLEARANCE_M, "max_speed_mps": 1.5} | robot
    route = {"start": [0, 0], "goal": [30, 0]}
    data = {"world": {"known": moving}, "robot": keys, "route": route}
    return vs.Mission.model_validate(data)


def cart(start: list[float], velocity: list[float], name: str = "cart") -> dict[str, Any]:
    motion = {"from": start, "velocity_mps": velocity}
    return {"name": name, "circle": {"center": [0, 0], "radius": RADIUS_M}, "motion": motion}


def least_gap(plan: vs.Plan, moving: list[dict[str, Any]]) -> float:
    """Between the truck and what moves, every hundredth of a second, by shapely [m]."""
    least, body, law = np.inf, shapely.Polygon(TRUCK), plan.trajectory
    for time in np.arange(law.start_time, law.end_time, 0.01):
        u = float(plan.path.parameter(float(law.distance_at(time))))
        heading = np.arctan2(*plan.path.tangent(u)[::-1])
        turned = shapely.affinity.rotate(body, heading, origin=(0, 0), use_radians=True)
        placed = shapely.affinity.translate(turned, *plan.path.evaluate(u))
        for one in moving:
            begin, velocity = (np.array(one["motion"][key]) for key in ("from", "velocity_mps"))
            gap = placed.distance(shapely.Point(begin + time * velocity)) - RADIUS_M
            least = min(least, gap)
    return float(least)


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 10_000))
@example(3)
def test_what_is_proven_of_a_planned_body_is_a_millimetre_below_what_is_sampled(seed: int) -> None:
    rng = np.random.default_rng(seed)
    start = [float(rng.uniform(8, 25)), float(rng.choice([-1, 1]) * rng.uniform(4, 9))]
    velocity = [float(rng.uniform(-0.4, 0.4)), float(-np.sign(start[1]) * rng.uniform(0.3, 1))]
    moving = [cart(start, velocity)]
    try:
        plan = vs.plan(truck_among(moving))
    except vs.GaveUpError:
        assume(False)
    proven = plan.moving_certificate.clearance
    sampled = least_gap(plan, moving)
    assert proven >= CLEARANCE_M - 1e-6
    assert sampled - 0.02 <= proven <= sampled + 1e-6  # it moves by 2 cm between samples


def test_a_long_body_passes_beside_what_comes_along_the_next_lane() -> None:
    """The disc about its rear axle is 2.35 m; beside it the truck needs 1.1 m."""
    moving = [cart([30, 1.4], [-1.0, 0])]
    plan = vs.plan(truck_among(moving))
    alone = vs.plan(truck_among([]))
    assert plan.trajectory.duration == pytest.approx(alone.trajectory.duration)
    assert least_gap(plan, moving) >= CLEARANCE_M


def in_an_alley(moving: list[dict[str, Any]], depart: float) -> vs.Mission:
    """No robot gets past another one; this one has a limit of the jerk, so it waits at stops."""
    robot = {"radius_m": 0.4, "clearance_m": 0.2, "max_speed_mps": 2, "max_jerk_mps3": 1.0}
    world = {"bounds": [-20, -0.7, 60, 0.7], "known": moving}
    route = {"start": [0, 0], "goal": [15, 0], "depart_s": depart}
    return vs.Mission.model_validate({"world": world, "robot": robot, "route": route})


def test_a_robot_that_cant_wait_goes_slowly_between_two_that_are_slow() -> None:
    """The second one is on its way to the start, and the first one doesn't leave its path."""
    moving = [cart([4, 0], [0.6, 0]), cart([-4, 0], [0.6, 0], "van")]
    plan = vs.plan(in_an_alley(moving, 0.0))
    assert plan.moving_certificate.clearance >= 0.2 - 1e-6
    assert plan.trajectory.speeds.max() < 1.0


def test_where_no_law_is_found_a_departure_is_told_that_serves() -> None:
    moving = [cart([9, 0], [-1.0, 0])]  # towards the start, and through it
    with pytest.raises(vs.PlanningError) as told:
        vs.plan(in_an_alley(moving, 0.0))
    words = re.search(r"route.depart_s: ([\d.]+)", str(told.value))
    assert words is not None
    plan = vs.plan(in_an_alley(moving, float(words[1])))
    assert plan.moving_certificate.holds
