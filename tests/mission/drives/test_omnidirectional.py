"""A body that goes any way: what it is told, what it keeps, and what it drives, seen from outside.

What is driven is judged by places, headings and times alone.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.trial_drive import Track, follow
from viaspline.mission.drives.omnidirectional import Omnidirectional
from viaspline.mission.robot_parts import RobotSpec
from viaspline.trajectory.retime import retime

ALONG, ACROSS = 1.0, 0.4


def drive(held_deg: float | None = None, **more: Any) -> dict[str, Any]:
    speeds = {"max_speed_along_mps": ALONG, "max_speed_across_mps": ACROSS}
    held = {} if held_deg is None else {"hold_heading_deg": held_deg}
    return {"omnidirectional": speeds | held, "delay_s": 0.05, "lag_s": 0.1, **more}


def robot(held_deg: float | None = None, **more: Any) -> dict[str, Any]:
    body = {"radius_m": 0.3, "clearance_m": 0.2, "max_speed_mps": 2.0, "max_accel_mps2": 1.0}
    return {**body, "drive": drive(held_deg, **more)}


def mission(held_deg: float | None = None, **more: Any) -> vs.Mission:
    route = {"start": [0, 0], "via": [[6, 4], {"at": [12, -2], "dwell_s": 2}], "goal": [18, 3]}
    data = {"robot": robot(held_deg), "route": route, **more}
    return vs.Mission.model_validate(data)


def in_the_body(positions: Any, headings: Any, times: Any) -> np.ndarray:
    """Mean velocities along and across a body between rows [m/s], from places and headings."""
    kept = np.concatenate(([True], np.diff(times) > 1e-4))
    positions, headings, times = positions[kept], headings[kept], times[kept]
    velocity = np.diff(positions, axis=0) / np.diff(times)[:, None]
    middle = 0.5 * (np.unwrap(headings)[1:] + np.unwrap(headings)[:-1])
    cosine, sine = np.cos(middle), np.sin(middle)
    along = cosine * velocity[:, 0] + sine * velocity[:, 1]
    return np.column_stack((along, cosine * velocity[:, 1] - sine * velocity[:, 0]))


def driven(path: vs.PiecewiseCubic, spec: RobotSpec) -> Track:
    return follow(path, retime(path, limits_of(spec)), spec)


@given(st.floats(-360.0, 360.0), st.integers(0, 2**32 - 1))
@settings(max_examples=12, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_along_and_across_its_held_heading_it_is_never_too_fast(held: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = np.array([(0, 0), (5, 3), (10, -3), (15, 2)]) + rng.uniform(-1.5, 1.5, (4, 2))
    path = vs.CardinalSpline(points, tangents="continuous")
    track = driven(path, RobotSpec.model_validate(robot(held)))
    assert track.finished
    speeds = np.abs(in_the_body(track.positions, track.headings, track.times))
    assert speeds[:, 0].max() <= ALONG + 1e-6
    assert speeds[:, 1].max() <= ACROSS + 1e-6
    assert max(speeds[:, 0].max() / ALONG, speeds[:, 1].max() / ACROSS) > 0.97
    assert track.headings == pytest.approx(np.full(len(track.times), math.radians(held)))
    assert track.tracking.cross.max < 0.05


@pytest.mark.parametrize("held", [None, 0, 90, -135])
def test_what_is_planned_is_driven_within_its_limits_and_its_clearance(held: float | None) -> None:
    asked = mission(held, world={"known": [{"circle": {"center": [9, 1], "radius": 1.2}}]})
    plan = vs.plan(asked)
    run = vs.simulate(asked, plan=plan)
    assert run.reached, run.reason
    assert run.certificate.holds
    speeds = np.abs(in_the_body(run.positions, run.headings, run.times))
    # samples lie on the proven curve, within a millimetre of the places, every 0.05 s
    assert speeds[:, 0].max() <= ALONG + 0.02
    assert speeds[:, 1].max() <= (0.05 if held is None else ACROSS) + 0.02
    if held is not None:
        assert np.ptp(run.headings) < 1e-9
        assert math.degrees(run.headings[0]) == pytest.approx(held)
        planned = plan.path.at_distance(plan.trajectory.distance_at(run.times - 0.1))
        assert np.hypot(*(run.positions - planned).T).max() < 0.5


def test_ahead_it_is_as_fast_as_along_and_sideways_as_across() -> None:
    path = vs.PiecewiseCubic([[[0, 0], [10, 0], [20, 0], [30, 0]]])
    for held, top in ((0.0, ALONG), (90.0, ACROSS), (180.0, ALONG), (-90.0, ACROSS)):
        spec = RobotSpec.model_validate(robot(held))
        assert retime(path, limits_of(spec)).speeds.max() == pytest.approx(top, rel=1e-6)
    slanted = RobotSpec.model_validate(robot(45.0))
    fastest = retime(path, limits_of(slanted)).speeds.max()
    assert fastest == pytest.approx(ACROSS * math.sqrt(2.0), rel=1e-6)


def test_a_corner_is_a_stop_without_a_turn() -> None:
    corner = vs.CardinalSpline([(0, 0), (6, 0), (6, 6)], tension=1.0)
    track = driven(corner, RobotSpec.model_validate(robot(0.0)))
    assert track.finished
    assert np.ptp(track.headings) == 0.0
    at_the_corner = np.hypot(*(track.positions - (6.0, 0.0)).T) < 0.02
    assert track.speeds[at_the_corner].min() < 0.05
    assert np.abs(track.tracking.cross_track).max() < 0.05


def test_noise_turns_the_body_and_it_turns_back() -> None:
    spec = RobotSpec.model_validate(robot(30.0, yaw_rate_noise_degps=6.0, speed_noise_mps=0.03))
    path = vs.CardinalSpline([(0, 0), (10, 4), (20, -4), (30, 0)], tangents="continuous")
    for seed in range(3):
        track = follow(path, retime(path, limits_of(spec)), spec, seed=seed)
        assert track.finished
        assert 0.005 < track.tracking.heading.max < 0.25
        assert track.tracking.cross.max < 0.1


def test_the_yaw_limits_of_the_robot_do_not_slow_a_body_that_does_not_turn() -> None:
    slow = robot(0.0) | {"max_yaw_rate_degps": 1.0, "max_yaw_accel_degps2": 1.0}
    path = vs.CardinalSpline([(0, 0), (3, 3), (6, 0)], tangents="continuous")
    free = retime(path, limits_of(RobotSpec.model_validate(robot(0.0)))).duration
    assert retime(path, limits_of(RobotSpec.model_validate(slow))).duration == free


def test_a_body_that_looks_where_it_goes_drives_as_one_with_two_wheels() -> None:
    wheels = {"differential": {"track_m": 0.01, "max_wheel_speed_mps": 10.0}}
    kept = {"max_speed_mps": ALONG, "max_lateral_accel_mps2": 0.8}
    path = vs.CardinalSpline([(0, 0), (8, 3), (14, -2)], tangents="continuous")
    any_way = RobotSpec.model_validate(robot() | kept)
    manner = {"delay_s": 0.05, "lag_s": 0.1}
    two = RobotSpec.model_validate({**robot(), **kept, "drive": {**wheels, **manner}})
    one, other = driven(path, any_way), driven(path, two)
    assert one.positions == pytest.approx(other.positions, abs=1e-6)


def test_a_command_is_a_velocity_in_the_frame_of_the_body() -> None:
    nav = vs.Navigator(mission(90.0))
    time, state = 0.0, vs.RobotState((0.0, 0.0), math.pi / 2, 0.0)
    for _ in range(40):
        command, nav = nav.step(state, [], time)
        forward, left = command.velocity
        place = (state.position[0] - left * 0.05, state.position[1] + forward * 0.05)
        state, time = vs.RobotState(place, math.pi / 2, forward, left), time + 0.05
    assert command.heading == pytest.approx(math.pi / 2)
    assert command.yaw_rate == pytest.approx(0.0)
    assert left < -0.2  # it goes to the east, which is its right
    assert command.speed == pytest.approx(math.hypot(forward, left))


def test_unseen_obstacles_are_passed_with_the_heading_held() -> None:
    crate = {"circle": {"center": [9, 1], "radius": 1.0}, "name": "crate"}
    sees = robot(0.0) | {"sensor": {"range_m": 6.0}}
    run = vs.simulate(mission(world={"unseen": [crate]}, robot=sees))
    assert run.reached, run.reason
    assert run.replans
    assert run.certificate.clearance > 0.19
    assert np.ptp(run.headings) < 1e-9


def test_a_held_heading_with_a_footprint_is_refused_with_the_remedy() -> None:
    body = {"footprint": [[-0.4, -0.3], [0.4, -0.3], [0.4, 0.3], [-0.4, 0.3]]}
    route = {"start": [0, 0], "goal": [10, 0]}
    with pytest.raises(vs.MissionError) as refused:
        vs.Mission.model_validate({"robot": {**body, "drive": drive(0.0)}, "route": route})
    assert "robot.drive.omnidirectional.hold_heading_deg" in str(refused.value)
    assert "give radius_m" in str(refused.value)
    free = vs.Mission.model_validate({"robot": {**body, "drive": drive()}, "route": route})
    assert vs.simulate(free).certificate.holds


def test_its_circle_has_no_radius_and_it_needs_no_room_to_turn() -> None:
    kind = Omnidirectional(max_speed_along_mps=1.0, max_speed_across_mps=0.5)
    assert kind.turn_radius is None
    assert kind.can_turn_on_spot
    assert kind.contradictions(has_footprint=True) == ()
