"""Missions in space among things that move, against exact gaps of the test's own every 10 ms."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import viaspline as vs
from viaspline.errors import GaveUpError
from viaspline.mission.model import Mission
from viaspline.report.space.spatial_json import spatial_plan_json
from viaspline.space.spatial_plan import SpatialPlan

Floats = NDArray[np.float64]
RADIUS, HALF, CLEARANCE = 0.4, 0.2, 0.8
ROBOT = {"radius_m": RADIUS, "half_height_m": HALF, "clearance_m": CLEARANCE, "max_speed_mps": 4,
         "max_accel_mps2": 1.5, "max_climb_mps": 2, "max_descent_mps": 1}  # fmt: skip


def planned(
    *known: dict[str, Any], robot: dict[str, Any] | None = None, **route: Any
) -> SpatialPlan:
    data = {
        "world": {"known": list(known), "ground": {"flat_m": 0}, "altitude": {"max_m": 40}},
        "robot": {**ROBOT, **(robot or {})},
        "route": {"start": [0, 0, 10], "goal": [40, 0, 10], **route},
    }
    plan = vs.plan(Mission.model_validate(data))
    assert isinstance(plan, SpatialPlan)
    return plan


def ball(
    name: str, radius: float, frames: list[list[float]], after: str = "stay"
) -> dict[str, Any]:
    """A ball along keyframes [t, x, y, z]."""
    rows = [[t, x, y, 0, z] for t, x, y, z in frames]
    return {"name": name, "ball": {"center": [0, 0, 0], "radius": radius},
            "motion": {"keyframes": rows, "after": after}}  # fmt: skip


def places_of(frames: list[list[float]], times: Floats, after: str) -> Floats:
    """Where a ball is, by interpolation of the test's own."""
    rows = np.array(frames)
    period = rows[-1, 0] - rows[0, 0]
    if after == "loop":
        times = rows[0, 0] + np.mod(times - rows[0, 0], period)
    if after == "bounce":
        phase = np.mod(times - rows[0, 0], 2 * period)
        times = rows[0, 0] + np.minimum(phase, 2 * period - phase)
    return np.column_stack([np.interp(times, rows[:, 0], rows[:, k]) for k in (1, 2, 3)])


def gaps(plan: SpatialPlan, radius: float, frames: list[list[float]], after: str) -> Floats:
    """Free space between the body and a ball, every 10 ms of the flight."""
    law = plan.trajectory
    times = np.arange(law.start_time, law.end_time, 0.01)
    off = np.asarray(plan.path.at_distance(law.distance_at(times)))
    off = off - places_of(frames, times, after)
    level = np.maximum(np.hypot(off[:, 0], off[:, 1]) - RADIUS, 0.0)
    return np.hypot(level, np.maximum(np.abs(off[:, 2]) - HALF, 0.0)) - radius


CROSSING = [[0.0, 20.0, -10.0, 10.0], [12.0, 20.0, 14.0, 10.0]]


def test_the_robot_slows_for_what_crosses_its_way() -> None:
    plan = planned(ball("kite", 1.0, CROSSING))
    assert plan.moving is not None
    assert plan.moving.holds
    least = float(gaps(plan, 1.0, CROSSING, "stay").min())
    assert least >= CLEARANCE - 1e-6
    assert plan.moving.clearance <= least + 1e-6
    assert plan.moving.clearance >= least - 0.1
    assert plan.moving.obstacle == "kite"
    assert len(plan.moving.tightest_at) == 3


def test_what_passes_above_is_not_waited_for() -> None:
    above = [[t, x, y, 14.0] for t, x, y, _ in CROSSING]
    plan = planned(ball("kite", 1.0, above))
    free = planned()
    assert plan.trajectory.end_time == free.trajectory.end_time
    assert plan.waits == ()
    assert plan.moving is not None
    assert plan.moving.clearance >= CLEARANCE


def test_what_passes_at_every_height_is_waited_for() -> None:
    cart = {"name": "crane", "circle": {"center": [0, 0], "radius": 1},
            "motion": {"from": [20, -10], "velocity_mps": [0, 1.8]}}  # fmt: skip
    plan = planned(cart)
    (one,) = plan.waits
    assert one.obstacle == "crane"
    assert one.lost > 0.5


def test_what_stays_in_the_way_is_flown_round() -> None:
    frames = [[0.0, 20.0, -10.0, 10.0], [3.0, 20.0, 0.0, 10.0]]
    plan = planned(ball("balloon", 1.5, frames))
    assert plan.path.length > 40.1
    assert gaps(plan, 1.5, frames, "stay").min() >= CLEARANCE - 1e-6


@pytest.mark.parametrize("speed", [0.7, 1.7, 5.0])
def test_what_comes_along_all_of_the_route_is_gone_round_where_it_is_met(speed: float) -> None:
    frames = [[0.0, 60.0, 0.1, 10.0], [80.0 / speed, -20.0, 0.1, 10.0]]
    plan = planned(ball("airship", 2.0, frames))
    assert plan.moving is not None
    assert plan.moving.holds
    assert gaps(plan, 2.0, frames, "stay").min() >= CLEARANCE - 1e-6


def test_a_lift_that_goes_up_and_down_is_passed_when_it_is_away() -> None:
    frames = [[0.0, 20.0, 0.0, 2.0], [4.0, 20.0, 0.0, 25.0]]
    plan = planned(ball("lift", 1.5, frames, "bounce"))
    assert gaps(plan, 1.5, frames, "bounce").min() >= CLEARANCE - 1e-6
    assert plan.trajectory.end_time < 60


def test_the_goal_is_taken_when_it_stays_free_for_as_long_as_is_asked() -> None:
    frames = [[0.0, 40.0, 5.0, 10.0], [20.0, 40.0, 5.0, 10.0], [24.0, 40.0, 0.0, 10.0],
              [30.0, 40.0, 30.0, 10.0]]  # fmt: skip
    assert planned(ball("kite", 1.0, frames)).trajectory.end_time < 15
    plan = planned(ball("kite", 1.0, frames), hold_s=12)
    assert plan.moving is not None
    assert plan.moving.holds
    assert plan.trajectory.end_time > 24
    after = plan.trajectory.end_time + np.arange(0, 12, 0.01)
    off = np.array([40.0, 0.0, 10.0]) - places_of(frames, after, "stay")
    assert np.hypot(off[:, 0], off[:, 1]).min() >= 1.0 + RADIUS + CLEARANCE - 1e-6


@pytest.mark.parametrize("others", [[], [ball("kite", 1.0, CROSSING)]])
def test_the_goal_is_taken_when_it_stays_free_for_the_dwell_there(
    others: list[dict[str, Any]],
) -> None:
    frames = [[0.0, 40.0, 40.0, 10.0], [25.0, 40.0, 12.0, 10.0], [31.0, 40.0, -12.0, 10.0]]
    goal = {"at": [40, 0, 10], "dwell_s": 16}
    plan = planned(ball("guest", 1.0, frames), *others, goal=goal)
    law = plan.trajectory
    assert law.end_time > 40
    assert np.ptp(law.times[law.distances == law.distances[-1]]) == pytest.approx(16)
    assert gaps(plan, 1.0, frames, "stay").min() >= CLEARANCE - 1e-6


def test_the_dwell_at_the_goal_is_kept_by_who_has_slowed() -> None:
    plan = planned(ball("kite", 1.0, CROSSING), goal={"at": [40, 0, 10], "dwell_s": 16})
    law = plan.trajectory
    assert np.ptp(law.times[law.distances == law.distances[-1]]) == pytest.approx(16)


@settings(max_examples=20)
@given(seed=st.integers(0, 100_000))
def test_plans_keep_clear_of_all_that_moves_and_keep_their_limits(seed: int) -> None:
    rng = np.random.default_rng(seed)
    movers = []
    for k in range(int(rng.integers(1, 4))):
        count = int(rng.integers(2, 5))
        times = np.cumsum(rng.uniform(1, 6, count)) - 2.0
        at = rng.uniform((8, -12, 3), (32, 12, 18), (count, 3))
        frames = np.column_stack((times, at)).round(3).tolist()
        after = str(rng.choice(["stay", "bounce"]))
        movers.append((float(rng.uniform(0.3, 1.5)), frames, after, f"m{k}"))
    known = [ball(name, radius, frames, after) for radius, frames, after, name in movers]
    try:
        plan = planned(*known, via=[[20, 0, 12]], depart_s=float(rng.integers(0, 3)))
    except GaveUpError:
        event("gave up")
        return
    assert plan.moving is not None
    assert plan.moving.holds
    assert plan.certificate.holds
    least = min(gaps(plan, radius, frames, after).min() for radius, frames, after, _ in movers)
    assert least >= CLEARANCE - 1e-6
    assert plan.moving.clearance <= least + 1e-6
    law = plan.trajectory
    times = np.arange(law.start_time, law.end_time, 0.01)
    rates = np.diff(np.asarray(plan.path.at_distance(law.distance_at(times))), axis=0) / 0.01
    assert np.linalg.norm(rates, axis=1).max() <= 4 + 1e-6
    assert rates[:, 2].max() <= 2 + 1e-6
    assert rates[:, 2].min() >= -1 - 1e-6


def test_a_loop_that_jumps_is_not_there_while_it_jumps() -> None:
    frames = [[0.0, 20.0, -8.0, 10.0], [5.0, 20.0, 8.0, 10.0]]
    with pytest.warns(vs.MissionWarning, match="jumps by 16 m"):
        plan = planned(ball("drone", 0.5, frames, "loop"))
    assert gaps(plan, 0.5, frames, "loop").min() >= CLEARANCE - 1e-6


def test_what_vanishes_is_in_nobodys_way_then() -> None:
    frames = [[0.0, 20.0, -3.0, 10.0], [1.0, 20.0, 0.0, 10.0]]
    plan = planned(ball("bird", 1.0, frames, "vanish"))
    assert plan.waits == ()
    assert plan.path.length == pytest.approx(40.0)


def test_errors_of_what_moves_are_kept_as_well() -> None:
    sure, unsure = (ball("kite", 1.0, CROSSING) for _ in range(2))
    unsure["motion"]["error"] = {"position_m": 0.5, "growth_mps": 0.1}
    plan = planned(unsure)
    least = float(gaps(plan, 1.0, CROSSING, "stay").min())
    assert least >= CLEARANCE + 0.5
    assert planned(sure).trajectory.end_time <= plan.trajectory.end_time


def test_a_shape_that_turns_counts_as_what_it_sweeps() -> None:
    arm = {"name": "arm", "box": {"min": [-0.5, 0, 8], "max": [0.5, 6, 12]},
           "motion": {"keyframes": [[0, 20, -4, 0, 0], [10, 20, -4, 90, 0]],
                      "after": "stay"}}  # fmt: skip
    plan = planned(arm)
    law = plan.trajectory
    times = np.arange(law.start_time, law.end_time, 0.01)
    off = np.asarray(plan.path.at_distance(law.distance_at(times))) - np.array([20, -4, 10])
    level = np.maximum(np.hypot(off[:, 0], off[:, 1]) - RADIUS - math.hypot(0.5, 6), 0.0)
    kept = np.hypot(level, np.maximum(np.abs(off[:, 2]) - HALF - 2.0, 0.0))
    assert kept.min() >= CLEARANCE - 1e-6


def test_a_limit_of_vertical_acceleration_makes_it_wait_where_it_stands() -> None:
    plan = planned(ball("kite", 1.0, CROSSING), robot={"max_vertical_accel_mps2": 0.5})
    assert gaps(plan, 1.0, CROSSING, "stay").min() >= CLEARANCE - 1e-6


def test_what_comes_over_the_start_is_given_up_in_words() -> None:
    crane = {"name": "crane", "circle": {"center": [0, 0], "radius": 3},
             "motion": {"keyframes": [[0, -1, 0], [5, 0, 0]], "after": "stay"}}  # fmt: skip
    with pytest.raises(GaveUpError, match="no time law past 'crane'"):
        planned(crane)


def test_a_plan_knows_nothing_of_what_moves_unseen() -> None:
    kite = ball("kite", 1.0, CROSSING)
    data = {"world": {"unseen": [kite], "ground": {"flat_m": 0}},
            "robot": {**ROBOT, "sensor": {"range_m": 20}},
            "route": {"start": [0, 0, 10], "goal": [40, 0, 10]}}  # fmt: skip
    plan = vs.plan(Mission.model_validate(data))
    assert plan.path.length == pytest.approx(40.0)
    assert plan.moving is None


def test_the_proof_and_the_waits_are_in_the_plan_and_the_flight_keeps_clear() -> None:
    cart = {"name": "crane", "circle": {"center": [0, 0], "radius": 1},
            "motion": {"from": [20, -10], "velocity_mps": [0, 1.8]}}  # fmt: skip
    plan = planned(cart)
    data = json.loads(spatial_plan_json(plan, "past"))
    assert data["certificate"]["moving"]["obstacle"] == "crane"
    assert data["trajectory"]["waits"][0]["obstacle"] == "crane"
    from viaspline.space.online.fly import fly

    run = fly(plan)
    assert run.reached
    assert plan.moving is not None
    assert run.clearance <= plan.moving.clearance + 1e-9
