"""A robot with a lidar stops inside of what it has seen."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigation.law_past import spans_until
from viaspline.robot.navigator import Navigator
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime

Make = Callable[..., Mission]
Shape = Callable[..., dict[str, Any]]
Drive = Callable[..., tuple[Navigator, list[Navigator]]]
ShapeOf = Callable[[Obstacle], shapely.Geometry]
LIDAR = {"range_m": 6.0, "fov_deg": 270.0, "beams": 541}
ROBOT = {"radius_m": 0.3, "clearance_m": 0.1, "sensor": {"lidar": LIDAR}}
STEP = 0.05


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


@pytest.mark.parametrize("limit", [{}, {"max_yaw_accel_degps2": 180}, {"max_jerk_mps3": 2}])
def test_a_small_robot_that_sees_too_little_takes_its_smallest_step(
    mission_of: Make, limit: dict[str, float]
) -> None:
    sensor = {"lidar": {"range_m": 2.5, "fov_deg": 120.0, "beams": 361}}
    robot = {"radius_m": 0.0, "clearance_m": 0.0, "tracking_error_m": 0.02, "sensor": sensor}
    run = simulate(mission_of([0, 0], [1, 0], **{**robot, **limit}))
    assert run.reached, run.reason


def least_gap(run: Run, walls: shapely.Polygon) -> float:
    """From the body as it was driven to what there is, by shapely [m]."""
    x, y = np.array(run.plan.mission.robot.footprint).T
    c, s = np.cos(run.headings)[:, None], np.sin(run.headings)[:, None]
    places = np.asarray(run.positions)
    corners = (places[:, :1] + c * x - s * y, places[:, 1:2] + s * x + c * y)
    return float(shapely.distance(shapely.polygons(np.stack(corners, axis=-1)), walls).min())


def long_car(front: float, speed: float, sees: float) -> dict[str, Any]:
    """A steered robot that reaches far ahead of its rear axle, and doesn't drive backwards."""
    return {
        "footprint": [[-0.3, -0.35], [front, -0.35], [front, 0.35], [-0.3, 0.35]],
        "clearance_m": 0.15, "max_speed_mps": speed,
        "drive": {"ackermann": {"wheelbase_m": 1, "max_steer_deg": 32}, "delay_s": 0.1,
                  "lag_s": 0.1},
        "sensor": {"lidar": {"range_m": sees, "fov_deg": 270.0}},
    }  # fmt: skip


def before_a_wall(mission_of: Make, far: float, tilt: float, **robot: Any) -> tuple[Run, float]:
    """A drive towards a wall that isn't on the map, and how near the body comes to it [m]."""
    wall = shapely.affinity.rotate(shapely.box(far, -4.0, far + 0.3, 4.0), tilt, (far, 0.0))
    unseen = [{"polygon": [list(at) for at in wall.exterior.coords[:-1]]}]
    run = simulate(mission_of([0, 0], [16, 0], unseen=unseen, **robot))
    return run, least_gap(run, wall)


def test_a_long_car_that_has_no_room_to_turn_stops_before_its_front_is_too_near(
    mission_of: Make,
) -> None:
    run, gap = before_a_wall(mission_of, 4.4, 4.0, **long_car(1.4, 1.8, 3.2))
    assert not run.reached
    assert gap >= 0.15


@pytest.mark.slow
@given(st.floats(4, 6), st.floats(-15, 15), st.floats(0.8, 1.6), st.floats(1, 1.8),
       st.floats(2.6, 3.4))  # fmt: skip
@settings(deadline=None, max_examples=8)
def test_no_long_car_comes_nearer_to_a_wall_than_its_clearance(
    mission_of: Make, far: float, tilt: float, front: float, speed: float, sees: float
) -> None:
    _, gap = before_a_wall(mission_of, far, tilt, **long_car(front, speed, sees + front - 1.0))
    assert gap >= 0.15


def test_without_a_scan_it_stays_where_it_is(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], [12, 0], **ROBOT))
    for time in (0.0, 1.0, 2.0):
        command, nav = nav.step(nav.reference(time), [], time)
    assert nav.distance == 0.0
    assert command.stopped
    assert not nav.finished


obstacles = st.lists(
    st.tuples(st.floats(2, 16), st.floats(-3, 3), st.floats(0.1, 1.0), st.booleans()),
    min_size=1, max_size=8,
)  # fmt: skip


def field(found: list[tuple[float, float, float, bool]], disc: Shape, box: Shape) -> list[Any]:
    return [
        box(x - r, y - 0.3 * r, x + r, y + 0.3 * r, f"box {k}") if square else disc(x, y, r)
        for k, (x, y, r, square) in enumerate(found)
    ]


def free_ends(
    shape_of: ShapeOf, unseen: Sequence[Obstacle], ends: Sequence[tuple[float, float]]
) -> bool:
    return all(shape_of(o).distance(shapely.Point(end)) > 0.5 for o in unseen for end in ends)


@pytest.mark.slow
@given(obstacles, st.sampled_from([None, 0.8]), st.sampled_from([0.0, 0.01]), st.integers(0, 99))
@settings(deadline=None, max_examples=6)
def test_it_never_touches_what_its_lidar_could_have_shown(
    shape_of: ShapeOf, mission_of: Make, disc_at: Shape, box_at: Shape,
    found: list[tuple[float, float, float, bool]], lateral: float | None, noise: float, seed: int,
) -> None:  # fmt: skip
    mission = mission_of(
        [0, 0], [18, 0], unseen=field(found, disc_at, box_at), max_lateral_accel_mps2=lateral,
        **{**ROBOT, "sensor": {"lidar": {**LIDAR, "noise_m": noise}}},
    )  # fmt: skip
    assume(free_ends(shape_of, mission.world.unseen, [(0, 0), (18, 0)]))
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


@pytest.mark.slow
@given(obstacles)
@settings(deadline=None, max_examples=3)
def test_it_is_never_faster_than_lets_it_stop_inside_of_what_it_has_seen(
    drive: Drive,
    shape_of: ShapeOf,
    mission_of: Make,
    disc_at: Shape,
    box_at: Shape,
    found: list[tuple[float, float, float, bool]],
) -> None:
    mission = mission_of([0, 0], [18, 0], unseen=field(found, disc_at, box_at), **ROBOT)
    assume(free_ends(shape_of, mission.world.unseen, [(0, 0), (18, 0)]))
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


@given(st.integers(0, 2**32 - 1))
@settings(deadline=None, max_examples=60)
def test_a_law_to_a_place_is_the_same_on_the_spans_up_to_there_as_on_all_of_the_path(
    seed: int,
) -> None:
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(0, 5, (int(rng.integers(4, 30)), 2)), axis=0)
    path = Path(CardinalSpline(points, knots="centripetal").spans, vias=[])
    start, end = np.sort(rng.uniform(0.0, path.length, 2)).tolist()
    limits = Limits(max_speed=1.5, max_accel=1.0, max_lateral_accel=0.8)
    stops = [Station(0.5 * (start + end), 1.0), Station(end)]
    part, kept = spans_until(path, stops, end)
    law = retime(path, limits, stops, start=start).until(end)
    same = retime(part, limits, kept, start=start).until(end)
    assert law.times.tobytes() == same.times.tobytes()
    assert law.distances.tobytes() == same.distances.tobytes()
    assert law.speeds.tobytes() == same.speeds.tobytes()


def test_a_law_within_sight_asks_for_no_more_spans_than_lead_there() -> None:
    path = Path(np.array([line(10.0 * k) for k in range(100)]), vias=[])
    counts = [len(spans_until(path, [], end)[0].spans) for end in (5.0, 10.0, 25.0, 999.0)]
    assert counts == [1, 2, 3, 100]


def line(start: float) -> list[list[float]]:
    """A straight span of 10 m."""
    return [[start + 10.0 * k / 3.0, 0.0] for k in range(4)]
