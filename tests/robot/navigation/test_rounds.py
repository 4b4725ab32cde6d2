"""A closed route of many laps is driven as one round that goes on at its end."""

from __future__ import annotations

import gc
import tracemalloc
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.curve.path import SEAM
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.spline_spec import SplineSpec
from viaspline.planner import plan
from viaspline.robot.logbook import Logbook
from viaspline.robot.navigation.laps_ahead import LapsAhead
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.range_sensor import RangeSensor
from viaspline.robot.replanning import deadline
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate
from viaspline.world.world import World

SQUARE = [[0, 0], [60, 0], [60, 50], [0, 50]]


def patrol(laps: int, unseen: list[Any] | None = None, **robot: Any) -> Mission:
    robot = {"sensor": {"range_m": 10}, "radius_m": 0.3, "clearance_m": 0.2, **robot}
    route = {"start": SQUARE[0], "via": SQUARE[1:], "closed": True, "laps": laps}
    world = {"unseen": unseen or []}
    return Mission.model_validate({"world": world, "robot": robot, "route": route})


def disc(x: float, y: float, radius: float, name: str) -> dict[str, Any]:
    return {"name": name, "circle": {"center": [x, y], "radius": radius}}


@cache
def beside() -> tuple[float, float]:
    """A place a little beside the path [m]."""
    x, y = plan(patrol(1)).path.at_distance(36.0)
    return float(x), float(y) + 0.2


def statuses(run: Run) -> list[str]:
    return [visit.status for visit in run.visits]


def test_a_drive_of_many_laps_is_that_of_its_plan() -> None:
    mission = patrol(5)
    run = simulate(mission)
    assert run.reached
    np.testing.assert_array_equal(run.path.spans, run.plan.path.spans)
    assert run.duration == pytest.approx(run.plan.trajectory.duration, rel=1e-9)
    times = np.linspace(0.0, run.duration, 500)
    along = run.plan.trajectory.distance_at(times)
    places = np.column_stack([np.interp(times, run.times, axis) for axis in run.positions.T])
    assert np.abs(places - run.plan.path.at_distance(along)).max() < 2e-3  # chords of 0.05 s
    assert statuses(run) == ["served"] * 21
    assert [via.index for via in run.path.vias] == list(range(21))


def test_the_path_ahead_is_a_round_whatever_the_laps() -> None:
    short, long = Navigator(patrol(4)), Navigator(patrol(40))
    np.testing.assert_array_equal(short.path.spans, long.path.spans)
    assert short.path.vias[-1].name == SEAM
    for time in np.arange(0.0, 400.0, 1.0):
        _, long = long.step(long.reference(time), [], time)
        gap = long.path.evaluate(long.path.domain[1]) - long.path.evaluate(0.0)
        assert np.abs(gap).max() < 1e-9
        assert len(long.path.spans) == len(short.path.spans)
        assert long.quiet_until >= time
    assert long.driven + long.distance == pytest.approx(
        float(long.plan.trajectory.distance_at(399.0)), abs=1e-6
    )


def test_a_drive_of_few_laps_is_one_path() -> None:
    nav = Navigator(patrol(3))
    assert nav.path.length == nav.plan.path.length
    assert nav.quiet_until == nav.trajectory.end_time


def test_a_lap_that_is_short_is_driven_with_others_as_one_round() -> None:
    route = {"start": [0, 0], "via": [[8, 0], [8, 8], [0, 8]], "closed": True, "laps": 30}
    mission = Mission.model_validate({"robot": {"max_speed_mps": 3}, "route": route})
    nav = Navigator(mission)
    laps = nav.path.length / (nav.plan.path.length / 30)
    assert 1.5 < laps < 10
    run = simulate(mission)
    assert run.reached
    np.testing.assert_array_equal(run.path.spans, run.plan.path.spans)
    assert statuses(run) == ["served"] * 121


finds = st.lists(
    st.tuples(st.sampled_from(range(4)), st.floats(0.1, 0.9), st.floats(-3, 3), st.floats(0.2, 2)),
    min_size=1,
    max_size=6,
)


@pytest.mark.slow
@given(finds)
@example([(0, 0.1, 0.0, 2.0)])  # beside the start, where every lap ends
@example([(3, 0.9, 0.1, 1.0), (0, 0.1, -0.1, 1.0)])
@settings(deadline=None, max_examples=8)
def test_what_is_found_on_one_lap_is_gone_round_on_all_of_them(
    gap_of: Callable[..., float], found: list[tuple[int, float, float, float]]
) -> None:
    corners = np.array([*SQUARE, SQUARE[0]], float)
    unseen = []
    for k, (side, part, aside, radius) in enumerate(found):
        along = corners[side + 1] - corners[side]
        normal = np.array([-along[1], along[0]]) / np.hypot(*along)
        unseen.append(disc(*(corners[side] + part * along + aside * normal), radius, f"find {k}"))
    mission = patrol(4, unseen)
    run = simulate(mission)
    world = World.everything(mission)
    assert gap_of(run.path.sample(0.02)[2], world.obstacles) >= 0.5 - 1e-5, run.reason
    assert run.reached == (run.reason is None)
    if run.reached:
        assert run.certificate.clearance >= 0.2 - 1e-6
        assert len(run.visits) == 17
        assert "failed" not in statuses(run)
    for replan in run.replans:
        assert replan.position_jump < 1e-6
        if replan.mode != "from_rest":
            assert replan.heading_jump < 1e-6
            assert replan.curvature_jump < 1e-6


def test_the_same_find_on_a_round_gives_the_same_drive() -> None:
    one, again = (simulate(patrol(4, [disc(*beside(), 1.0, "rock")])) for _ in range(2))
    assert one.replans
    assert one.path.spans.tobytes() == again.path.spans.tobytes()
    assert one.events == again.events


def test_a_find_is_gone_round_once_and_then_is_part_of_every_lap() -> None:
    run = simulate(patrol(6, [disc(*beside(), 1.0, "rock")]))
    assert run.reached
    assert len(run.replans) == 1
    joints = np.flatnonzero(np.hypot(*(run.path.spans[:, 0] - run.path.spans[0, 0]).T) < 1e-9)
    assert len(joints) == 6
    late = run.path.spans[joints[3] : joints[4]]
    np.testing.assert_array_equal(late, run.path.spans[joints[4] : joints[5]])
    length = run.replans[0].driven + run.replans[0].path.length
    assert length < run.path.length / 3


def test_a_point_that_is_covered_is_given_up_on_every_lap() -> None:
    run = simulate(patrol(5, [disc(60, 50, 2.0, "boulder")]))
    assert run.reached, run.reason
    assert statuses(run) == (["served", "served", "skipped", "served"] * 5) + ["served"]
    reasons = {visit.reason for visit in run.visits if visit.status == "skipped"}
    assert reasons == {"'boulder' covers it"}
    assert [event.kind for event in run.events].count("skipped") == 5


def test_the_place_where_the_drive_ends_can_not_be_given_up() -> None:
    run = simulate(patrol(4, [disc(0, 0, 0.1, "post")]))
    assert not run.reached
    mission = patrol(4)
    nav = Navigator(mission)
    for time in np.arange(0.0, 90.0, 0.5):
        _, nav = nav.step(nav.reference(time), [], time)
    post = Obstacle.model_validate(disc(0, 0, 0.1, "post"))
    for time in np.arange(90.0, 400.0, 0.5):
        _, nav = nav.step(nav.reference(time), [post], time)
    assert nav.finished
    assert nav.reason is not None
    assert "the goal 'start' can't be reached any more" in nav.reason


def test_stays_are_made_on_every_lap() -> None:
    pump = {"at": SQUARE[2], "dwell_s": 3, "name": "pump"}
    via = [SQUARE[1], pump, SQUARE[3]]
    route = {"start": SQUARE[0], "via": via, "closed": True, "laps": 4}
    run = simulate(Mission.model_validate({"route": route}))
    assert run.reached
    assert [event.kind for event in run.events].count("arrived") == 4
    assert run.duration == pytest.approx(run.plan.trajectory.duration, rel=1e-9)


def test_points_are_noted_as_given_up_once_a_lap() -> None:
    laps = LapsAhead(points=4, round=8, goal=40, unseen=10.0).without({5: "covered"})
    assert laps.newly_missed(4, 6) == ()  # that was noted when it was given up
    assert laps.newly_missed(12, 14) == ((13, "covered"),)
    assert laps.newly_missed(8, 11) == ()
    assert laps.is_goal(36)
    assert not laps.is_goal(37)


@pytest.mark.slow
def test_what_is_kept_grows_with_what_is_known_and_not_with_the_drive() -> None:
    mission = patrol(60, radius_m=0.05, clearance_m=0.05, sensor={"range_m": 8.0})
    nav, replans, tick, kept = Navigator(mission), 0, 0, []
    tracemalloc.start()
    for found in range(24):
        at = nav.distance + 10.0
        place = nav.path.at_distance(at if at < nav.path.length else at - nav.path.length)
        if np.hypot(*(np.array(SQUARE) - place).T).min() > 1.0:
            thing = Obstacle.model_validate(disc(*place.tolist(), 0.02, f"thing {found}"))
            until = tick + 5
            while tick < until:
                _, nav = nav.step(nav.reference(float(tick)), [thing], float(tick))
                replans, tick = replans + len(nav.replans), tick + 1
        tick += 1
        _, nav = nav.step(nav.reference(float(tick)), [], float(tick))
        if found in (11, 23):
            gc.collect()  # what is left over of searches that were stopped isn't kept
            kept.append(tracemalloc.get_traced_memory()[0])
    tracemalloc.stop()
    assert nav.reason is None
    assert replans > 18
    growth = (kept[1] - kept[0]) / 12
    assert growth < 24_000  # bytes for each thing: itself, its place in the world, its detour


def test_a_logbook_has_what_the_steps_handed_out() -> None:
    mission = patrol(5, [disc(*beside(), 1.0, "rock")])
    run, nav, book = simulate(mission, step=0.1), Navigator(mission), Logbook()
    sensor = RangeSensor(mission.world.unseen, 10.0)
    for tick in range(10_000):
        state = nav.reference(tick * 0.1)
        _, nav = nav.step(state, sensor.seen(state.position), tick * 0.1)
        book.note(nav)
        if nav.finished:
            break
    assert [(e.kind, e.message) for e in book.events] == [(e.kind, e.message) for e in run.events]
    assert [replan.driven for replan in book.replans] == [r.driven for r in run.replans]
    np.testing.assert_allclose(book.path(nav).spans, run.path.spans, atol=1e-9)


def test_a_search_that_has_no_time_on_a_round_goes_on_at_rest_and_serves_every_lap(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(deadline, "STEP_WORK_S", 1e-3)
    monkeypatch.setattr(deadline, "STANDING_WORK_S", 1e-3)
    run = simulate(patrol(5, [disc(*beside(), 1.0, "rock")]))
    assert run.reached, run.reason
    assert run.certificate.holds
    assert "braked" in [event.kind for event in run.events]
    assert [replan.obstacles for replan in run.replans] == [("rock",)]
    assert statuses(run) == ["served"] * 21


def test_a_search_that_has_no_time_on_a_round_keeps_the_side_that_is_asked_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    tried = [
        ("left", 1.0, -0.5, 1e-3), ("right", -1.0, 0.5, 0.1),
        ("left", 1.0, 1.8, 0.1), ("right", -1.0, -1.8, 1e-3),  # only passed on the wrong side
    ]  # fmt: skip
    for side, sense, y, limit in tried:
        rock = {**disc(30, y, 1.0, "rock"), "pass_on": side}
        straight = patrol(4, [rock]).model_copy(update={"spline": SplineSpec(tension=0.95)})
        monkeypatch.setattr(deadline, "STEP_WORK_S", limit)
        monkeypatch.setattr(deadline, "STANDING_WORK_S", limit)
        run = simulate(straight)
        assert run.reached, run.reason
        assert run.replans
        line = run.path.sample(0.05)[2]
        beside = line[(np.abs(line[:, 0] - 30.0) < 0.1) & (line[:, 1] < 20.0)]
        assert len(beside)
        assert (sense * (beside[:, 1] - y) > 1.4).all()


def test_on_a_round_the_jerk_keeps_its_limit_from_part_to_part() -> None:
    jerk = 1.5
    nav, states = Navigator(patrol(3, max_jerk_mps3=jerk)), []
    while not nav.finished:
        time = 0.1 * len(states)
        states.append([float(x) for x in nav.trajectory.state_at(time)[1:]])
        _, nav = nav.step(nav.reference(time), [], time)
    assert nav.reached
    assert np.abs(np.diff([accel for _, accel in states])).max() <= 1.001 * jerk * 0.1
    assert nav.driven + nav.path.length == pytest.approx(nav.plan.path.length)


SMALL = {"start": [0, 0], "via": [[7, 0], [7, 5], [0, 5]], "closed": True}
LIDAR = {"lidar": {"range_m": 2.5, "fov_deg": 360, "beams": 90}}
CART = {
    "drive": {"differential": {"track_m": 0.4}, "delay_s": 0.1},
    "tracking_error_m": 0.1,
    "max_yaw_rate_degps": 90,
}


@pytest.mark.parametrize("drive", [pytest.param({}, marks=pytest.mark.slow), CART])
def test_with_a_lidar_the_path_ahead_is_a_round_too(drive: dict[str, Any]) -> None:
    robot = {"radius_m": 0.3, "clearance_m": 0.15, "max_speed_mps": 1.5, "sensor": LIDAR, **drive}
    unseen = [disc(3.5, -0.1, 0.25, "post"), disc(8.5, 2.5, 0.5, "beside")]
    mission = Mission.model_validate(
        {"world": {"unseen": unseen}, "robot": robot, "route": {**SMALL, "laps": 4}}
    )
    lengths = []

    def note(step: Any) -> None:
        lengths.append(len(step.nav.path.spans))

    nav = Navigator(mission, warm=False)
    assert nav.path.length < 0.5 * nav.plan.path.length
    run = simulate(mission, plan=nav.plan, watch=note, step=0.1)
    assert run.reached, run.reason
    assert statuses(run) == ["served"] * 17
    assert run.certificate.clearance >= 0.05  # of the driven body, by what is kept to track
    assert max(lengths) < 3 * lengths[0]  # a lap and its detours
    found = [event for event in run.events if event.kind == "replanned"]
    assert 0 < len(found) < 12  # a detour that was found on one lap is there on the next
    never = ("deviation", "pose_jump", "slip")  # where a path turns back on itself, it looks so
    assert not [event.kind for event in run.events if event.kind in never]
    passed = [via.index for via in run.path.vias if via.kind == "user"]
    assert passed == list(range(17))
    if run.tracking is not None:
        assert float(np.abs(run.tracking.cross_track).max()) < 0.1
