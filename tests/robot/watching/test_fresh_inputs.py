"""What a robot is handed late, twice or not at all stops it, and is told."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import LidarSensor, Scan
from viaspline.robot.state import RobotState

DRIVE = {"differential": {"track_m": 0.5}, "delay_s": 0.05, "lag_s": 0.05}
GOOD = {"delay": 0.05, "lag": 0.05}
LIDAR = {"lidar": {"range_m": 8, "fov_deg": 270, "beams": 91}}
LOST = (4.0, 5.2)
"""Nothing new comes in this time [s]."""


def lost(time: float) -> bool:
    return LOST[0] <= time < LOST[1]


def speed_at(track: np.ndarray, time: float) -> float:
    return float(np.interp(time, track[:, 0], track[:, 3]))


def with_gap(*, stamps: bool) -> Callable[[RobotState, float], RobotState]:
    """Poses that stay what they were for a while."""
    last: list[RobotState] = []

    def measure(state: RobotState, time: float) -> RobotState:
        if lost(time):
            return last[-1]
        last.append(replace(state, stamp=time) if stamps else state)
        return last[-1]

    return measure


@pytest.mark.parametrize("drive", [DRIVE, None], ids=["drive", "no drive"])
@pytest.mark.parametrize("stamps", [True, False], ids=["stamps", "no stamps"])
def test_a_pose_that_is_old_stops_the_robot_until_a_new_one_comes(
    slalom_of: Any, cart_of: Any, loop: Any, discs: Any, drive: Any, stamps: bool
) -> None:
    nav = Navigator(slalom_of(drive=drive))
    done = loop(nav, cart_of(**GOOD), measure=with_gap(stamps=stamps))
    told = [event for event in done.book.events if event.kind == "stale"]
    assert [event.data["what"] for event in told] == ["pose"]
    assert LOST[0] + 0.2 <= told[0].time <= LOST[0] + 0.4
    assert told[0].data["age_s"] > told[0].data["allowed_s"] == 0.2
    before, braked = speed_at(done.track, LOST[0]), speed_at(done.track, LOST[1])
    assert braked < before - 0.6 * (LOST[1] - LOST[0] - 0.4)
    assert done.nav.reached
    assert done.gap(discs, 0.3) >= 0.5 - 0.01


def look(nav: Navigator, discs: Any) -> Callable[[RobotState, int, float], Scan]:
    sensor = LidarSensor(discs, nav.mission.robot.sensor.lidar)  # type: ignore[union-attr, arg-type]
    return lambda state, tick, _: sensor.scan(state.position, state.heading, tick)


@pytest.mark.slow
@pytest.mark.parametrize("blind", ["missing", "empty", "old"])
def test_scans_that_do_not_come_stop_the_robot(
    slalom_of: Any, cart_of: Any, loop: Any, discs: Any, blind: str
) -> None:
    nav = Navigator(slalom_of(drive=DRIVE, sensor=LIDAR))
    see, kept = look(nav, discs), []

    def sense(state: RobotState, tick: int, time: float) -> object:
        if not lost(time):
            kept.append(replace(see(state, tick, time), stamp=time))
            return kept[-1]
        nothing = Scan.from_laserscan([], 0.0, 0.01, 0.1, 8.0, (*state.position, state.heading))
        return {"missing": (), "empty": nothing, "old": kept[-1]}[blind]

    done = loop(nav, cart_of(**GOOD), sense=sense)
    told = [event for event in done.book.events if event.kind == "stale"]
    assert [event.data["what"] for event in told] == ["scan"]
    before, braked = speed_at(done.track, LOST[0]), speed_at(done.track, LOST[1])
    assert braked < before - 0.6 * (LOST[1] - LOST[0] - 0.4)
    assert done.nav.reached, done.nav.reason
    assert done.gap(discs, 0.3) >= 0.5 - 0.01


def test_a_scan_of_nothing_but_nan_is_as_good_as_none(slalom_of: Any, discs: Any) -> None:
    nav = Navigator(slalom_of(drive=DRIVE, sensor=LIDAR))
    state, nan = RobotState((0.0, 0.0), 0.0, 0.0), [math.nan] * 181
    _, nav = nav.step(state, look(nav, discs)(state, 0, 0.0), 0.0)
    kinds = []
    for tick in range(1, 14):
        scan = Scan.from_laserscan(nan, -2.0, 0.02, 0.1, 8.0, (0.0, 0.0, 0.0))
        command, nav = nav.step(state, scan, 0.05 * tick)
        kinds += [event.kind for event in nav.events]
    assert "stale" in kinds
    assert command.velocity == (0.0, 0.0)


def test_steps_that_come_late_are_told_and_do_no_harm(
    slalom_of: Any, cart_of: Any, loop: Any, discs: Any
) -> None:
    nav = Navigator(slalom_of(drive=DRIVE))
    done = loop(nav, cart_of(**GOOD), period=lambda tick: 0.5 if tick in (60, 150) else 0.05)
    told = [event for event in done.book.events if event.kind == "stale"]
    assert [event.data["what"] for event in told] == ["step", "step"]
    assert told[0].data["age_s"] == pytest.approx(0.5)
    assert done.nav.reached
    assert done.gap(discs, 0.3) >= 0.5 - 0.01


@pytest.mark.parametrize("seed", range(2))
def test_a_period_that_varies_by_three_changes_nothing(
    slalom_of: Any, cart_of: Any, loop: Any, discs: Any, seed: int
) -> None:
    chance = random.Random(seed)
    nav = Navigator(slalom_of(drive=DRIVE))
    done = loop(nav, cart_of(**GOOD), period=lambda _: chance.uniform(0.033, 0.099))
    assert done.nav.reached
    assert not {"stale", "slip", "lag", "pose_jump", "clock"} & set(done.kinds)
    assert done.gap(discs, 0.3) >= 0.5


def test_a_clock_that_runs_backwards_stops_the_robot_until_it_is_past(slalom_of: Any) -> None:
    nav = Navigator(slalom_of(drive=DRIVE))
    at_two = RobotState((0.01, 0.0), 0.0, 0.5)
    for tick in range(10):
        command, nav = nav.step(nav.reference(0.05 * tick), (), 0.05 * tick)
    assert command.velocity[0] > 0.0
    for time in (0.2, 0.25, 0.4):
        command, nav = nav.step(at_two, (), time)
        assert command.velocity == (0.0, 0.0)
        assert command.yaw_rate == 0.0
        if time == 0.2:
            (event,) = nav.events
            assert event.kind == "clock"
            assert event.data["back_s"] == pytest.approx(0.25)
            assert "needs a new Navigator" in event.message
        else:
            assert nav.events == ()
    command, nav = nav.step(nav.reference(0.5), (), 0.5)
    command, nav = nav.step(nav.reference(0.55), (), 0.55)
    assert command.velocity[0] > 0.0


def test_a_pose_that_is_a_little_late_is_carried_on_to_now(slalom_of: Any) -> None:
    quick, late = (Navigator(slalom_of(drive=DRIVE)) for _ in range(2))
    for tick in range(60):
        time = 0.05 * tick
        now = quick.reference(time)
        back = tuple(p - 0.1 * now.speed * d for p, d in zip(now.position, (1.0, 0.0), strict=True))
        on_line = abs(now.heading) < 1e-6
        first, quick = quick.step(now, (), time)
        second, late = late.step(
            replace(now, position=back, stamp=time - 0.1) if on_line else now, (), time
        )
    assert late.events == quick.events
    assert second.velocity[0] == pytest.approx(first.velocity[0], abs=1e-6)


def test_a_robot_that_follows_exactly_may_leave_out_steps(slalom_of: Any) -> None:
    nav, kinds = Navigator(slalom_of()), []
    for time in (0.0, 3.0, 9.0, 40.0):
        _, nav = nav.step(nav.reference(time), (), time)
        kinds += [event.kind for event in nav.events]
    assert set(kinds) == {"started", "via", "reached"}


@pytest.mark.parametrize("what", ["pose", "scan"])
def test_a_stamp_far_ahead_tells_no_age(slalom_of: Any, discs: Any, what: str) -> None:
    nav = Navigator(slalom_of(drive=DRIVE, sensor=LIDAR))
    state, see = RobotState((0.0, 0.0), 0.0, 0.0), look(nav, discs)
    told, speeds = [], []
    for tick in range(40):
        time = 0.05 * tick
        ahead = 1.8e9 if 10 <= tick < 30 else 0.1  # a wall's clock; a little ahead is of now
        pose = replace(state, stamp=ahead + time if what == "pose" else None)
        scan = see(state, tick, time)
        scan = replace(scan, stamp=ahead + time) if what == "scan" else scan
        command, nav = nav.step(pose, scan, time)
        told += [event for event in nav.events if event.kind == "stale"]
        speeds.append(command.velocity[0])
    assert [(event.time, event.data["what"]) for event in told] == [(0.5, what)]
    assert told[0].message == (
        f"stops: the stamp of its {what} is 1800000000.00 s ahead of its clock, 0.20 s are allowed"
    )
    assert told[0].data["age_s"] == pytest.approx(-1.8e9)
    assert speeds[29] == 0.0
    assert speeds[39] > 0.0


def test_who_stood_meanwhile_was_not_blind() -> None:
    away = {"from": [0, 90], "velocity_mps": [0, 1]}
    mission = Mission.model_validate(
        {
            "world": {"known": [{"circle": {"center": [0, 0], "radius": 1}, "motion": away}]},
            "robot": {"sensor": {"lidar": {"range_m": 8}}},
            "route": {"start": [0, 0], "goal": [20, 0], "depart_s": 60},
        }
    )
    assert mission.robot.sensor is not None
    assert mission.robot.sensor.lidar is not None
    lidar, nav, told = LidarSensor([], mission.robot.sensor.lidar), Navigator(mission), []
    for time in (0.0, 0.05, 50.0, 60.0, 62.0):
        state = nav.reference(time)
        _, nav = nav.step(state, lidar.scan(state.position, state.heading), time)
        told += [event.time for event in nav.events if event.kind == "stale"]
    assert told == [62.0]


@pytest.mark.parametrize("what", ["pose", "clock"])
def test_who_brakes_for_good_does_not_go_on_when_what_was_missed_comes_again(what: str) -> None:
    wall = Obstacle.model_validate({"polygon": [[3, -5], [4, -5], [4, 5], [3, 5]]})
    mission = Mission.model_validate(
        {
            "world": {"unseen": [wall], "bounds": [-2, -5, 22, 5]},
            "robot": {"radius_m": 0.3, "clearance_m": 0.2, "sensor": {"range_m": 5}},
            "route": {"start": [0, 0], "goal": [20, 0]},
        }
    )
    nav, time, x, speed = Navigator(mission), 0.0, 0.0, 0.0
    while time < 8.0 and not nav.finished:
        missed = nav.reason is not None and speed > 0.0 and nav.held is None
        stamp = time - 0.5 if missed and what == "pose" else time
        at = time - 0.5 if missed and what == "clock" else time
        state = RobotState((x, 0.0), 0.0, speed, stamp=stamp)
        command, nav = nav.step(state, [wall] if time > 1.9 else (), at)
        speed = command.velocity[0]
        x, time = x + 0.05 * speed, time + 0.05
    assert nav.reason is not None
    assert x <= 3.7
