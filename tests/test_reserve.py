"""A turning circle that steering reaches only at its stop leaves nothing to correct with."""

from __future__ import annotations

import math

import pytest

import viaspline as vs

WHEELBASE, STOP = 1.7, math.radians(32)


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


def test_where_the_error_at_full_lock_would_not_fit_the_turns_are_wider() -> None:
    plan = vs.plan(through_a_gate(1.1, apart=3.0))
    circle = WHEELBASE / math.tan(STOP)
    assert plan.mission.robot.turn_radius == pytest.approx(1.2 * circle)
    assert plan.path.max_curvature()[0] * 1.2 * circle <= 1.0
    assert 0.1 < plan.tracking_error < 0.5
    run = vs.simulate(plan.mission, plan=plan, seed=0)
    assert run.reached
    assert run.certificate.holds
    assert run.tracking is not None
    assert run.tracking.body_deviation(0.0) <= plan.tracking_error


def test_where_there_is_room_for_it_the_circle_stays_what_the_steering_allows() -> None:
    plan = vs.plan(through_a_gate(1.6))
    assert plan.mission.robot.min_turn_radius_m is None
    assert plan.tracking_error > 0.2


def test_where_nothing_fits_the_first_reason_is_told() -> None:
    with pytest.raises(vs.NoPathError) as refused:
        vs.plan(through_a_gate(0.55))
    assert refused.value.remedy
