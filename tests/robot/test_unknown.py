"""Driving with a lidar through what is on no map."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from viaspline.errors import GeometryError
from viaspline.mission.model import Mission
from viaspline.mission.sensor_spec import Lidar
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate

Make = Callable[..., Mission]
Shape = Callable[..., dict[str, Any]]
LIDAR = {"range_m": 6.0, "fov_deg": 270.0, "beams": 541}
ROBOT = {"radius_m": 0.3, "clearance_m": 0.1, "sensor": {"lidar": LIDAR}}
STEP = 0.05


def u_shape(depth: float, half: float) -> dict[str, Any]:
    """A dead end round (10, 0) that opens towards the start."""
    a, b, h, k = 10 - depth, 10.3, half, half + 0.3
    ring = [[a, -k], [b, -k], [b, k], [a, k], [a, h], [10, h], [10, -h], [a, -h]]
    return {"name": "dead end", "polygon": ring}


def shape_of(obstacle: Obstacle) -> shapely.Geometry:
    if obstacle.circle is not None:
        return shapely.Point(obstacle.circle.center).buffer(obstacle.circle.radius, quad_segs=64)
    return shapely.Polygon(obstacle.polygon, obstacle.holes)


def drive(
    mission: Mission, there: Callable[[float], Sequence[Obstacle]], until: float = 120.0
) -> tuple[Navigator, list[Navigator]]:
    """Follow exactly among obstacles that may come and go."""
    assert mission.robot.sensor is not None
    assert mission.robot.sensor.lidar is not None
    nav, states = Navigator(mission), []
    for tick in range(round(until / STEP)):
        time = tick * STEP
        state = nav.reference(time)
        sensor = LidarSensor(there(time), mission.robot.sensor.lidar)
        _, nav = nav.step(state, sensor.scan(state.position, state.heading, tick), time)
        states.append(nav)
        if nav.finished:
            break
    return nav, states


def sides_at(nav: Navigator, x: float) -> list[int]:
    """On which side each new path crosses a line of constant x."""
    found = []
    for replan in nav.replans:
        points = np.asarray(replan.path.at_distance(np.linspace(0, replan.path.length, 2000)))
        found.append(int(np.sign(points[np.abs(points[:, 0] - x).argmin(), 1])))
    return found


def changes(values: Sequence[int]) -> int:
    return sum(a != b for a, b in itertools.pairwise(values))


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
    assert run.speeds[stands].min() == pytest.approx(0.0, abs=1e-6)


def test_a_wall_straight_ahead_is_passed_on_one_side(mission_of: Make, box_at: Shape) -> None:
    wall = box_at(12, -7, 12.4, 7.02, "wall")
    mission = mission_of([0, 0], [24, 0], unseen=[wall], **ROBOT)
    nav, _ = drive(mission, lambda _: mission.world.unseen)
    assert nav.reached, nav.reason
    assert changes(sides_at(nav, 12.2)) <= 1


@pytest.mark.parametrize("period", [1, 3])
def test_a_sensor_that_flickers_makes_no_oscillation(
    mission_of: Make, disc_at: Shape, period: int
) -> None:
    mission = mission_of([0, 0], [20, 0], unseen=[disc_at(10, 0.0, 1)], **ROBOT)
    post = mission.world.unseen
    nav, _ = drive(mission, lambda time: post if round(time / STEP) // period % 2 else ())
    assert nav.reached, nav.reason
    assert len(nav.replans) <= 8
    assert changes(sides_at(nav, 10.0)) == 0


def test_a_thing_that_is_told_again_and_again_a_little_elsewhere_makes_no_oscillation(
    mission_of: Make, disc_at: Shape
) -> None:
    mission = mission_of([0, 0], [60, 0], sensor={"range_m": 25.0})
    nav, rng = Navigator(mission), np.random.default_rng(0)
    for tick in range(2000):
        state = nav.reference(tick * 0.1)
        near = abs(state.position[0] - 30.0) < 20.0
        place = (30.0 + rng.normal(0, 0.05), rng.normal(0, 0.05), 2.0)
        told = [Obstacle.model_validate(disc_at(*place))] if near and tick % 2 else []
        _, nav = nav.step(state, told, tick * 0.1)
        if nav.finished:
            break
    assert nav.reached, nav.reason
    assert changes(sides_at(nav, 30.0)) == 0


def test_a_door_that_closes_under_way_is_braked_for_and_another_way_is_found(
    mission_of: Make, box_at: Shape
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


def test_a_door_that_opens_is_used_when_that_is_clearly_better(
    mission_of: Make, box_at: Shape
) -> None:
    wall = box_at(10, -20, 10.3, 20, "wall")
    mission = mission_of([0, 0], [20, 0], unseen=[wall], **ROBOT)
    nav, _ = drive(mission, lambda time: mission.world.unseen if time < 6.0 else ())
    assert nav.reached, nav.reason
    assert nav.path.length < 30


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


def test_a_door_that_opens_while_it_waits_lets_it_go_on(mission_of: Make, box_at: Shape) -> None:
    ring = [
        box_at(-3, -3, 3, -2.5, "south"), box_at(-3, 2.5, 3, 3, "north"),
        box_at(-3, -2.5, -2.5, 2.5, "west"), box_at(2.5, -2.5, 3, 2.5, "east"),
    ]  # fmt: skip
    all_round = {**ROBOT, "sensor": {"lidar": {**LIDAR, "fov_deg": 360.0}}}
    mission = mission_of([0, 0], [20, 0], unseen=ring, **all_round)
    *shut, door = mission.world.unseen
    nav, _ = drive(mission, lambda time: (*shut, door) if time < 2.0 else shut)
    assert nav.reached, nav.reason


@pytest.mark.parametrize("view", [(90.0, 181), (360.0, 60)])
def test_a_narrow_or_a_coarse_lidar_takes_longer_but_gets_there(
    mission_of: Make, disc_at: Shape, view: tuple[float, int]
) -> None:
    lidar = {**LIDAR, "fov_deg": view[0], "beams": view[1]}
    mission = mission_of(
        [0, 0], [12, 0], unseen=[disc_at(5, 0.2, 0.8), disc_at(8, -0.6, 0.5)],
        **{**ROBOT, "sensor": {"lidar": lidar}},
    )  # fmt: skip
    run = simulate(mission)
    assert run.reached, run.reason
    assert run.certificate.clearance > 0.0


def test_a_point_without_clearance_keeps_what_the_finest_points_measure(
    mission_of: Make, disc_at: Shape
) -> None:
    run = simulate(
        mission_of([0, 0], [12, 0], unseen=[disc_at(6, 0, 1)],
                   **{**ROBOT, "radius_m": 0.0, "clearance_m": 0.0})
    )  # fmt: skip
    assert run.reached, run.reason
    assert run.certificate.clearance > 0.0


def test_without_a_scan_it_stays_where_it_is(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], [12, 0], **ROBOT))
    for time in (0.0, 1.0, 2.0):
        command, nav = nav.step(nav.reference(time), [], time)
    assert nav.distance == 0.0
    assert command.stopped
    assert not nav.finished


def test_what_it_is_told_stands_beside_what_it_sees(mission_of: Make, disc_at: Shape) -> None:
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


def test_a_scan_for_a_robot_without_a_lidar_is_refused(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], [20, 0]))
    scan = LidarSensor([], Lidar(range_m=5)).scan((0.0, 0.0), 0.0)
    with pytest.raises(GeometryError, match="has no lidar"):
        nav.step(nav.reference(0.0), scan, 0.0)


obstacles = st.lists(
    st.tuples(st.floats(2, 16), st.floats(-3, 3), st.floats(0.1, 1.0), st.booleans()),
    min_size=1, max_size=8,
)  # fmt: skip


def field(found: list[tuple[float, float, float, bool]], disc: Shape, box: Shape) -> list[Any]:
    return [
        box(x - r, y - 0.3 * r, x + r, y + 0.3 * r, f"box {k}") if square else disc(x, y, r)
        for k, (x, y, r, square) in enumerate(found)
    ]


def free_ends(unseen: Sequence[Obstacle], ends: Sequence[tuple[float, float]]) -> bool:
    return all(shape_of(o).distance(shapely.Point(end)) > 0.5 for o in unseen for end in ends)


@given(obstacles, st.sampled_from([None, 0.8]), st.sampled_from([0.0, 0.01]), st.integers(0, 99))
@settings(deadline=None, max_examples=12)
def test_it_never_touches_what_its_lidar_could_have_shown(
    mission_of: Make, disc_at: Shape, box_at: Shape,
    found: list[tuple[float, float, float, bool]], lateral: float | None, noise: float, seed: int,
) -> None:  # fmt: skip
    mission = mission_of(
        [0, 0], [18, 0], unseen=field(found, disc_at, box_at), max_lateral_accel_mps2=lateral,
        **{**ROBOT, "sensor": {"lidar": {**LIDAR, "noise_m": noise}}},
    )  # fmt: skip
    assume(free_ends(mission.world.unseen, [(0, 0), (18, 0)]))
    run = simulate(mission, seed=seed)
    assert run.certificate.clearance > 0.0, run.reason
    assert "contact" not in [event.kind for event in run.events]
    assert run.reached == (run.reason is None)
    assert np.all(run.speeds <= 2.0 + 1e-9)
    acceleration = np.abs(np.diff(run.speeds)) / np.diff(run.times)
    assert np.all(acceleration[np.diff(run.times) > 1e-6] <= 1.0 + 1e-6)
    for replan in run.replans:
        assert replan.position_jump < 1e-6
        if replan.mode != "from_rest":
            assert replan.heading_jump < 1e-6
            assert replan.curvature_jump < 1e-6


@given(obstacles)
@settings(deadline=None, max_examples=5)
def test_it_is_never_faster_than_lets_it_stop_inside_of_what_it_has_seen(
    mission_of: Make, disc_at: Shape, box_at: Shape, found: list[tuple[float, float, float, bool]]
) -> None:
    mission = mission_of([0, 0], [18, 0], unseen=field(found, disc_at, box_at), **ROBOT)
    assume(free_ends(mission.world.unseen, [(0, 0), (18, 0)]))
    shapes = shapely.union_all([shape_of(o) for o in mission.world.unseen])
    shapely.prepare(shapes)
    _, states = drive(mission, lambda _: mission.world.unseen, until=25.0)
    poses: list[tuple[float, float, float]] = []
    angles = np.linspace(-math.pi, math.pi, 24, endpoint=False)
    rim = 0.29 * np.column_stack((np.cos(angles), np.sin(angles)))
    for tick, nav in enumerate(states):
        state = nav.reference(tick * STEP)
        poses.insert(0, (*state.position, state.heading))
        stop = nav.distance + state.speed**2 / 2.0
        body = np.asarray(nav.path.at_distance(min(stop, nav.path.length))) + rim
        unseen = body[np.hypot(*(body - state.position).T) > 0.3]
        for x, y, heading in poses:
            if not len(unseen):
                break
            away = unseen - (x, y)
            bearing = np.arctan2(away[:, 1], away[:, 0]) - heading
            within = np.abs((bearing + math.pi) % math.tau - math.pi) <= math.radians(135)
            lines = shapely.linestrings([[(x, y), point] for point in unseen.tolist()])
            hidden = shapely.intersects(shapes, lines) | ~within
            unseen = unseen[hidden | (np.hypot(*away.T) > 6.0)]
        ways = [np.hypot(*(unseen - place[:2]).T) for place in poses]
        driven = np.min(ways, axis=0) if len(unseen) else np.zeros(0)
        assert np.all(driven <= 0.3 + 1e-6), (tick, unseen)


@given(obstacles, st.integers(0, 99))
@settings(deadline=None, max_examples=4)
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
