"""A trajectory is found anew only when it is due, and what is driven keeps the jerk throughout."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from viaspline.kernels.tracking.drive_motion import HEADING, STATE
from viaspline.machine.reference import heading_after
from viaspline.mission.model import Mission
from viaspline.robot.navigation.reschedule import braking_at_once, trajectory_within_sight
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.perception.range_sensor import RangeSensor
from viaspline.robot.simulator import simulate
from viaspline.robot.state import RobotState

Make = Callable[..., Mission]
Shape = Callable[..., dict[str, Any]]
STEP, JERK, FAR = 0.05, 1.5, 3.0


def drive(mission: Mission, until: float = 90.0) -> list[Navigator]:
    """The navigator after every step of a robot that follows exactly."""
    spec, things = mission.robot.sensor, (*mission.world.known, *mission.world.unseen)
    assert spec is not None
    lidar = None if spec.lidar is None else LidarSensor(things, spec.lidar)
    sensor = RangeSensor(mission.world.unseen, spec.reach)
    nav, navs = Navigator(mission), []
    for tick in range(round(until / STEP)):
        state = nav.reference(tick * STEP)
        seen: Any = sensor.seen(state.position)
        if lidar is not None:
            seen = lidar.scan(state.position, state.heading, tick)
        _, nav = nav.step(state, seen, tick * STEP)
        navs.append(nav)
        if nav.finished:
            break
    return navs


def driven(navs: list[Navigator]) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Times, speeds and accelerations that were driven, and where the jerk is said to be kept."""
    fine = np.arange(0.0, STEP - 1e-9, STEP / 10)
    times = np.concatenate([k * STEP + fine for k in range(len(navs))])
    states = [nav.trajectory.state_at(k * STEP + fine) for k, nav in enumerate(navs)]
    speeds, accels = (np.concatenate([state[i] for state in states]) for i in (1, 2))
    places = np.concatenate([state[0] for state in states])
    harsh = [nav.trajectory.over_jerk_until or 0.0 for nav in navs]
    return times, speeds, accels, places > np.repeat(harsh, len(fine))


@pytest.mark.parametrize("sensor", [{"range_m": 9}, {"lidar": {"range_m": 9}}])
def test_the_driven_acceleration_changes_no_faster_than_the_jerk_limit(
    mission_of: Make, disc_at: Shape, sensor: dict[str, Any]
) -> None:
    mission = mission_of(
        [0, 0], [22, 4], [40, 0], unseen=[disc_at(14, 2.6, 1), disc_at(30, 2, 0.8)],
        sensor=sensor, max_jerk_mps3=JERK, max_lateral_accel_mps2=0.8,
    )  # fmt: skip
    navs = drive(mission)
    assert navs[-1].reached, navs[-1].reason
    assert any(nav.replans for nav in navs)
    times, speeds, accels, kept = driven(navs)
    jerks = np.diff(accels) / np.diff(times)
    kept = kept[1:] & kept[:-1]
    assert kept.mean() > 0.6
    assert np.abs(jerks[kept]).max() <= JERK * 1.001
    found = np.diff(speeds) / np.diff(times)
    np.testing.assert_allclose(found[kept], accels[:-1][kept], atol=0.02)


def test_nothing_is_solved_where_nothing_new_was_seen(mission_of: Make) -> None:
    navs = drive(mission_of([0, 0], [30, 0], max_jerk_mps3=JERK))
    assert navs[-1].reached
    laws = {id(nav.trajectory) for nav in navs}
    assert len(laws) == 1


def test_with_a_lidar_a_law_that_will_do_is_kept_for_a_while(mission_of: Make) -> None:
    sensor = {"lidar": {"range_m": 8}}
    navs = drive(mission_of([0, 0], [25, 0], sensor=sensor, max_jerk_mps3=JERK))
    assert navs[-1].reached
    changed = sum(a.trajectory is not b.trajectory for a, b in pairwise(navs))
    assert changed <= len(navs) * STEP / 0.5 + 5


def test_a_robot_that_stands_turns_before_it_leaves_though_its_law_is_found_anew(
    mission_of: Make,
) -> None:
    """A law that was found anew at a corner had forgotten that the robot was to turn there."""
    lidar = {"range_m": 3, "fov_deg": 360, "beams": 90}
    mission = mission_of(
        {"at": [0, 0], "heading_deg": 150}, [4, 0], sensor={"lidar": lidar}, radius_m=0.2,
        drive={"differential": {"track_m": 0.4}},
    )  # fmt: skip
    nav, sensor = Navigator(mission), LidarSensor((), mission.robot.sensor.lidar)
    for tick in range(5):
        turned = 1.2 + 0.05 * tick
        state = RobotState((0.0, 0.0), turned, 0.0)
        _, nav = nav.step(state, sensor.scan((0.0, 0.0), turned, tick), STEP * tick)
        angle = abs(math.remainder(math.radians(150) - turned, math.tau))
        assert float(nav.trajectory.time_at(1e-3)) > STEP * tick + angle / 1.0


@pytest.mark.parametrize("beside", [1e-5, 1e-4, 1e-3, 1e-2, 0.2, 0.5])
def test_a_robot_leaves_what_is_nearly_a_cusp_when_it_looks_as_its_controller_wants(
    beside: float,
) -> None:
    """Law and controller took its heading from different points there, and it stood for ever."""
    robot = {"radius_m": 0.2, "drive": {"differential": {"track_m": 0.4}}}
    route = {"start": [0, 0], "via": [[5, 0]], "goal": [2, beside]}
    spline = {"tangents": "cardinal"}
    nav = Navigator(Mission.model_validate({"robot": robot, "route": route, "spline": spline}))
    state, path = nav._state, nav.path
    controller = state.progress.controller
    assert controller is not None
    places = path.distance(np.linspace(0.0, path.domain[1], 4001))
    headings = np.unwrap(np.asarray(path.heading(path.parameter(places))))
    turn = float(places[int(np.argmax(np.abs(np.diff(headings))))])
    for distance in turn + np.array([-1e-4, -1e-6, 0.0, 1e-6, 2e-6, 1e-5, 1e-4]):
        believed = np.zeros(STATE)
        believed[HEADING] = heading_after(controller.reference, distance)
        stands = replace(controller, believed=believed)
        progress = replace(state.progress, distance=float(distance), controller=stands)
        law = trajectory_within_sight(
            nav._task, progress, state.knowledge, state.schedule, 0.0, path=path, turns=()
        )
        here = [stop for stop in law.stations if abs(stop.distance - distance) < 1e-6]
        assert not here  # it may turn where the path does, ahead of it


def test_one_that_brakes_at_once_is_where_its_old_law_has_it_as_long_as_it_is_committed(
    mission_of: Make,
) -> None:
    """It had the speed of now and the place of then, and stopped behind where it should."""
    nav = Navigator(mission_of([0, 0], [40, 0], max_speed_mps=2, max_accel_mps2=1))
    task, state = nav._task, nav._state
    now = replace(state.progress, time=3.0, distance=float(nav.trajectory.distance_at(3.0)))
    committed = replace(state.schedule, committed_until=4.0)
    for speed in (0.5, 2.0):
        law = braking_at_once(task, now, committed, speed)
        place, then, _ = nav.trajectory.state_at(4.0)
        assert float(law.distances[-1]) == pytest.approx(float(place + then**2 / 2.0))


def test_a_stop_that_just_does_ends_where_the_path_ends_whatever_the_rounding_says(
    mission_of: Make,
) -> None:
    """Of one in sixty the last place was beyond the path by a bit."""
    nav = Navigator(mission_of([0, 0], [21.3, 1.7], max_accel_mps2=0.7))
    task, state, length = nav._task, nav._state, nav.path.length
    for speed in np.linspace(0.3, 1.9, 400).tolist():
        left = speed**2 / (2.0 * task.limits.brake)
        now = replace(state.progress, time=3.0, distance=length - left)
        law = braking_at_once(task, now, state.schedule, speed)
        assert length - 1e-9 < float(law.distances[-1]) <= length


@pytest.mark.parametrize("goal", [(14, 1), (18, 5)])
def test_a_drive_that_is_timed_in_parts_stops_at_its_goal(goal: tuple[float, float]) -> None:
    """In the last centimetre, too, where it is measured before or behind its time law."""
    robot = {
        "max_speed_mps": 5, "max_accel_mps2": 2, "max_yaw_accel_degps2": 60,
        "drive": {"ackermann": {"wheelbase_m": 0.864, "max_steer_deg": 45}, "delay_s": 0.05},
        "tracking_error_m": 0.1,
    }  # fmt: skip
    route = {"start": [0, 0], "via": [[7, 6]], "goal": list(goal)}
    run = simulate(Mission.model_validate({"robot": robot, "route": route}))
    assert run.reached, run.reason
    assert math.dist(run.positions[-1], goal) < 0.05


def there_and_back(
    mission_of: Make, beyond: float, dwell: float, sensor: dict[str, Any], **robot: Any
) -> Mission:
    """To a place and back, by the paper's spline, which turns by a cusp a little behind it."""
    far = {"at": [FAR, 0], "dwell_s": dwell} if dwell else [FAR, 0]
    limits = {"max_speed_mps": 1.0, "max_yaw_rate_degps": 20.0, "sensor": sensor, **robot}
    mission = mission_of((0, 0), far, (beyond, 0), **limits)
    spline = mission.spline.model_copy(update={"tangents": "cardinal"})
    return mission.model_copy(update={"spline": spline})


LIDAR, RANGE, JERKY = {"lidar": {"range_m": 6}}, {"range_m": 6}, {"max_jerk_mps3": 1.0}


@pytest.mark.parametrize(
    ("sensor", "beyond", "dwell", "robot"),
    [
        (LIDAR, 0.0, 0.0, {}),
        (LIDAR, 0.002, 15.0, {}),
        (LIDAR, 0.1, 2.0, {}),
        pytest.param(LIDAR, 0.002, 0.0, JERKY, marks=pytest.mark.slow),
        (RANGE, 0.002, 0.0, JERKY),
        (RANGE, 0.1, 2.0, {}),
    ],
)
def test_a_robot_without_a_drive_stands_as_long_as_it_takes_to_turn_back(
    mission_of: Make, sensor: dict[str, Any], beyond: float, dwell: float, robot: dict[str, Any]
) -> None:
    navs = drive(there_and_back(mission_of, beyond, dwell, sensor, **robot))
    assert navs[-1].finished
    turn = 180.0 / 20.0
    times, speeds, _, _ = driven(navs)
    stood = STEP / 10 * np.count_nonzero(speeds[(times > 1.0) & (times < times[-1] - 1.0)] == 0.0)
    apart = beyond >= 0.1  # the station is one rest, the cusp behind it another
    expected = turn + dwell if apart else max(turn, dwell)
    assert expected - 2 * STEP <= stood <= expected + 2 * STEP
    assert times[-1] - expected < 2.0 * FAR + 7.0


def test_a_robot_without_a_drive_is_told_to_turn_while_it_stands(mission_of: Make) -> None:
    nav = Navigator(there_and_back(mission_of, 0.1, 0.0, {"range_m": 6}))
    heading, time, turned = 0.0, 0.0, []
    while not nav.finished and time < 60.0:
        there = nav.reference(time)
        command, nav = nav.step(RobotState(there.position, heading, there.speed), (), time)
        assert abs(command.yaw_rate) <= math.radians(20.0) + 1e-9
        if command.stopped and time > 1.0:
            turned.append(heading)
        heading, time = heading + STEP * command.yaw_rate, time + STEP
    assert nav.finished
    leaves = turned[round(180.0 / 20.0 / STEP) - 2]
    assert abs(math.remainder(leaves - math.pi, math.tau)) < 0.15
    assert abs(math.remainder(heading - math.pi, math.tau)) < 0.05


@pytest.mark.parametrize("held", [20.0, 90.0, 180.0, 270.0])
def test_whichever_way_a_body_looks_a_new_law_goes_on_from_its_speed(held: float) -> None:
    wheels = {"max_speed_along_mps": 1.0, "max_speed_across_mps": 1.0, "hold_heading_deg": held}
    robot = {
        "radius_m": 0.3, "max_speed_mps": 1.0, "max_accel_mps2": 0.5,
        "drive": {"omnidirectional": wheels}, "localization": {"position_noise_m": 0.02},
    }  # fmt: skip
    route = {"start": [0, 0], "goal": [8, 0]}
    run = simulate(Mission.model_validate({"route": route, "robot": robot}))
    assert run.reached  # by its noise it is ahead of its law again and again, which begins anew
    assert run.duration <= 1.1 * run.plan.trajectory.duration
