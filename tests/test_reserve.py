"""Turns that steering reaches only at its stop leave nothing to correct with."""

from __future__ import annotations

import math

import pytest

import viaspline as vs
from viaspline.machine.steering_reserve import ENOUGH_RESERVE, roomy_turn_radius
from viaspline.machine.trial_drive import trackings
from viaspline.mission.drives.drive import Drive

WHEELBASE, STOP = 1.7, math.radians(32)
CIRCLE = WHEELBASE / math.tan(STOP)


def through_a_gate(half_width: float, apart: float = 6.0) -> vs.Mission:
    """Round in a bend as tight as the steering allows, and back through a gate beside the start."""
    low = 10 - half_width
    walls = [
        {"polygon": [[8, 10 + half_width], [9, 10 + half_width], [9, 20], [8, 20]]},
        {"polygon": [[8, low - 0.4], [9, low - 0.4], [9, low], [8, low]]},
    ]
    steering = {"wheelbase_m": WHEELBASE, "max_steer_deg": math.degrees(STOP)}
    noise = {"delay_s": 0.1, "lag_s": 0.1, "speed_noise_mps": 0.05, "yaw_rate_noise_degps": 6.0}
    robot = {
        "radius_m": 0.5,
        "clearance_m": 0.1,
        "drive": {"ackermann": steering, **noise},
        "localization": {"position_noise_m": 0.03, "heading_noise_deg": 1.0},
    }
    route = {
        "start": {"at": [5, 10 - apart], "heading_deg": 0},
        "via": [[20, 10 - apart], [20, 10]],
        "goal": {"at": [5, 10], "heading_deg": 180},
    }
    world = {"bounds": [0, -6, 34, 20], "known": walls}
    return vs.Mission.model_validate({"world": world, "robot": robot, "route": route})


def a_turn_in_a_court(room: float, depth: float, apart: float) -> vs.Mission:
    """Back to beside the start, by a turn between walls so far away [m]."""
    gate = through_a_gate(1.6, apart).model_dump(exclude_defaults=True, exclude_none=True)
    gate["world"] = {"bounds": [0, 10 - apart - room, depth, 10 + room]}
    gate["route"]["via"] = []
    return vs.Mission.model_validate(gate)


def beyond_what_is_kept(plan: vs.Plan, drives: int) -> int:
    """How many drives get farther beside a path than it keeps, by seeds that no trial has."""
    followed = trackings(plan.path, plan.trajectory, plan.mission.robot, range(drives))
    return sum(off.body_deviation(0.0) > plan.tracking_error for off, _ in followed)


def test_turns_leave_the_steering_that_noise_asks_for() -> None:
    """Turns as tight as they can be were no sooner driven, and 1.2 m were kept for the drift."""
    mission = a_turn_in_a_court(room=8.0, depth=30.0, apart=3.0)
    plan, circle = vs.plan(mission), roomy_turn_radius(mission.robot)
    assert 1.3 * CIRCLE < circle < 1.7 * CIRCLE
    assert plan.mission.robot.turn_radius == pytest.approx(circle)
    assert plan.path.max_curvature()[0] * circle <= 1.0 + 1e-6
    assert 0.1 < plan.tracking_error < 0.5
    assert beyond_what_is_kept(plan, 100) <= 1


@pytest.mark.slow
def test_where_the_error_at_full_lock_would_not_fit_the_turns_are_wider() -> None:
    """With turns that were wider by a fifth, a quarter of drives got farther off than was kept."""
    plan = vs.plan(through_a_gate(1.1, apart=3.0))
    assert beyond_what_is_kept(plan, 200) <= 5
    run = vs.simulate(plan.mission, plan=plan, seed=0)
    assert run.reached
    assert run.certificate.holds
    assert run.tracking is not None
    assert run.tracking.body_deviation(0.0) <= plan.tracking_error


def test_where_the_widest_turns_take_too_long_those_that_leave_half_are_taken() -> None:
    mission = a_turn_in_a_court(room=5.0, depth=12.0, apart=7.0)
    plan = vs.plan(mission)
    half = roomy_turn_radius(mission.robot, 0.5 * ENOUGH_RESERVE)
    assert plan.mission.robot.turn_radius == pytest.approx(half)
    assert CIRCLE < half < roomy_turn_radius(mission.robot)
    assert beyond_what_is_kept(plan, 60) <= 1


def test_where_wider_turns_would_take_far_longer_more_is_kept_for_tight_ones() -> None:
    plan = vs.plan(a_turn_in_a_court(room=3.0, depth=18.0, apart=6.0))
    assert plan.mission.robot.min_turn_radius_m is None
    assert plan.tracking_error > 1.0
    assert beyond_what_is_kept(plan, 60) <= 1


def test_where_nothing_is_random_turns_are_as_tight_as_the_steering_allows() -> None:
    mission = a_turn_in_a_court(room=3.0, depth=18.0, apart=6.0)
    drive = {"ackermann": {"wheelbase_m": WHEELBASE, "max_steer_deg": math.degrees(STOP)}}
    still = mission.robot.model_copy(update={"drive": Drive(**drive), "localization": None})
    plan = vs.plan(mission.model_copy(update={"robot": still}))
    assert plan.mission.robot.min_turn_radius_m is None
    assert plan.path.max_curvature()[0] * CIRCLE > 0.9


def test_where_nothing_fits_the_first_reason_is_told() -> None:
    with pytest.raises(vs.GaveUpError, match="via point 'goal'") as told:
        vs.plan(through_a_gate(0.55))
    assert told.value.remedy
