"""The lidar measures what rays through shapely's geometries meet."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from viaspline.errors import GeometryError
from viaspline.maps.grid import Grid
from viaspline.mission.sensor_spec import Lidar
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import LidarSensor, Scan
from viaspline.world.moving_obstacles import MovingObstacles

RING = ((-6.0, -6.0), (6.0, -6.0), (6.0, 5.0), (0.0, 7.0), (-6.0, 6.0))
HOLE = ((-5.0, -5.0), (5.0, -5.0), (5.0, 4.0), (0.0, 2.0), (-5.0, 4.0))
YARD = Obstacle(polygon=RING, holes=(HOLE,), name="yard")

places = st.floats(-4.5, 1.5)
angles = st.floats(-10.0, 10.0)
discs = st.lists(st.tuples(st.floats(-9, 9), st.floats(-9, 9), st.floats(0.05, 2)), max_size=6)


def surface(obstacle: Obstacle) -> shapely.Geometry:
    if obstacle.polygon is not None:
        return shapely.Polygon(obstacle.polygon, obstacle.holes).boundary
    assert obstacle.grid is not None
    rows, columns = np.nonzero(obstacle.grid.blocked)
    cells = [
        shapely.Polygon(obstacle.grid.to_world([(c, r), (c + 1, r), (c + 1, r + 1), (c, r + 1)]))
        for r, c in zip(rows.tolist(), columns.tolist(), strict=True)
    ]
    return shapely.union_all(cells)


def first_hit(scan: Scan, beam: int, shape: shapely.Geometry, reach: float) -> float:
    """Distance to the first place where a beam meets a shape."""
    angle = scan.first_direction + beam * scan.angle_increment
    x, y = scan.position
    far = (x + reach * math.cos(angle), y + reach * math.sin(angle))
    met = shapely.LineString([scan.position, far]).intersection(shape)
    return math.inf if met.is_empty else float(met.distance(shapely.Point(scan.position)))


def first_on_disc(scan: Scan, beam: int, disc: tuple[float, float, float], reach: float) -> float:
    """The same for a circle, whose polygon would not be exact."""
    angle = scan.first_direction + beam * scan.angle_increment
    ray = np.array([math.cos(angle), math.sin(angle)])
    to = np.array(disc[:2]) - scan.position
    squared = disc[2] ** 2 - (to @ to - (to @ ray) ** 2)
    if squared < 0:
        return math.inf
    roots = sorted((to @ ray - math.sqrt(squared), to @ ray + math.sqrt(squared)))
    return next((float(root) for root in roots if 0 <= root < reach), math.inf)


@given(discs, places, places, angles, st.sampled_from([(360.0, 37), (270.0, 40), (11.0, 5)]))
def test_beams_end_at_the_first_disc_on_their_way(
    found: list[tuple[float, float, float]], x: float, y: float, heading: float,
    view: tuple[float, int],
) -> None:  # fmt: skip
    assume(all(abs(math.hypot(a - x, b - y) - r) > 1e-6 for a, b, r in found))
    obstacles = [Obstacle(circle=Circle(center=(a, b), radius=r)) for a, b, r in found]
    sensor = LidarSensor(obstacles, Lidar(range_m=7, fov_deg=view[0], beams=view[1]))
    scan = sensor.scan((x, y), heading)
    for beam, measured in enumerate(scan.ranges.tolist()):
        smaller, larger = (
            min((first_on_disc(scan, beam, (a, b, r + slip), 7.0) for a, b, r in found),
                default=math.inf)
            for slip in (-1e-7, 1e-7)
        )  # fmt: skip
        if smaller == larger or smaller - larger < 1e-3:  # a beam that grazes may go either way
            assert larger - 1e-6 <= measured <= smaller + 1e-6


@given(places, places, angles)
def test_beams_end_at_the_walls_of_a_yard(x: float, y: float, heading: float) -> None:
    assume(shapely.Polygon(HOLE).buffer(-0.01).contains(shapely.Point(x, y)))
    scan = LidarSensor([YARD], Lidar(range_m=20, beams=24)).scan((x, y), heading)
    for beam, measured in enumerate(scan.ranges.tolist()):
        assert measured == pytest.approx(first_hit(scan, beam, surface(YARD), 20.0), abs=1e-8)


@given(places, places, angles, st.floats(-3, 3), st.integers(0, 2**32 - 1))
def test_beams_end_at_the_first_blocked_cell_of_a_grid(
    x: float, y: float, heading: float, yaw: float, seed: int
) -> None:
    cells = np.random.default_rng(seed).random((7, 9)) < 0.3
    grid = Obstacle(grid=Grid(cells, resolution=0.8, origin=(-1.0, -2.0, yaw)))
    blocked = surface(grid)
    assume(blocked.distance(shapely.Point(x, y)) > 1e-6)
    scan = LidarSensor([grid], Lidar(range_m=8, beams=24)).scan((x, y), heading)
    for beam, measured in enumerate(scan.ranges.tolist()):
        inner = first_hit(scan, beam, blocked.buffer(-1e-7), 8.0)
        outer = first_hit(scan, beam, blocked.buffer(1e-7), 8.0)
        if inner - outer < 1e-3 or inner == outer:  # a beam along an edge may go either way
            assert outer - 1e-6 <= measured <= inner + 1e-6


def test_what_stands_before_hides_what_is_behind() -> None:
    near = Obstacle(circle=Circle(center=(3, 0), radius=1))
    far = Obstacle(polygon=((6, -1), (7, -1), (7, 1), (6, 1)))
    alone = LidarSensor([far], Lidar(range_m=9, fov_deg=20, beams=101)).scan((0.0, 0.0), 0.0)
    both = LidarSensor([far, near], Lidar(range_m=9, fov_deg=20, beams=101)).scan((0.0, 0.0), 0.0)
    assert alone.ranges[50] == pytest.approx(6.0)
    assert both.ranges[50] == pytest.approx(2.0)
    assert both.hits[:, 0].max() < 3.0


def test_a_field_of_view_leaves_out_what_is_behind() -> None:
    behind = Obstacle(circle=Circle(center=(-3, 0), radius=1))
    spec = Lidar(range_m=9, fov_deg=270, beams=271)
    assert not len(LidarSensor([behind], spec).scan((0.0, 0.0), 0.0).hits)
    turned = LidarSensor([behind], spec).scan((0.0, 0.0), math.pi)
    assert turned.ranges[135] == pytest.approx(2.0)
    assert turned.angle_min == pytest.approx(math.radians(-135))
    assert turned.angle_min + 270 * turned.angle_increment == pytest.approx(math.radians(135))


def test_one_beam_looks_ahead() -> None:
    post = Obstacle(circle=Circle(center=(0, 3), radius=1))
    scan = LidarSensor([post], Lidar(range_m=9, fov_deg=90, beams=1)).scan((0.0, 0.0), math.pi / 2)
    assert scan.ranges == pytest.approx([2.0])


def test_noise_is_that_of_the_seed_and_the_number_and_has_its_spread() -> None:
    wall = Obstacle(polygon=((-90, 4), (90, 4), (90, 5), (-90, 5)))
    spec = Lidar(range_m=9, fov_deg=60, beams=5000, noise_m=0.02)
    true = LidarSensor([wall], spec.model_copy(update={"noise_m": 0.0})).scan((0, 0), math.pi / 2)
    scans = [LidarSensor([wall], spec, seed).scan((0, 0), math.pi / 2, k)
             for seed, k in ((1, 1), (1, 1), (2, 1), (1, 2))]  # fmt: skip
    assert np.array_equal(scans[0].ranges, scans[1].ranges)
    assert not np.array_equal(scans[0].ranges, scans[2].ranges)
    assert not np.array_equal(scans[0].ranges, scans[3].ranges)
    error = scans[0].ranges - true.ranges
    assert np.std(error) == pytest.approx(0.02, rel=0.05)
    assert np.abs(error).max() <= 0.06 + 1e-12


def test_a_scan_says_where_its_beams_hit_and_how_far_they_are_free() -> None:
    ranges = [1.0, math.inf, math.nan, -1.0, 12.0]
    scan = Scan((1.0, 1.0), math.pi / 2, 0.0, 0.1, 10.0, np.array(ranges))
    assert scan.hits == pytest.approx(np.array([[1.0, 2.0]]))
    assert scan.free == pytest.approx([1.0, 10.0, 0.0, 0.0, 10.0])
    with pytest.raises(ValueError, match="read-only"):
        scan.ranges[0] = 3.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"ranges": []}, "give one for each beam"),
        ({"ranges": [[1.0]]}, "give one for each beam"),
        ({"heading": math.nan}, "finite position"),
        ({"position": (1.0,)}, "finite position"),
        ({"range_max": -9.0}, "length above 0 m"),
        ({"angle_increment": 0.0}, "angle above 0"),
        ({"angle_increment": 4.0}, "full turn at most"),
    ],
)
def test_a_scan_that_makes_no_sense_is_refused(change: dict[str, object], message: str) -> None:
    sound: dict[str, object] = {
        "position": (0.0, 0.0), "heading": 0.0, "angle_min": 0.0, "angle_increment": 0.1,
        "range_max": 9.0, "ranges": [1.0, 2.0, 3.0],
    }  # fmt: skip
    with pytest.raises(GeometryError, match=message):
        Scan(**{**sound, **change})  # type: ignore[arg-type]


def test_what_moves_is_hit_where_it_is_at_that_instant() -> None:
    """With the noise of the same seed and number, as if it stood there."""
    wall = Obstacle(polygon=((-1.0, 3.0), (4.0, 3.0), (4.0, 4.0), (-1.0, 4.0)))
    motion = {"from": (-1.0, 2.0), "velocity_mps": (0.5, 0.0)}
    ball = Obstacle.model_validate({"circle": {"center": (0, 0), "radius": 0.4}, "motion": motion})
    spec = Lidar(range_m=9.0, fov_deg=200, beams=91, noise_m=0.02)
    sensor = LidarSensor([wall], spec, seed=4, moving=MovingObstacles([ball]))
    for time in (0.0, 1.0, 3.0):
        there = Obstacle(circle=Circle(center=(-1.0 + 0.5 * time, 2.0), radius=0.4))
        still = LidarSensor([wall, there], spec, seed=4).scan((0.0, 0.0), 1.0, 5)
        assert sensor.scan((0.0, 0.0), 1.0, 5, time).ranges.tolist() == still.ranges.tolist()
