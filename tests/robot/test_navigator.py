"""The navigator in a person's own control loop."""

from __future__ import annotations

import copy
import math
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from viaspline.errors import GeometryError, NoPathError
from viaspline.mission.model import Mission
from viaspline.mission.sensor_spec import Lidar
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.replanning import replan
from viaspline.robot.logbook import Logbook
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.simulator import simulate
from viaspline.robot.state import RobotState

Make = Callable[..., Mission]
Shape = Callable[..., dict[str, Any]]
ROCK = Obstacle(circle=Circle(center=(25, 0.5), radius=2), name="rock")


def drive(nav: Navigator, until: float, step: float = 0.1) -> Navigator:
    """Follow exactly, with nothing to see."""
    for time in np.arange(0.0, until, step):
        _, nav = nav.step(nav.reference(time), [], time)
    return nav


def test_a_step_leaves_the_navigator_as_it_was(mission_of: Make) -> None:
    nav = drive(Navigator(mission_of([0, 0], [50, 0])), 6.0)
    state = nav.reference(6.0)
    first = nav.step(state, [ROCK], 6.0)
    second = nav.step(state, [ROCK], 6.0)
    assert first[0] == second[0]
    assert first[1].events == second[1].events
    assert "detected" not in [event.kind for event in nav.events]
    assert np.array_equal(first[1].path.spans, second[1].path.spans)


def test_a_stored_navigator_goes_on_as_itself(mission_of: Make) -> None:
    driven = drive(Navigator(mission_of([0, 0], [50, 0])), 4.0)
    state = driven.reference(4.0)
    expected, _ = driven.step(state, [ROCK], 4.0)
    for stored in (pickle.loads(pickle.dumps(driven)), copy.deepcopy(driven)):
        command, after = stored.step(state, [ROCK], 4.0)
        assert command == expected
        assert [event.kind for event in after.events] == ["detected", "replanned"]


def test_a_position_may_be_an_array(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], [50, 0]))
    for time in (0.0, 0.1, 0.2):
        state = RobotState(np.array([0.0, 0.0]), 0.0, 0.0)  # type: ignore[arg-type]
        _, nav = nav.step(state, [], time)
    assert state == RobotState((0.0, 0.0), 0.0, 0.0)
    with pytest.raises(GeometryError, match="position: expected numbers"):
        RobotState("ab", 0.0, 0.0)  # type: ignore[arg-type]


def test_what_is_known_already_makes_no_difference(mission_of: Make, disc_at: Shape) -> None:
    mission = mission_of([0, 0], [50, 0], known=[disc_at(25, 0.5, 2, "rock")])
    nav = Navigator(mission)
    _, nav = nav.step(nav.reference(0.0), [ROCK, ROCK], 0.0)
    assert [event.kind for event in nav.events] == ["started"]
    other = Obstacle(circle=Circle(center=(25, 30), radius=2))
    seen = []
    for time in (1.0, 2.0):
        _, nav = nav.step(nav.reference(time), [other, ROCK, other], time)
        seen += [event.kind for event in nav.events]
        assert nav.replans == ()
    assert seen == ["detected"]
    assert len(nav.world) == 2


def test_a_thing_beside_the_path_behind_the_robot_changes_nothing(mission_of: Make) -> None:
    nav = drive(Navigator(mission_of([0, 0], [50, 0])), 20.0)
    assert nav.distance > 30
    _, nav = nav.step(nav.reference(20.0), [ROCK], 20.0)
    assert nav.events[-1].kind == "detected"
    assert nav.replans == ()


def test_time_may_begin_at_any_hour(mission_of: Make) -> None:
    mission = mission_of([0, 0], [30, 10], [50, 0])
    early, late = Navigator(mission), Navigator(mission)
    first, second = Logbook(), Logbook()
    for time in np.arange(0.0, 60.0, 0.5):
        _, early = early.step(early.reference(time), [], time)
        first.note(early)
    state = late.reference(0.0)
    for time in np.arange(1e6, 1e6 + 60.0, 0.5):
        _, late = late.step(state, [], time)
        second.note(late)
        state = late.reference(time + 0.5)
    assert late.reached
    assert [e.kind for e in second.events] == [e.kind for e in first.events]
    assert [e.time - 1e6 for e in second.events] == pytest.approx([e.time for e in first.events])


def test_it_drives_no_faster_than_lets_it_stop_inside_what_it_has_seen(mission_of: Make) -> None:
    mission = mission_of([0, 0], [90, 0], max_speed_mps=9.0, sensor={"range_m": 5.0})
    nav = Navigator(mission, reaction=0.2)
    v = nav.trajectory.speeds.max()
    assert v**2 / 2 + v * 0.2 == pytest.approx(5.0 - 0.5 - 0.5)
    blind = mission.model_copy(update={"robot": mission.robot.model_copy(update={"sensor": None})})
    assert Navigator(blind).trajectory.speeds.max() > 8.9


def follow(
    nav: Navigator, state: RobotState, step: float = 0.05, noise: float = 0.0
) -> tuple[Navigator, np.ndarray, Logbook]:
    """A unicycle that obeys commands, measured with noise."""
    rng = np.random.default_rng(0)
    (x, y), heading, speed = state.position, state.heading, state.speed
    track, time, book = [(x, y)], 0.0, Logbook()
    while not nav.finished and time < 300:
        slip = rng.normal(0, noise, 3)
        measured = RobotState((x + slip[0], y + slip[1]), heading + slip[2], speed)
        command, nav = nav.step(measured, [], time)
        book.note(nav)
        speed = command.speed
        if command.stopped:
            heading = command.heading
        x += speed * math.cos(heading) * step
        y += speed * math.sin(heading) * step
        heading += command.curvature * speed * step
        speed = max(speed + command.acceleration * step, 0.0)
        time += step
        track.append((x, y))
    return nav, np.array(track), book


def test_a_robot_that_starts_beside_its_path_comes_back_to_it(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], [30, 10], [60, -10], [90, 0]))
    nav, track, book = follow(nav, RobotState((0.0, 0.5), 0.3, 0.0))
    assert nav.reached
    for via in nav.path.vias[1:]:
        assert np.linalg.norm(track - via.at, axis=1).min() < 0.15
    assert [visit.status for visit in book.visits(nav)] == ["served"] * 4


def test_noise_in_what_is_measured_does_no_harm(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], {"at": [30, 10], "dwell_s": 3}, [60, -10], [90, 0]))
    nav, track, book = follow(nav, nav.reference(0.0), noise=0.02)
    assert nav.reached
    for via in nav.path.vias:
        assert np.linalg.norm(track - via.at, axis=1).min() < 0.3
    told = [e.kind for e in book.events]
    assert [kind for kind in told if kind != "deviation"] == [
        "started", "arrived", "dwell", "via", "reached",
    ]  # fmt: skip
    assert told.count("deviation") <= 4  # it has no drive, so nothing was kept for that


def test_a_robot_that_lags_gets_a_new_time_law_from_where_it_is(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], [50, 0]))
    _, nav = nav.step(nav.reference(0.0), [], 0.0)
    command, nav = nav.step(RobotState((3.0, 0.0), 0.0, 1.5), [], 10.0)
    assert nav.distance == pytest.approx(3.0, abs=1e-5)
    assert command.speed == pytest.approx(1.5)
    assert nav.trajectory.start_time == 10.0
    assert command.acceleration == pytest.approx(1.0)


@pytest.mark.parametrize("period", [0.1, 0.5, 1.0])
def test_it_is_as_fast_as_planned_however_long_its_steps_are(
    mission_of: Make, period: float
) -> None:
    nav, x, speed = Navigator(mission_of([0, 0], [20, 0]), period=period), 0.0, 0.0
    for tick in range(math.ceil(nav.trajectory.duration / period) + 1):
        command, nav = nav.step(RobotState((x, 0.0), 0.0, speed), [], tick * period)
        speed = command.velocity[0]
        x += period * speed
    assert nav.reached
    assert x == pytest.approx(20.0, abs=1e-6)


@pytest.mark.parametrize("period", [0.05, 0.2, 0.5])
def test_a_twist_that_is_held_from_step_to_step_keeps_it_on_its_path(
    mission_of: Make, period: float
) -> None:
    mission = mission_of([0, 0], [20, 0], [20, 20], [0, 20])
    nav = Navigator(mission, period=period)
    path, end = nav.path, nav.trajectory.duration
    x, y, heading, speed, time, off = 0.0, 0.0, float(path.heading(0.0)), 0.0, 0.0, 0.0
    while not nav.finished and time < 2.0 * end:
        command, nav = nav.step(RobotState((x, y), heading, speed), [], time)
        speed, rate = command.velocity[0], command.yaw_rate
        for _ in range(50):  # arcs, by their chords
            heading += 0.5 * rate * period / 50
            x += speed * math.cos(heading) * period / 50
            y += speed * math.sin(heading) * period / 50
            heading += 0.5 * rate * period / 50
        time += period
        off = max(off, path.project((x, y)).distance)
    assert nav.reached
    assert off < 0.05 * period / 0.05
    assert time < end + 2.0 + 2.0 * period


def test_progress_on_a_route_that_crosses_itself_is_not_mistaken(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], [20, 0], [20, 20], [10, 20], [10, -20]))
    # beside the crossing at (10, 0) on the first leg, not on the last
    _, nav = nav.step(nav.reference(0.0), [], 0.0)
    time = float(nav.trajectory.time_at(10.0))
    x, y = nav.reference(time).position
    _, nav = nav.step(RobotState((x, y + 0.3), 0.0, 2.0), [], time)
    assert nav.distance == pytest.approx(10.0, abs=0.5)


def refused(*_: object, **__: object) -> Solution:
    raise NoPathError("no", where=(0, 0), remedy="nothing")


@pytest.mark.parametrize("mode", ["reflex", "planned", "from_rest"])
def test_the_ways_are_tried_from_the_least_change_to_the_greatest(
    mission_of: Make, monkeypatch: pytest.MonkeyPatch, mode: str
) -> None:
    order = ["reflex", "planned", "from_rest"]
    for name in order[: order.index(mode)]:
        monkeypatch.setattr(replan, name, refused)
    nav = drive(Navigator(mission_of([0, 0], [50, 0])), 6.0)
    _, nav = nav.step(nav.reference(6.0), [ROCK], 6.0)
    assert [r.mode for r in nav.replans] == [mode]
    assert (nav.replans[0].heading_jump < 1e-6) == (mode != "from_rest")
    assert [e.kind for e in nav.events].count("braked") == (mode == "from_rest")
    record = nav.replans[0]
    assert record.obstacles == ("rock",)
    assert len(nav.compute_times) == 1
    for time in np.arange(6.0, 60.0, 0.1):
        _, nav = nav.step(nav.reference(time), [], time)
    assert nav.reached


def test_no_way_at_all_is_a_stop_with_the_reason_and_the_remedy(
    mission_of: Make, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("reflex", "planned", "from_rest"):
        monkeypatch.setattr(replan, name, refused)
    nav = drive(Navigator(mission_of([0, 0], [50, 0])), 6.0)
    _, nav = nav.step(nav.reference(6.0), [ROCK], 6.0)
    assert nav.reason == "no: nothing"
    _, nav = nav.step(nav.reference(30.0), [], 30.0)
    assert nav.finished
    assert not nav.reached
    assert Logbook().visits(nav)[-1].reason == "no: nothing"


def test_a_new_path_that_bends_too_sharply_for_the_speed_is_left_later_or_from_rest(
    mission_of: Make,
) -> None:
    mission = mission_of(
        [0, 0], [90, 0], max_speed_mps=6.0, max_lateral_accel_mps2=0.3, sensor={"range_m": 20}
    )
    nav = drive(Navigator(mission), 9.0)
    state = nav.reference(9.0)
    near = Obstacle(circle=Circle(center=(state.position[0] + 22.0, 0.2), radius=2), name="near")
    for time in np.arange(9.0, 12.0, 0.05):
        _, nav = nav.step(nav.reference(time), [near], time)
        assert nav.trajectory.over_limit_until is None
        if nav.replans:
            break
    assert nav.replans
    path, trajectory = nav.path, nav.trajectory
    u = np.linspace(float(path.parameter(nav.distance)), path.domain[1], 5000)
    speed = trajectory.speed_at(path.distance(u))
    assert np.all(speed**2 * np.abs(path.curvature(u)) <= 0.3 * (1 + 1e-6))


def test_a_route_in_space_is_driven_along_its_ground_track(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0, 5], [30, 10, 9], [60, 0, 5]))
    command, nav = nav.step(nav.reference(0.0), [], 0.0)
    assert len(command.position) == 3
    command, _ = nav.step(nav.reference(15.0), [], 15.0)
    assert command.curvature < 0  # it turns right


def test_a_thing_seen_after_the_end_changes_nothing(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], [5, 0]))
    _, nav = nav.step(nav.reference(0.0), [], 0.0)
    _, nav = nav.step(nav.reference(60.0), [], 60.0)
    assert nav.reached
    late = Obstacle(circle=Circle(center=(5, 0), radius=1.0))
    command, after = nav.step(nav.reference(61.0), [late], 61.0)
    assert after.reached
    assert after.events == ()
    assert command.stopped


def test_a_state_that_is_not_finite_is_refused(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], [50, 0]))
    with pytest.raises(GeometryError, match="2 finite coordinates"):
        nav.step(RobotState((0.0, float("nan")), 0.0, 0.0), [], 0.0)
    with pytest.raises(GeometryError, match="2 finite coordinates"):
        nav.step(RobotState((0.0, 0.0, 0.0), 0.0, 0.0), [], 0.0)
    with pytest.raises(GeometryError, match="reaction is 0"):
        Navigator(mission_of([0, 0], [50, 0]), reaction=0.0)


def test_a_sight_inside_the_body_is_refused(mission_of: Make) -> None:
    with pytest.raises(GeometryError, match="not past the robot's own body"):
        simulate(mission_of([0, 0], [50, 0], sensor={"range_m": 0.4}))


def test_a_scan_for_a_robot_without_a_lidar_is_refused(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], [20, 0]))
    scan = LidarSensor([], Lidar(range_m=5)).scan((0.0, 0.0), 0.0)
    with pytest.raises(GeometryError, match="has no lidar"):
        nav.step(nav.reference(0.0), scan, 0.0)
