"""What scans have shown: surfaces that are kept or seen through, and places that were looked at."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.sensor_spec import Lidar, Sensor
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.belief import Belief
from viaspline.robot.perception.lidar import LidarSensor, Scan
from viaspline.robot.perception.scan_history import ScanHistory
from viaspline.world.world import World

LIDAR = Lidar(range_m=6.0, fov_deg=270, beams=541)
POST = Obstacle(circle=Circle(center=(3.0, 0.0), radius=0.5))
BOX = Obstacle(polygon=((2.0, -1.0), (3.0, -1.0), (3.0, 1.0), (2.0, 1.0)))


def robot(lidar: Lidar = LIDAR, radius: float = 0.3, clearance: float = 0.0) -> RobotSpec:
    return RobotSpec(radius_m=radius, clearance_m=clearance, sensor=Sensor(lidar=lidar))


def nothing(lidar: Lidar = LIDAR, world: World | None = None) -> Belief:
    return Belief.at_start(world or World(), robot(lidar))


def certain(belief: Belief, path: Path, start: float) -> float:
    """How far a body of 0.3 m can go for certain, as a distance along a path."""
    seen = belief.seen_until(path, start, min(start + belief.lookahead, path.length), 0.3)
    return belief.clear_until(path, start, seen, 0.3)


def line(*points: tuple[float, float]) -> Path:
    """A polyline as a path."""
    corners = np.array(points)
    share = np.arange(4)[:, None] / 3
    return Path([a + share * (b - a) for a, b in itertools.pairwise(corners)], [])


@given(st.lists(st.tuples(st.floats(-5, 5), st.floats(1, 5), st.floats(0.1, 0.8)), max_size=5),
       st.floats(-0.5, 0.5), st.floats(-1, 1))  # fmt: skip
@settings(max_examples=20)
def test_every_hit_lies_in_a_disc_whose_middle_is_a_hit(
    posts: list[tuple[float, float, float]], x: float, heading: float
) -> None:
    obstacles = [Obstacle(circle=Circle(center=(a, b), radius=r)) for a, b, r in posts]
    sensor, belief = LidarSensor(obstacles, LIDAR), nothing()
    hits = []
    for k in range(6):
        scan = sensor.scan((x + 0.05 * k, 0.02 * k), heading + math.pi / 2)
        hits.append(scan.hits)
        belief, _ = belief.with_scan(scan)
    seen = np.concatenate(hits)
    if not len(seen):
        assert not len(belief.world)
        return
    assert belief.world.distance(seen).max() <= 1e-9
    places = belief.surfaces.places
    assert max(np.hypot(*(seen - place).T).min() for place in places) <= 1e-9
    gaps = shapely.distance(shapely.points(places)[:, None], shapely.points(places)[None, :])
    assert gaps[~np.eye(len(places), dtype=bool)].min(initial=9.0) > belief.surfaces.cell_size


def test_a_scan_of_what_was_seen_already_is_no_news() -> None:
    sensor, belief = LidarSensor([POST, BOX], LIDAR), nothing()
    belief, news = belief.with_scan(sensor.scan((0.0, 0.0), 0.0))
    assert len(news.new) == len(belief.surfaces) > 0
    again, news = belief.with_scan(sensor.scan((0.0, 0.0), 0.0))
    assert news.new == ()
    assert news.gone == 0
    assert again.world is belief.world


def test_what_is_on_the_map_is_no_news_and_stays_whatever_the_beams_say() -> None:
    belief = nothing(world=World([POST]))
    belief, news = belief.with_scan(LidarSensor([POST], LIDAR).scan((0.0, 0.0), 0.0))
    assert news.new == ()
    for _ in range(30):
        belief, news = belief.with_scan(LidarSensor([], LIDAR).scan((0.0, 0.0), 0.0))
    assert belief.world.obstacles == (POST,)


def test_a_thing_that_has_gone_is_forgotten_after_some_scans_and_not_at_once() -> None:
    belief = nothing()
    for _ in range(20):
        belief, _ = belief.with_scan(LidarSensor([POST, BOX], LIDAR).scan((0.0, 0.0), 0.0))
    seen = len(belief.surfaces)
    belief, news = belief.with_scan(LidarSensor([BOX], LIDAR).scan((0.0, 0.0), 0.0))
    assert news.gone == 0
    for _ in range(20):
        belief, _ = belief.with_scan(LidarSensor([BOX], LIDAR).scan((0.0, 0.0), 0.0))
    assert 0 < len(belief.surfaces) <= seen
    assert belief.world.distance((3.0, 0.0)) == pytest.approx(1.0, abs=0.1)  # the box's face


def test_what_is_hidden_now_is_remembered() -> None:
    belief = nothing()
    far = Obstacle(circle=Circle(center=(5.0, 0.0), radius=0.4))
    belief, _ = belief.with_scan(LidarSensor([far], LIDAR).scan((0.0, 0.0), 0.0))
    for _ in range(30):
        belief, _ = belief.with_scan(LidarSensor([far, POST], LIDAR).scan((0.0, 0.0), 0.0))
    assert belief.world.distance((4.6, 0.0)) <= 0.0


def test_a_surface_that_is_grazed_is_not_seen_through() -> None:
    belief = nothing()
    wall = Obstacle(polygon=((-1.0, 0.5), (8.0, 0.5), (8.0, 0.6), (-1.0, 0.6)))
    sensor = LidarSensor([wall, POST], LIDAR)
    for k in range(60):
        belief, news = belief.with_scan(sensor.scan((0.03 * k, 0.0), 0.0))
        assert news.gone == 0


def test_with_noise_the_places_come_to_lie_on_the_surface() -> None:
    lidar = LIDAR.model_copy(update={"noise_m": 0.02})
    sensor, belief = LidarSensor([BOX], lidar, seed=3), nothing(lidar)
    errors = []
    for k in range(80):
        belief, _ = belief.with_scan(sensor.scan((0.0, 0.0), 0.0, k))
        errors.append(np.abs(belief.surfaces.places[:, 0] - 2.0))
    assert np.sqrt(np.mean(errors[0] ** 2)) == pytest.approx(0.02, rel=0.3)
    assert np.sqrt(np.mean(errors[-1] ** 2)) < 0.012
    assert np.max(errors[-1]) < 0.05
    assert belief.surfaces.cell_size > 0.02 + nothing().surfaces.cell_size - 1e-12


def test_what_a_disc_has_for_the_noise_shrinks_as_its_hits_average_it_out() -> None:
    lidar = LIDAR.model_copy(update={"noise_m": 0.02})
    sensor, belief = LidarSensor([BOX], lidar, seed=3), nothing(lidar)
    for k in range(80):
        belief, _ = belief.with_scan(sensor.scan((0.0, 0.0), 0.0, k))
    surfaces, bare = belief.surfaces, nothing().surfaces.cell_size
    circles = [obstacle.circle for obstacle in surfaces.obstacles]
    extra = np.array([circle.radius for circle in circles if circle is not None]) - bare
    share = np.array([1, 1 / 2, 1 / 4, 1 / 8])[np.searchsorted((4, 16, 64), surfaces.hits, "right")]
    assert extra == pytest.approx(0.02 * share)
    assert (share == 1 / 8).any()


def test_a_body_can_go_where_beams_have_been_on_all_of_its_front() -> None:
    belief = nothing()
    belief, _ = belief.with_scan(LidarSensor([POST], LIDAR).scan((0.0, 0.0), 0.0))
    beside = line((0.0, 0.0), (1.0, 0.9), (6.0, 0.9))
    assert certain(belief, line((0, 0), (6, 0)), 0.0) == pytest.approx(2.2, abs=0.05)
    assert certain(belief, beside, 0.0) > 2.0
    behind = line((0.0, 0.0), (-3.0, 0.0))
    assert certain(belief, behind, 0.0) == 0.0


VAN = ((-0.3, -0.35), (1.2, -0.35), (1.2, 0.35), (-0.3, 0.35))


def swept(path: Path, until: float) -> list[shapely.Polygon]:
    """A van on places of a path, as polygons."""
    found = []
    for along in np.linspace(0.0, until, 120):
        u = float(path.parameter(along))
        body = shapely.affinity.rotate(shapely.Polygon(VAN), path.heading(u), (0, 0), True)
        found.append(shapely.affinity.translate(body, *np.asarray(path.evaluate(u))))
    return found


@given(st.lists(st.tuples(st.floats(0, 6), st.floats(-3, 3), st.floats(0.15, 0.8)), max_size=6),
       st.floats(-2.0, 2.0), st.sampled_from([120.0, 270.0]))  # fmt: skip
@settings(max_examples=60)
def test_a_long_body_goes_no_farther_than_beams_have_been_before_all_of_it(
    posts: list[tuple[float, float, float]], aside: float, fov: float
) -> None:
    start = shapely.Polygon(VAN).buffer(0.2)
    things = [shapely.Point(x, y).buffer(r, 64) for x, y, r in posts]
    assume(not any(start.intersects(thing) for thing in things))
    obstacles = [Obstacle(circle=Circle(center=(x, y), radius=r)) for x, y, r in posts]
    lidar = LIDAR.model_copy(update={"fov_deg": fov})
    van = RobotSpec(footprint=VAN, clearance_m=0.1, sensor=Sensor(lidar=lidar))
    belief, _ = Belief.at_start(World(), van).with_scan(
        LidarSensor(obstacles, lidar).scan((0.0, 0.0), 0.0)
    )
    path, floor = Path([[(0, 0), (2, 0), (3, aside), (6, aside)]], []), van.inner_radius + 0.1
    seen = belief.seen_until(path, 0.0, path.length, floor)
    until = belief.clear_until(path, 0.0, seen, floor)
    there = shapely.union_all(things)
    assert not any(body.intersects(there) for body in swept(path, until))
    if not posts and aside == 0.0:
        assert until == pytest.approx(6.0 - 1.2, abs=0.15)


def test_a_long_body_that_turns_on_the_spot_has_seen_where_its_ends_get() -> None:
    lidar = LIDAR.model_copy(update={"fov_deg": 120.0})
    van = RobotSpec(footprint=VAN, sensor=Sensor(lidar=lidar))
    belief, _ = Belief.at_start(World(), van).with_scan(LidarSensor([], lidar).scan((0, 0), 0.0))
    slight, sharp = line((0, 0), (1, 0), (1.9, 0.4)), line((0, 0), (1, 0), (0.6, 1))
    assert belief.seen_until(slight, 0.0, slight.length, 0.35) > 1.5
    assert belief.seen_until(sharp, 0.0, sharp.length, 0.35) == pytest.approx(1.0, abs=0.1)


def test_a_shadow_is_not_entered_until_it_has_been_looked_into() -> None:
    belief = nothing()
    screen = Obstacle(polygon=((1.0, 0.35), (1.1, 0.35), (1.1, 4.0), (1.0, 4.0)))
    sensor = LidarSensor([screen], LIDAR)
    belief, _ = belief.with_scan(sensor.scan((0.0, 0.0), 0.0))
    corner = line((0.0, 0.0), (1.4, 0.0), (1.6, 1.5))
    first = certain(belief, corner, 0.0)
    assert 1.0 < first < 1.7
    belief, _ = belief.with_scan(sensor.scan((1.4, 0.0), 0.0))
    assert certain(belief, corner, 1.4) > first + 0.5


def test_what_was_seen_before_counts_and_what_is_far_behind_is_forgotten() -> None:
    views = ScanHistory(near=2.0, apart=0.1)
    ahead, aside = np.array([[1.0, 0.0]]), np.array([[0.0, 0.9]])
    look = Scan((0.0, 0.0), 0.0, -2.2, 0.01, 5.0, np.full(441, 5.0))
    blind = Scan((0.5, 0.0), 0.0, -2.2, 0.01, 5.0, np.full(441, np.nan))
    views = views.with_scan(look).with_scan(blind)
    assert views.count(aside, ahead, 0.1, 0.05) == 1
    away = Scan((3.0, 0.0), 0.0, -2.2, 0.01, 5.0, np.full(441, np.nan))
    views = views.with_scan(away)
    assert views.count(aside, ahead, 0.1, 0.05) == 0
    for k in range(500):
        place = (3.0 + 0.3 * math.cos(k), 0.3 * math.sin(k))
        views = views.with_scan(Scan(place, k * 0.1, -2.2, 0.01, 5.0, np.full(441, 1.0)))
    assert len(views.scans) < 400
