"""What goes wrong under way ends with a robot that stands safely and says why, or goes on."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from viaspline.mission.model import Mission
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator
from viaspline.robot.replanning import first_way_on
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate

Make = Callable[..., Mission]
Shape = Callable[..., dict[str, Any]]


def kinds(run: Run | Navigator) -> list[str]:
    return [event.kind for event in run.events]


def assert_it_stands_safely(run: Run) -> None:
    assert not run.reached
    assert run.reason
    assert run.speeds[-1] == pytest.approx(0.0, abs=1e-9)
    assert run.certificate.clearance > 0.0
    assert kinds(run)[-1] == "stopped"
    assert run.reason in run.events[-1].message
    assert run.visits[-1].status == "failed"
    assert run.visits[-1].reason == run.reason


def test_an_obstacle_covers_the_goal_while_the_robot_is_under_way(
    mission_of: Make, disc_at: Shape
) -> None:
    run = simulate(mission_of([0, 0], [50, 0], unseen=[disc_at(50, 0, 3, "boulder")]))
    assert_it_stands_safely(run)
    assert kinds(run) == ["started", "detected", "braked", "stopped"]
    assert run.reason == "the goal 'goal' can't be reached any more: 'boulder' covers it"
    assert run.certificate.holds


def test_a_goal_that_only_lacks_clearance_is_told_by_how_much(
    mission_of: Make, disc_at: Shape
) -> None:
    run = simulate(mission_of([0, 0], [50, 0], unseen=[disc_at(50, 3, 2.2, "boulder")]))
    assert_it_stands_safely(run)
    assert run.reason is not None
    assert "'boulder' leaves 0.30 m there, 0.5 m are needed" in run.reason


def test_a_group_from_wall_to_wall_stops_the_robot(mission_of: Make, disc_at: Shape) -> None:
    wall = [disc_at(30, y, 2.4, f"post {k}") for k, y in enumerate(range(-20, 21, 5))]
    run = simulate(mission_of([0, 0], [50, 0], bounds=[-5, -20, 60, 20], unseen=wall))
    assert_it_stands_safely(run)
    assert run.certificate.holds


def test_a_covered_via_point_is_skipped_and_the_rest_are_served(
    mission_of: Make, disc_at: Shape
) -> None:
    mission = mission_of(
        [0, 0], {"at": [25, 0], "name": "pump"}, [35, 5], [50, 0],
        unseen=[disc_at(25, 1, 3, "boulder")],
    )  # fmt: skip
    run = simulate(mission)
    assert run.reached
    assert run.certificate.holds
    assert [visit.status for visit in run.visits] == ["served", "skipped", "served", "served"]
    assert run.visits[1].reason == "'boulder' covers it"
    skipped = next(event for event in run.events if event.kind == "skipped")
    assert skipped.message == "gives up 'pump': 'boulder' covers it"
    assert [replan.mode for replan in run.replans] == ["planned"]


def test_a_via_point_that_is_walled_in_is_skipped(mission_of: Make, box_at: Shape) -> None:
    ring = [
        box_at(20, -6, 32, -5, "south"), box_at(20, 5, 32, 6, "north"),
        box_at(20, -5, 21, 5, "west"), box_at(31, -5, 32, 5, "east"),
    ]  # fmt: skip
    mission = mission_of(
        [0, 0], {"at": [26, 0], "name": "yard"}, [50, 0], unseen=ring, sensor={"range_m": 40}
    )
    run = simulate(mission)
    assert run.certificate.holds
    assert [visit.status for visit in run.visits] == ["served", "skipped", "served"], run.reason


def test_a_trap_that_is_seen_late_is_left_by_turning_on_the_spot(mission_of: Make) -> None:
    trap = {"name": "trap", "polygon": [[20, -10], [30, -10], [30, 10], [20, 10], [20, 9],
                                        [29, 9], [29, -9], [20, -9]]}  # fmt: skip
    run = simulate(mission_of([0, 0], [50, 0], unseen=[trap], sensor={"range_m": 2}))
    assert run.reached
    assert run.certificate.holds


def test_a_short_sight_makes_it_slow_and_it_still_goes_round(
    mission_of: Make, disc_at: Shape
) -> None:
    mission = mission_of(
        [0, 0], [50, 0], unseen=[disc_at(25, 0.3, 3, "boulder")], sensor={"range_m": 1.2}
    )
    run = simulate(mission)
    assert run.reached
    assert run.certificate.holds
    assert run.speeds.max() < 0.6
    assert "braked" in kinds(run)
    assert run.replans[0].mode == "from_rest"


def test_a_sight_inside_the_clearance_leads_it_out_and_on_before_it_touches(
    mission_of: Make, disc_at: Shape
) -> None:
    mission = mission_of(
        [0, 0], [50, 0], unseen=[disc_at(25, 0.3, 3, "boulder")], sensor={"range_m": 0.8}
    )
    run = simulate(mission)
    assert run.reached
    first = run.replans[0]
    assert first.mode == "from_rest"
    gap = math.dist(first.at, (25, 0.3)) - 3.0 - 0.5  # 0.5 m are asked for
    assert 0.0 < run.certificate.clearance == pytest.approx(gap, abs=2e-3)


def test_an_obstacle_that_appears_inside_the_braking_distance_is_braked_for(
    mission_of: Make,
) -> None:
    mission = mission_of([0, 0], [100, 0], max_speed_mps=4.0, sensor={"range_m": 40})
    nav = Navigator(mission)
    _, nav = nav.step(nav.reference(0.0), [], 0.0)
    state = nav.reference(10.0)
    assert state.speed == 4.0  # it needs 8 m to stop
    x = state.position[0]
    drop = Obstacle(circle=Circle(center=(x + 7.0, 0.0), radius=1.0), name="drop")
    command, nav = nav.step(state, [drop], 10.0)
    assert command.acceleration == -1.0
    assert kinds(nav)[-2:] == ["detected", "braked"]
    assert nav.reason is not None
    assert "appeared inside the braking distance" in nav.reason
    last = []
    for time in np.arange(10.0, 15.0, 0.1):
        command, nav = nav.step(nav.reference(time), [drop], time)
        last += kinds(nav)
    assert nav.finished
    assert not nav.reached
    assert command.stopped
    assert command.finished
    assert command.distance == pytest.approx(x + 8.0)
    assert last == ["stopped"]


def test_an_unseen_obstacle_too_near_to_the_start_is_left_without_coming_nearer(
    mission_of: Make, disc_at: Shape
) -> None:
    run = simulate(mission_of([0, 0], [50, 0], unseen=[disc_at(2, 0, 1.2, "near")]))
    assert run.reached
    assert run.certificate.clearance == pytest.approx(0.3, abs=2e-3)
    away = run.path.at_distance(np.arange(4.0, run.path.length, 0.05)) - (2.0, 0.0)
    assert np.hypot(*away.T).min() >= 1.2 + 0.5 + 0.5


def test_an_unseen_obstacle_that_touches_at_the_start_keeps_the_robot_there(
    mission_of: Make, disc_at: Shape
) -> None:
    run = simulate(mission_of([0, 0], [50, 0], unseen=[disc_at(2, 0, 1.5, "near")]))
    assert not run.reached
    assert run.duration == 0.0
    assert run.path.length == 0.0
    assert run.reason is not None
    assert "stands 0.00 m from 'near'" in run.reason


def test_a_robot_under_way_goes_on_while_what_moves_leaves_no_law_on_the_way_round() -> None:
    """It braked at once, 20 m before the wall; before that it stood for good."""
    cart = {"capsule": {"from": [0.135, -0.224], "to": [-0.135, 0.224], "radius": 0.065},
            "motion": {"keyframes": [[0, 1.05, 4.62], [19, 3.18, 17.11], [50.12, 16.02, 1.47]],
                       "after": "bounce"}}  # fmt: skip
    wall = {"name": "wall", "capsule": {"from": [3.826, 11.449], "to": [3.354, 12.591],
                                        "radius": 0.155}}  # fmt: skip
    slow = {"max_speed_mps": 0.523, "polygon": [[5.08, 2.59], [9.03, 2.59], [9.03, 6.81],
                                                [5.08, 6.81]]}  # fmt: skip
    mission = Mission.model_validate({
        "robot": {"radius_m": 0.4, "max_speed_mps": 1.681, "max_accel_mps2": 0.982,
                  "max_brake_mps2": 1.401, "sensor": {"range_m": 6.369}},
        "spline": {"tangents": "cardinal", "tension": 0.219},
        "world": {"known": [cart], "unseen": [wall], "speed_zones": [slow]},
        "route": {"start": [8.15, 12.38], "via": [[5.67, 2.45], [1.03, 13.89]],
                  "goal": {"at": [13.39, 9.57], "heading_deg": 78.976}},
    })  # fmt: skip
    run = simulate(mission)
    assert run.reached, run.reason
    assert run.replans[0].obstacles == ("wall",)
    assert run.certificate.holds
    begun = (run.times > 1.0) & (run.times < run.replans[0].time)
    assert run.speeds[begun].min() > 0.5


def test_a_way_round_that_what_moves_leaves_no_law_for_is_waited_for_at_rest(
    mission_of: Make, box_at: Shape, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It stood for good, clear of everything: "farther beside its path than the 0.000 m ..."."""

    def none_yet(context: ReplanContext, *rest: object) -> None:
        return None

    cart = {"circle": {"center": [0, 0], "radius": 0.5},
            "motion": {"from": [50, 50], "velocity_mps": [0.1, 0]}}  # fmt: skip
    wall = box_at(4.0, -1.5, 4.4, 1.5, "wall")
    mission = mission_of([0, 0], [12, 0], known=[cart], unseen=[wall])
    monkeypatch.setattr(first_way_on, "timed", none_yet)
    run = simulate(mission)
    assert run.reached, run.reason
    assert [replan.mode for replan in run.replans] == ["from_rest"]
