"""Driving with a lidar through what is on no map."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigation.decision import Decision
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.replanning import replan_from_scan
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate

Make = Callable[..., Mission]
Shape = Callable[..., dict[str, Any]]
Drive = Callable[..., tuple[Navigator, list[Navigator]]]
ShapeOf = Callable[[Obstacle], shapely.Geometry]
LIDAR = {"range_m": 6.0, "fov_deg": 270.0, "beams": 541}
ROBOT = {"radius_m": 0.3, "clearance_m": 0.1, "sensor": {"lidar": LIDAR}}
STEP = 0.05


def u_shape(depth: float, half: float) -> dict[str, Any]:
    """A dead end round (10, 0) that opens towards the start."""
    a, b, h, k = 10 - depth, 10.3, half, half + 0.3
    ring = [[a, -k], [b, -k], [b, k], [a, k], [a, h], [10, h], [10, -h], [a, -h]]
    return {"name": "dead end", "polygon": ring}


def test_a_post_that_is_on_no_map_is_seen_and_passed(mission_of: Make, disc_at: Shape) -> None:
    run = simulate(mission_of([0, 0], [20, 0], unseen=[disc_at(10, 0.1, 1)], **ROBOT))
    assert run.reached, run.reason
    assert run.certificate.holds
    assert 1 <= len(run.replans) <= 8
    kinds = [event.kind for event in run.events]
    assert kinds[:3] == ["started", "detected", "replanned"]
    assert run.known is not None
    seen = np.array([o.circle.center for o in run.known.obstacles if o.circle])
    assert len(seen) > 20
    assert np.abs(np.hypot(*(seen - (10, 0.1)).T) - 1.0).max() < 1e-9
    for replan in run.replans:
        assert replan.position_jump < 1e-6
        if replan.mode != "from_rest":
            assert replan.heading_jump < 1e-6
            assert replan.curvature_jump < 1e-6


def test_a_dead_end_defeats_the_reflex_and_is_left_by_turning_back(mission_of: Make) -> None:
    short = {**ROBOT, "sensor": {"lidar": {**LIDAR, "range_m": 3.0}}}
    run = simulate(mission_of([0, 0], [20, 0.3], unseen=[u_shape(6.0, 2.0)], **short))
    assert run.reached, run.reason
    assert run.certificate.holds
    assert run.positions[:, 0].max() > 15
    inside = (run.positions[:, 0] > 5.5) & (np.abs(run.positions[:, 1]) < 1.5)
    assert inside.any()  # it went in,
    modes = [replan.mode for replan in run.replans]
    back = modes.index("from_rest")  # stopped, and turned round where it stood
    turned = run.replans[back]
    stands = np.flatnonzero(np.hypot(*(run.positions - turned.at).T) < 1e-3)
    assert run.speeds[stands].min() <= 0.5 * STEP  # at 1 m/s², half a step beside the rest


def test_a_door_that_closes_under_way_is_braked_for_and_another_way_is_found(
    drive: Drive, shape_of: ShapeOf, mission_of: Make, box_at: Shape
) -> None:
    walls = [box_at(10, -8, 10.3, -0.6, "south"), box_at(10, 0.6, 10.3, 8, "north")]
    mission = mission_of([0, 0], [20, 0], unseen=[*walls, box_at(10, -0.6, 10.3, 0.6, "door")],
                         **ROBOT)  # fmt: skip
    south, north, door = mission.world.unseen
    nav, states = drive(
        mission, lambda time: (south, north) if time < 3.0 else (south, north, door)
    )
    assert nav.reached, nav.reason
    points = np.array([state.reference(k * STEP).position for k, state in enumerate(states)])
    gap = min(shape_of(o).distance(shapely.LineString(points)) for o in mission.world.unseen)
    assert gap > 0.3
    assert np.abs(points[:, 1]).max() > 8


def test_a_robot_that_is_shut_in_waits_and_gives_up(mission_of: Make, box_at: Shape) -> None:
    ring = [
        box_at(-3, -3, 3, -2.5, "south"), box_at(-3, 2.5, 3, 3, "north"),
        box_at(-3, -2.5, -2.5, 2.5, "west"), box_at(2.5, -2.5, 3, 2.5, "east"),
    ]  # fmt: skip
    run = simulate(mission_of([0, 0], [20, 0], unseen=ring, **ROBOT))
    assert not run.reached
    assert run.reason
    assert run.events[-1].kind == "stopped"
    assert run.certificate.clearance > 0.0
    assert run.duration < 60


@given(st.floats(2.3, 4.0), st.sampled_from([0.0, 0.02]))
@example(2.5, 0.0)  # it went on to 3 cm from where it had to stop, and had used up its room
@settings(deadline=None, max_examples=2)
def test_one_that_is_shut_in_stands_where_it_has_room_to_turn_away(
    mission_of: Make, box_at: Shape, half: float, noise: float
) -> None:
    out = half + 0.5
    ring = [
        box_at(-out, -out, out, -half, "south"), box_at(-out, half, out, out, "north"),
        box_at(-out, -half, -half, half, "west"), box_at(half, -half, out, half, "east"),
    ]  # fmt: skip
    robot = {**ROBOT, "sensor": {"lidar": {**LIDAR, "noise_m": noise}}}
    run = simulate(mission_of([0, 0], [20, 0], unseen=ring, **robot))
    assert not run.reached
    assert half - np.abs(run.positions).max() > 2.0 * (0.3 + 0.1)


def test_a_door_that_opens_while_it_waits_lets_it_go_on(
    drive: Drive, mission_of: Make, box_at: Shape
) -> None:
    ring = [
        box_at(-3, -3, 3, -2.5, "south"), box_at(-3, 2.5, 3, 3, "north"),
        box_at(-3, -2.5, -2.5, 2.5, "west"), box_at(2.5, -2.5, 3, 2.5, "east"),
    ]  # fmt: skip
    all_round = {**ROBOT, "sensor": {"lidar": {**LIDAR, "fov_deg": 360.0}}}
    mission = mission_of([0, 0], [20, 0], unseen=ring, **all_round)
    *shut, door = mission.world.unseen
    nav, _ = drive(mission, lambda time: (*shut, door) if time < 2.0 else shut)
    assert nav.reached, nav.reason


def test_a_point_without_clearance_keeps_what_the_finest_points_measure(
    mission_of: Make, disc_at: Shape
) -> None:
    run = simulate(
        mission_of([0, 0], [12, 0], unseen=[disc_at(6, 0, 1)],
                   **{**ROBOT, "radius_m": 0.0, "clearance_m": 0.0})
    )  # fmt: skip
    assert run.reached, run.reason
    assert run.certificate.clearance > 0.0


def test_what_it_is_told_stands_beside_what_it_sees(
    shape_of: ShapeOf, mission_of: Make, disc_at: Shape
) -> None:
    mission = mission_of([0, 0], [20, 0], unseen=[disc_at(8, 0.2, 0.8)], **ROBOT)
    told = Obstacle.model_validate(disc_at(14, -0.1, 1.0, "told"))
    assert mission.robot.sensor is not None
    assert mission.robot.sensor.lidar is not None
    sensor = LidarSensor(mission.world.unseen, mission.robot.sensor.lidar)
    nav = Navigator(mission)
    for tick in range(1000):
        state, time = nav.reference(tick * STEP), tick * STEP
        _, nav = nav.step(state, sensor.scan(state.position, state.heading), time)
        if tick == 40:
            _, nav = nav.step(state, [told], time)
        if nav.finished:
            break
    assert nav.reached, nav.reason
    assert told in nav.world.obstacles
    assert len(nav.world) > 10
    points = np.asarray(nav.path.at_distance(np.linspace(0, nav.path.length, 3000)))
    for obstacle in (told, *mission.world.unseen):
        assert shape_of(obstacle).distance(shapely.LineString(points)) > 0.39


obstacles = st.lists(
    st.tuples(st.floats(2, 16), st.floats(-3, 3), st.floats(0.1, 1.0), st.booleans()),
    min_size=1, max_size=8,
)  # fmt: skip


@pytest.mark.parametrize("work", [0.0, 0.2])
def test_a_robot_that_stands_sets_off_no_sooner_than_its_search_is_over(
    work: float, mission_of: Make, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its command comes that much later: a trajectory that began before would leave it behind."""

    def searched(context: ReplanContext, *, opened: bool) -> Decision:
        return Decision(context.schedule, searched=True, work=work)

    monkeypatch.setattr(replan_from_scan, "better_path", searched)
    drive = {"ackermann": {"wheelbase_m": 0.2, "max_steer_deg": 40}, "delay_s": 0.1, "lag_s": 0.1}
    lidar = {"range_m": 4, "fov_deg": 270, "beams": 240}
    nav = Navigator(
        mission_of([0, 0], [8, 0], radius_m=0.2, drive=drive, sensor={"lidar": lidar}, unseen=[])
    )
    seen = nav.mission.robot.sensor
    assert seen is not None
    sensor = LidarSensor((), seen.lidar)
    state = nav.reference(0.0)
    _, nav = nav.step(state, sensor.scan(state.position, state.heading), 0.0)
    assert nav.controller is not None
    begins = nav.controller.ahead + work
    assert nav.trajectory.distance_at(begins) == 0.0
    assert nav.trajectory.distance_at(begins + 0.1) > 0.0


def field(found: list[tuple[float, float, float, bool]], disc: Shape, box: Shape) -> list[Any]:
    return [
        box(x - r, y - 0.3 * r, x + r, y + 0.3 * r, f"box {k}") if square else disc(x, y, r)
        for k, (x, y, r, square) in enumerate(found)
    ]


@pytest.mark.slow
@given(obstacles, st.integers(0, 99))
@settings(deadline=None, max_examples=3)
def test_the_same_mission_and_seed_give_the_same_bytes(
    mission_of: Make, disc_at: Shape, box_at: Shape,
    found: list[tuple[float, float, float, bool]], seed: int,
) -> None:  # fmt: skip
    mission = mission_of(
        [0, 0], [18, 0], unseen=field(found, disc_at, box_at),
        **{**ROBOT, "sensor": {"lidar": {**LIDAR, "noise_m": 0.01}}},
    )  # fmt: skip
    again = Mission.model_validate(mission.model_dump())
    assert as_bytes(simulate(mission, seed=seed)) == as_bytes(simulate(again, seed=seed))


def as_bytes(run: Run) -> bytes:
    arrays = (run.times, run.positions, run.speeds, run.path.spans)
    known = () if run.known is None else run.known.obstacles
    plain = (run.reached, run.reason, run.visits, run.events, run.certificate, known)
    return b"".join(np.ascontiguousarray(a).tobytes() for a in arrays) + repr(plain).encode()
