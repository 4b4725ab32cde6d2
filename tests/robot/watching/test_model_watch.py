"""Speed that isn't reached, delay that adds up and poses that jump are told, with their figures."""

from __future__ import annotations

import itertools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator
from viaspline.robot.state import RobotState
from viaspline.robot.watching.model_watch import watched_motion
from viaspline.robot.watching.watch import Watch
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime

DRIVE = {"differential": {"track_m": 0.5}, "delay_s": 0.05, "lag_s": 0.05}
GOOD = {"delay": 0.05, "lag": 0.05}


@pytest.mark.parametrize("drive", [DRIVE, None], ids=["drive", "no drive"])
@pytest.mark.parametrize("since", [0.0, 4.0])
def test_a_cart_that_crawls_is_noticed_within_two_seconds(
    slalom_of: Any, cart_of: Any, loop: Any, drive: Any, since: float
) -> None:
    nav = Navigator(slalom_of(drive=drive))
    crawling = cart_of(**GOOD, share=lambda time: 0.15 if time >= since else 1.0)
    done = loop(nav, crawling, limit=20.0)
    slip = done.first("slip")
    assert since < slip.time <= since + 2.0
    assert slip.data["ratio"] < 0.5
    assert slip.data["measured_mps"] < 0.5 * slip.data["commanded_mps"]
    lag = done.first("lag")
    assert lag.time < since + 4.0
    assert lag.data["behind_s"] >= 1.0


@pytest.mark.parametrize("drive", [DRIVE, None], ids=["drive", "no drive"])
def test_a_crawling_robot_is_not_taken_for_being_where_its_time_law_is(
    slalom_of: Any, cart_of: Any, loop: Any, drive: Any
) -> None:
    nav = Navigator(slalom_of(drive=drive))
    done = loop(nav, cart_of(**GOOD, share=lambda _: 0.15), limit=30.0)
    driven = float(np.hypot(*np.diff(done.track[:, 1:3], axis=0).T).sum())
    assert abs(done.nav.distance - driven) < 0.8
    assert "via" not in done.kinds


@given(share=st.floats(0.7, 1.02), speed=st.floats(0.2, 2.0), period=st.floats(0.02, 0.2))
@example(share=0.99, speed=0.5, period=0.05)  # stood 0.26 m before its goal for good
@settings(deadline=None, max_examples=12)
def test_a_robot_that_drives_less_than_it_is_told_gets_to_its_goal(
    cart_of: Any, loop: Any, share: float, speed: float, period: float
) -> None:
    mission = Mission.model_validate(
        {
            "robot": {"max_speed_mps": speed, "max_accel_mps2": 1.0},
            "route": {
                "start": {"at": [0, 0], "heading_deg": 0},
                "via": [{"at": [7, 0], "dwell_s": 1}],
                "goal": [14, 0],
            },
        }
    )
    nav = Navigator(mission, period=period)
    slipping = cart_of(share=lambda _: share)
    done = loop(nav, slipping, period=lambda _: period, limit=30.0 + 2.0 * 14.0 / speed)
    assert done.nav.reached
    assert abs(done.track[-1, 1] - 14.0) < 0.15
    assert done.track[:, 3].max() <= speed * max(share, 1.0) + 0.05


def test_lag_is_told_again_when_it_has_doubled(slalom_of: Any, cart_of: Any, loop: Any) -> None:
    done = loop(Navigator(slalom_of(drive=DRIVE)), cart_of(**GOOD, share=lambda _: 0.3), limit=40.0)
    told = [event.data["behind_s"] for event in done.book.events if event.kind == "lag"]
    assert len(told) >= 3
    assert all(2.0 * a <= b < 2.0 * a + 0.2 for a, b in itertools.pairwise(told))


@pytest.mark.parametrize("drive", [DRIVE, None], ids=["drive", "no drive"])
def test_a_machine_as_its_model_says_is_not_complained_of(
    slalom_of: Any, cart_of: Any, loop: Any, drive: Any
) -> None:
    truth = GOOD if drive else {}
    done = loop(Navigator(slalom_of(drive=drive)), cart_of(**truth))
    assert done.nav.reached
    assert not {"slip", "lag", "pose_jump", "stale", "clock"} & set(done.kinds)
    assert drive is None or "deviation" not in done.kinds


@given(st.floats(0.02, 1.0), st.floats(0.2, 3.0), st.floats(0.67, 1.0), st.floats(0.02, 0.1))
@settings(deadline=None, max_examples=25)
def test_a_robot_with_two_thirds_of_its_speed_does_not_slip_where_it_has_turned_either(
    slalom_of: Any, accel: float, stand: float, share: float, period: float
) -> None:
    there = [(float(k), 0.0) for k in range(4)]
    onward = [(3.0 - 0.6 * k, 0.8 * k) for k in range(4)]
    path = Path([there, onward], [])
    law = retime(path, Limits(max_speed=1.0, max_accel=accel), [Station(3.0, stand)])
    nav = Navigator(slalom_of(drive=DRIVE), warm=False)
    task, state = nav._task, nav._state
    schedule = replace(state.schedule, path=path, trajectory=law, turns=(3.0,))
    before = Watch()
    for time in np.arange(0.0, law.end_time, period).tolist():
        at, speed, _ = (float(x) for x in law.state_at(max(time - 0.05, 0.0)))
        u = float(path.parameter(at))
        place = tuple(np.asarray(path.evaluate(u)).tolist())
        measured = RobotState(place, float(path.heading(u)), speed)
        watch = replace(before, time=time, measured=measured, at=time)
        motion = watched_motion(task, before, watch, state.progress, schedule, measured, time)
        assert "slip" not in [event.kind for event in motion.events]
        told = float(law.state_at(time)[1]) / share
        before = motion.watch.having_given(time, told, 3.0)


@pytest.mark.parametrize("goal", [[2.0, 0.0], [2.5, 1.0], [4.6, -0.02]])
def test_a_cart_that_turns_where_its_plan_turns_back_is_not_complained_of(
    cart_of: Any, loop: Any, goal: list[float]
) -> None:
    robot = {"radius_m": 0.3, "drive": DRIVE}
    route = {"start": [0, 0], "via": [{"at": [5, 0], "dwell_s": 1.0}], "goal": goal}
    spline = {"tangents": "cardinal"} if goal[1] == 0.0 else {}
    mission = Mission.model_validate({"robot": robot, "route": route, "spline": spline})
    done = loop(Navigator(mission), cart_of(**GOOD), limit=60.0)
    assert done.nav.reached
    assert not {"slip", "lag", "pose_jump", "deviation"} & set(done.kinds)


def moved_by(dx: float, dy: float, since: float) -> Any:
    def measure(state: RobotState, time: float) -> RobotState:
        if time < since:
            return state
        x, y = state.position
        return replace(state, position=(x + dx, y + dy))

    return measure


@pytest.mark.parametrize("drive", [DRIVE, None], ids=["drive", "no drive"])
@pytest.mark.parametrize("since", [3.0, 6.5])
@pytest.mark.parametrize("jump", [(0.0, 0.3), (-0.4, 0.0), (0.3, 0.5)])
def test_a_pose_that_jumps_is_told_and_touches_nothing(
    slalom_of: Any,
    cart_of: Any,
    loop: Any,
    discs: list[Obstacle],
    drive: Any,
    since: float,
    jump: tuple[float, float],
) -> None:
    """What is measured after the jump is taken for true: so it is when a filter closes a loop."""
    nav = Navigator(slalom_of(drive=drive))
    done = loop(nav, cart_of(**(GOOD if drive else {})), measure=moved_by(*jump, since))
    event = done.first("pose_jump")
    assert since - 1e-9 <= event.time <= since + 0.1
    assert event.data["jump_m"] == pytest.approx(np.hypot(*jump), abs=0.12)
    assert done.kinds.count("pose_jump") == 1
    true = done.track[done.track[:, 0] > since]
    true[:, 1:3] += jump
    gap = replace(done, track=true).gap(discs, 0.3)
    assert gap > 0.0
    assert done.nav.finished
    # no nearer than what was stated, or told
    told = [e.data["clearance_m"] for e in done.book.events if e.kind == "deviation"]
    assert gap >= min([0.5, *told]) - 0.05


def test_heading_that_jumps_is_told(slalom_of: Any, cart_of: Any, loop: Any) -> None:
    nav = Navigator(slalom_of(drive=DRIVE))

    def turned(state: RobotState, time: float) -> RobotState:
        return state if time < 3.0 else replace(state, heading=state.heading + 0.9)

    done = loop(nav, cart_of(**GOOD), measure=turned, limit=5.0)
    assert done.first("pose_jump").data["turned_rad"] == pytest.approx(0.9, abs=0.05)
