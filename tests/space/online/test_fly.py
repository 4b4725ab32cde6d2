from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.mission.model import Mission
from viaspline.space.online.fly import fly
from viaspline.space.plan_spatial import plan_spatial


def mission(unseen: list[dict[str, object]], **more: object) -> Mission:
    return Mission.model_validate(
        {
            "world": {"ground": {"flat_m": 0}, "unseen": unseen,
                      "altitude": {"min_m": 2, "max_m": 60, "above": "home"}},
            "robot": {"radius_m": 0.5, "clearance_m": 1, "max_speed_mps": 5, "max_accel_mps2": 2,
                      "max_climb_mps": 2, "sensor": {"range_m": 20}, **more},
            "route": {"start": [0, 0], "takeoff": {"to_agl_m": 10},
                      "via": [[60, 0, 10], [120, 30, 14]], "land": {"at": [160, 30]}},
        }
    )  # fmt: skip


def nearest(unseen: list[dict[str, object]], places: np.ndarray) -> float:
    gaps = [
        np.linalg.norm(places - np.array(one["ball"]["center"]), axis=1).min()  # type: ignore[index]
        - one["ball"]["radius"]  # type: ignore[index]
        for one in unseen
    ]
    return float(min(gaps)) - 0.5


@settings(max_examples=8)
@given(seed=st.integers(0, 10_000))
def test_what_is_seen_under_way_is_kept_clear_of_and_every_via_point_is_served(seed: int) -> None:
    rng = np.random.default_rng(seed)
    unseen = [
        {"ball": {"center": [float(rng.uniform(20, 100)), float(rng.uniform(-5, 25)),
                             float(rng.uniform(8, 16))], "radius": float(rng.uniform(1, 3))}}
        for _ in range(3)
    ]  # fmt: skip
    vias = np.array([[60.0, 0, 10], [120, 30, 14]])
    for one in unseen:
        if np.linalg.norm(vias - np.array(one["ball"]["center"]), axis=1).min() < 7:
            return
    run = fly(plan_spatial(mission(unseen)))
    assert run.clearance >= 1.0 - 1e-6 or not run.reached
    assert nearest(unseen, run.positions) >= run.clearance - 1e-6
    if run.reached:
        for via in vias:
            assert np.linalg.norm(run.positions - via, axis=1).min() < 0.5
        assert np.allclose(run.positions[-1], (160, 30, 0.5), atol=1e-6)
    steps = np.linalg.norm(np.diff(run.positions, axis=0), axis=1) / np.diff(run.times)
    assert steps.max() <= 5 * (1 + 1e-6)


def test_a_new_path_begins_without_a_stop_where_there_is_room() -> None:
    unseen = [{"name": "crane", "ball": {"center": [35, 0, 10], "radius": 2}}]
    run = fly(plan_spatial(mission(unseen)))
    (replan,) = run.replans
    assert replan.obstacles == ("crane",)
    assert not replan.stopped
    assert run.reached
    under_way = (run.times > replan.seen_at) & (run.times < replan.time + 3)
    assert run.speeds[under_way].min() > 1.0
    turns = np.diff(run.positions, axis=0)
    turns /= np.maximum(np.linalg.norm(turns, axis=1), 1e-9)[:, None]
    assert (turns[1:] * turns[:-1]).sum(axis=1)[under_way[1:-1]].min() > 0.98


def test_a_flight_without_anything_unseen_follows_its_plan() -> None:
    plan = plan_spatial(mission([]))
    run = fly(plan)
    assert run.reached
    assert run.replans == ()
    assert run.duration == pytest.approx(plan.trajectory.duration)
    assert run.clearance == pytest.approx(plan.certificate.clearance, abs=2e-3)


def test_what_stands_on_a_via_point_ends_the_flight_before_it_with_the_reason() -> None:
    unseen = [{"name": "tent", "ball": {"center": [120, 30, 14], "radius": 3}}]
    run = fly(plan_spatial(mission(unseen)))
    assert not run.reached
    assert "tent" in run.reason
    assert run.clearance >= 1.0 - 1e-6
    assert run.speeds[-1] == pytest.approx(0.0, abs=1e-6)


def test_until_it_brakes_a_robot_has_flown_as_was_planned() -> None:
    unseen = [{"name": "tent", "ball": {"center": [120, 30, 14], "radius": 3}}]
    run = fly(plan_spatial(mission(unseen)))
    law = run.plan.trajectory
    before = run.times <= run.replans[-1].seen_at
    said = np.asarray(run.plan.path.at_distance(law.distance_at(run.times[before])))
    assert np.allclose(run.positions[before], said, atol=1e-9)
    steps = np.linalg.norm(np.diff(run.positions, axis=0), axis=1) / np.diff(run.times)
    assert steps.max() <= 5 * (1 + 1e-6)


def test_what_is_seen_too_late_to_stop_before_it_is_said_with_the_distances() -> None:
    wall = {"name": "wall", "box": {"min": [40, -80, 0], "max": [42, 80, 60]}}
    asked = mission([wall], max_speed_mps=8, sensor={"range_m": 6})
    run = fly(plan_spatial(asked))
    assert not run.reached
    assert "m/s it takes 4.9 m to stop, and its sensor sees 6 m" in run.reason
    assert run.clearance < 1.0
    slow = fly(plan_spatial(mission([wall], max_speed_mps=2, sensor={"range_m": 6})))
    assert slow.reached
    assert slow.clearance >= 1.0


def test_a_body_turns_where_it_stands_and_from_one_path_to_the_next_within_its_rate() -> None:
    data = mission([{"ball": {"center": [35, 0, 10], "radius": 2}}], max_yaw_rate_dps=60)
    route = {"start": [0, 0, 10], "goal": [130, 0, 10], "yaw": {"to": [60, 40, 0]},
             "via": [{"at": [70, 0, 10], "look_at": [70, -30, 0]}]}  # fmt: skip
    data = data.model_copy(update={"route": data.route.model_validate(route)})
    run = fly(plan_spatial(data))
    assert run.reached
    assert run.replans
    assert not run.replans[0].stopped
    turned = np.abs(np.angle(np.exp(1j * np.diff(run.headings)))) / np.diff(run.times)
    assert np.rad2deg(turned.max()) <= 60 * 1.01
    back = data.route.model_validate(route | {"goal": [1, 0, 10]})
    free = data.model_copy(update={"world": mission([]).world, "route": back})
    there_and_back = fly(plan_spatial(free))
    turned = np.abs(np.angle(np.exp(1j * np.diff(there_and_back.headings))))
    assert np.rad2deg((turned / np.diff(there_and_back.times)).max()) <= 60 * 1.01


def ball_ahead(route: dict[str, Any], x: float, reach: float) -> Mission:
    """A flight along x at a height of 10 m, and something on its way that isn't on the map."""
    unseen = [{"name": "balloon", "ball": {"center": [x, 0, 10], "radius": 2}}]
    robot = {"radius_m": 0.5, "clearance_m": 1, "max_speed_mps": 5, "max_accel_mps2": 2,
             "sensor": {"range_m": reach}}  # fmt: skip
    world = {"ground": {"flat_m": 0}, "unseen": unseen}
    return Mission.model_validate({"world": world, "robot": robot, "route": route})


def test_what_is_seen_from_the_ground_is_flown_round_once_it_has_taken_off() -> None:
    route = {
        "start": {"at": [0, 0], "dwell_s": 2},
        "takeoff": {"to_agl_m": 10},
        "goal": [60, 0, 10],
    }
    run = fly(plan_spatial(ball_ahead(route, 20.0, 30.0)))
    assert run.reached
    assert run.clearance >= 1.0 - 1e-6
    (replan,) = run.replans
    at_top = run.times[np.linalg.norm(run.positions - np.array([0, 0, 10]), axis=1) < 1e-6]
    assert replan.seen_at < at_top[0]
    assert replan.time == pytest.approx(at_top[0] + 2.0, abs=0.21)


def test_what_is_seen_while_it_climbs_into_it_ends_the_flight_below_it() -> None:
    route = {"start": [0, 0], "takeoff": {"to_agl_m": 20}, "goal": [60, 0, 20]}
    run = fly(plan_spatial(ball_ahead(route, 1.0, 6.0)))
    assert not run.reached
    assert "balloon" in run.reason
    assert "as near as" not in run.reason  # it saw it in time
    assert run.clearance >= 1.0 - 1e-6
    assert run.positions[-1, 2] < 6.6


@pytest.mark.parametrize(("at", "reach"), [("start", 20.0), ("via", 13.05)])
def test_a_station_keeps_its_dwell_where_something_is_seen_from_it(at: str, reach: float) -> None:
    route: dict[str, Any] = {
        "start": {"at": [0, 0, 10]}, "via": [{"at": [30, 0, 10]}], "goal": [60, 0, 10],
    }  # fmt: skip
    station = route["start"] if at == "start" else route["via"][0]
    station["dwell_s"] = 6.0
    run = fly(plan_spatial(ball_ahead(route, 15.0 if at == "start" else 45.0, reach)))
    assert run.reached
    assert len(run.replans) == 1
    there = np.linalg.norm(run.positions - np.array(station["at"]), axis=1) < 1e-6
    assert np.ptp(run.times[there]) >= 6.0 - 0.21
