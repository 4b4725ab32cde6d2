"""Driving: what is visited, what is recorded, what is promised."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from viaspline.curve.certificate import certify
from viaspline.errors import GaveUpError, GeometryError, MissionError, PlanningError
from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.robot.logbook import Logbook
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.range_sensor import RangeSensor
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate
from viaspline.world.world import World

Make = Callable[..., Mission]
Shape = Callable[..., dict[str, Any]]


def kinds(run: Run) -> list[str]:
    return [event.kind for event in run.events]


def as_bytes(run: Run) -> bytes:
    arrays = (run.times, run.positions, run.headings, run.speeds, run.curvatures, run.path.spans)
    plain = (run.reached, run.reason, run.duration, run.visits, run.events, run.certificate)
    joints = tuple((r.time, r.mode, r.distance, r.path.spans.tobytes()) for r in run.replans)
    return b"".join(a.tobytes() for a in arrays) + repr((plain, joints)).encode()


def test_a_world_with_nothing_in_it_is_driven_as_planned(mission_of: Make) -> None:
    run = simulate(mission_of([0, 0], [30, 20], [60, 0]))
    assert run.reached
    assert run.reason is None
    assert kinds(run) == ["started", "via", "reached"]
    assert run.duration == pytest.approx(run.plan.trajectory.duration)
    assert np.array_equal(run.path.spans, run.plan.path.spans)
    assert run.certificate.clearance == np.inf
    assert run.replans == ()


def test_the_samples_are_a_steady_clock_and_every_event(mission_of: Make) -> None:
    run = simulate(mission_of([0, 0], [30, 20], [60, 0]), step=0.1)
    assert np.all(np.diff(run.times) > 0)
    assert np.max(np.diff(run.times)) <= 0.1 + 1e-9
    assert run.times[-1] == run.duration
    assert {event.time for event in run.events} <= set(run.times.tolist())
    moved = np.linalg.norm(np.diff(run.positions, axis=0), axis=1)
    assert np.all(moved <= 2.0 * np.diff(run.times) + 1e-6)
    assert len({len(x) for x in (run.times, run.positions, run.headings, run.curvatures)}) == 1


def test_stations_at_the_start_under_way_and_at_the_goal_are_stayed_at(mission_of: Make) -> None:
    run = simulate(
        mission_of(
            {"at": [0, 0], "dwell_s": 3}, {"at": [20, 0], "dwell_s": 5, "name": "pump"},
            {"at": [50, 0], "dwell_s": 2},
        )
    )  # fmt: skip
    assert kinds(run) == ["started", *["arrived", "dwell"] * 3, "reached"]
    stays = [event for event in run.events if event.kind in ("arrived", "dwell")]
    assert [later.time - sooner.time for sooner, later in zip(stays[::2], stays[1::2], strict=True)
            ] == pytest.approx([3, 5, 2])  # fmt: skip
    assert [event.at for event in stays] == [(0, 0), (0, 0), (20, 0), (20, 0), (50, 0), (50, 0)]
    at_pump = (run.times >= stays[2].time) & (run.times <= stays[3].time)
    assert np.ptp(run.positions[at_pump], axis=0) == pytest.approx([0, 0])
    assert run.duration == pytest.approx(3 + 12 + 5 + 17 + 2)


def test_a_detour_during_a_stay_lets_the_stay_go_on(mission_of: Make, disc_at: Shape) -> None:
    mission = mission_of(
        {"at": [0, 0], "dwell_s": 10}, [50, 0], unseen=[disc_at(25, 0.3, 3, "rock")],
        sensor={"range_m": 30},
    )  # fmt: skip
    run = simulate(mission)
    assert kinds(run)[:4] == ["started", "arrived", "detected", "replanned"]
    stay = next(event for event in run.events if event.kind == "dwell")
    assert stay.time == pytest.approx(10.0)
    assert run.reached


def test_a_route_that_crosses_and_repeats_itself_is_visited_in_order(
    mission_of: Make, disc_at: Shape
) -> None:
    points = [[0, 0], [40, 0], [40, 30], [20, 30], [20, -20], [40, -20], [40, 0], [0, 0]]
    run = simulate(
        mission_of(*points, unseen=[disc_at(30, 0.5, 2), disc_at(20, 5, 2), disc_at(29, 22, 1)])
    )
    assert run.reached
    assert [list(visit.at) for visit in run.visits] == points
    times = [visit.time for visit in run.visits]
    assert None not in times
    assert times == sorted(times)
    assert all(visit.miss == pytest.approx(0, abs=1e-6) for visit in run.visits)


def test_a_closed_route_comes_back_to_its_start(mission_of: Make, disc_at: Shape) -> None:
    run = simulate(
        mission_of([0, 0], [40, 0], [40, 30], [0, 30], closed=True, unseen=[disc_at(43, 15, 2)])
    )
    assert run.reached
    assert [visit.name for visit in run.visits] == ["start", "via 1", "via 2", "via 3", "start"]
    assert run.visits[0].time == 0.0
    assert run.visits[-1].time == pytest.approx(run.duration)
    assert run.positions[-1] == pytest.approx([0, 0])
    assert len(run.replans) == 1


def test_a_new_path_contains_what_was_driven_and_joins_it_smoothly(
    mission_of: Make, disc_at: Shape
) -> None:
    mission = mission_of(
        [0, 0], [30, 10], [60, -10], [90, 0], unseen=[disc_at(45, 0, 3), disc_at(75, -8, 2)]
    )
    run = simulate(mission)
    assert run.reached
    assert len(run.replans) == 2
    for replan in run.replans:
        s = np.linspace(0, replan.distance, 200)
        before, after = replan.old_path.at_distance(s), replan.path.at_distance(s)
        assert np.abs(after - before).max() < 1e-6
        assert replan.position_jump < 1e-6
        assert replan.heading_jump < 1e-6
        assert replan.curvature_jump < 1e-6
    assert np.array_equal(run.path.spans, run.replans[-1].path.spans)


def test_progress_is_told(mission_of: Make) -> None:
    told: list[tuple[float, float, float]] = []
    simulate(mission_of([0, 0], [60, 0]), progress=lambda *args: told.append(args))
    times, distances, lengths = zip(*told, strict=True)
    assert list(times) == sorted(times)
    assert distances[0] == 0.0
    assert distances[-1] == pytest.approx(60.0)
    assert lengths == pytest.approx([60.0] * len(lengths))


def test_a_plan_that_is_there_already_is_used(mission_of: Make) -> None:
    mission = mission_of([0, 0], [60, 0])
    ready = plan(mission)
    assert simulate(mission, plan=ready).plan is ready


@pytest.mark.parametrize("step", [0.0, -1.0, float("nan"), float("inf")])
def test_a_step_is_above_zero(mission_of: Make, step: float) -> None:
    with pytest.raises(GeometryError, match="step is"):
        simulate(mission_of([0, 0], [9, 0]), step=step)


def test_a_drive_of_weeks_is_refused_at_once_and_not_when_memory_is_full(mission_of: Make) -> None:
    """A survey of 800 lanes at walking pace took 85 GB of samples."""
    with pytest.raises(GaveUpError, match="takes 1389 h") as refused:
        simulate(mission_of([0, 0], [1e7, 0]))
    assert "139 h" in refused.value.remedy
    run = simulate(mission_of([0, 0], [1e7, 0]), step=5.0)
    assert run.reached


def test_leaving_out_quiet_steps_changes_nothing(mission_of: Make, disc_at: Shape) -> None:
    mission = mission_of(
        [0, 0], {"at": [30, 10], "dwell_s": 4}, [60, -10], [90, 0],
        unseen=[disc_at(45, 0, 3, "a"), disc_at(75, -8, 2, "b"), disc_at(60, 40, 2, "c")],
    )  # fmt: skip
    run = simulate(mission, step=0.05)
    nav = Navigator(mission)
    sensor = RangeSensor(mission.world.unseen, 10.0)
    tick, state, book = 0, nav.reference(0.0), Logbook()
    while not nav.finished:
        command, nav = nav.step(state, sensor.seen(state.position), tick * 0.05)
        book.note(nav)
        if not nav.finished:
            assert command.position == pytest.approx(state.position, abs=1e-6)
        tick += 1
        state = nav.reference(tick * 0.05)
    assert [(e.kind, e.at, e.message) for e in book.events] == [
        (e.kind, e.at, e.message) for e in run.events
    ]
    assert [e.time for e in book.events] == pytest.approx([e.time for e in run.events], abs=1e-9)
    assert np.array_equal(nav.path.spans, run.path.spans)


unseen_discs = st.lists(
    st.tuples(st.floats(8, 82), st.floats(-12, 12), st.floats(0.3, 4)), min_size=1, max_size=5
)


@given(unseen_discs, st.sampled_from([3.0, 6.0, 25.0]), st.sampled_from([None, 0.5]))
@settings(deadline=None, max_examples=12)
def test_it_never_touches_what_its_sensor_shows_in_time(
    mission_of: Make, gap_of: Callable[..., float], disc_at: Shape,
    discs: list[tuple[float, float, float]], reach: float, lateral: float | None,
) -> None:  # fmt: skip
    mission = mission_of(
        [0, 0], [30, 6], [60, -6], [90, 0], unseen=[disc_at(*d) for d in discs],
        sensor={"range_m": reach}, max_speed_mps=4.0, max_lateral_accel_mps2=lateral,
    )  # fmt: skip
    required = mission.robot.radius_m + mission.robot.clearance_m
    run = simulate(mission)
    obstacles = World.everything(mission).obstacles
    _, _, points = run.path.sample(0.01) if run.path.length > 0 else (0, 0, run.positions)
    gap = gap_of(points, obstacles)
    assert "contact" not in kinds(run)
    assert gap >= required - 1e-5, run.reason
    assert run.certificate.clearance <= gap - mission.robot.radius_m + 1e-9
    assert run.reached == (run.reason is None)
    assert run.reached == (kinds(run)[-1] == "reached")
    for replan in run.replans:
        assert replan.position_jump < 1e-6
        if replan.mode != "from_rest":
            assert replan.heading_jump < 1e-6
            assert replan.curvature_jump < 1e-6
    served = [visit.time for visit in run.visits if visit.time is not None]
    assert served == sorted(served)
    assert np.all(run.speeds <= 4.0 + 1e-9)
    acceleration = np.abs(np.diff(run.speeds)) / np.diff(run.times)
    assert np.all(acceleration[np.diff(run.times) > 1e-6] <= 1.0 + 1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("detours", [None, "local"])
@given(st.integers(0, 10_000))
@example(153)  # each stopped in a turn, and went on with its wheels straight
@example(439)
@settings(deadline=None, max_examples=3)
def test_what_is_driven_past_unseen_obstacles_goes_on_as_it_was_at_every_new_path(
    disc_at: Shape, detours: str | None, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    unseen = [disc_at(*rng.uniform((20, 20, 2), (180, 180, 7))) for _ in range(rng.integers(8, 25))]
    stops = [[10, 10], *rng.uniform(20, 180, (int(rng.integers(0, 3)), 2)).tolist(), [190, 190]]
    robot = {"radius_m": 1.0, "sensor": {"range_m": float(rng.choice([6, 9, 15]))}}
    radius = rng.choice([0.0, 4.0, 8.0])
    if radius > 0.0:
        robot |= {"min_turn_radius_m": radius, "turn_on_spot": str(rng.choice(["never", "vias"]))}
    route = {"start": stops[0], "via": stops[1:-1], "goal": stops[-1], "detours": detours}
    try:
        world = {"unseen": unseen, "bounds": [0, 0, 200, 200]}
        mission = Mission.model_validate({"world": world, "robot": robot, "route": route})
    except MissionError:
        return  # something stands on a via point
    run, stays = simulate(mission), robot.get("turn_on_spot") == "never"
    for replan in run.replans:
        assert replan.position_jump < 1e-6
        if replan.mode != "from_rest" or stays:
            assert replan.heading_jump < 1e-6
            assert replan.curvature_jump < 1e-6
    if stays:
        assert max(run.path.curvature_jumps(), default=0.0) < 1e-6
        joints = np.arange(1.0, run.path.domain[1])
        turns = run.path.heading(joints + 1e-7) - run.path.heading(joints - 1e-7)
        assert np.abs(np.angle(np.exp(1j * turns))).max(initial=0.0) < 1e-4


@given(unseen_discs)
@settings(deadline=None, max_examples=8)
def test_the_same_mission_gives_the_same_bytes(
    mission_of: Make, disc_at: Shape, discs: list[tuple[float, float, float]]
) -> None:
    mission = mission_of([0, 0], [30, 6], [90, 0], unseen=[disc_at(*d) for d in discs])
    again = Mission.model_validate(mission.model_dump())
    assert as_bytes(simulate(mission)) == as_bytes(simulate(again))


@given(unseen_discs, st.integers(0, 2**32 - 1))
@settings(deadline=None, max_examples=10)
def test_among_known_obstacles_the_driven_path_is_certified(
    mission_of: Make, disc_at: Shape, discs: list[tuple[float, float, float]], seed: int
) -> None:
    rng = np.random.default_rng(seed)
    known = [disc_at(*rng.uniform((10, -15, 0.5), (80, 15, 2.5)).tolist()) for _ in range(8)]
    try:
        run = simulate(
            mission_of([0, 0], [90, 0], known=known, unseen=[disc_at(*d) for d in discs])
        )
    except PlanningError:
        assume(False)
    again = certify(run.path, run.world, 0.5, radius=0.5)
    assert dataclasses.asdict(again) == dataclasses.asdict(run.certificate)
    assert run.certificate.clearance >= 0.5 - 1e-5
