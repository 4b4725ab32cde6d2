"""What moves is told from what stands, and followed; every hit is on some track or stands."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Flags
from viaspline.mission.sensor_spec import Lidar
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import LidarSensor, Scan
from viaspline.robot.perception.moving.object_track import ObjectTrack
from viaspline.robot.perception.moving.track_hits import TrackedHits
from viaspline.robot.perception.moving.tracking_premises import TrackingPremises
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

NOISE = 0.01
SPEC = Lidar(range_m=10.0, fov_deg=360, beams=720, noise_m=NOISE)
STEP = 0.1
WALL = Obstacle(polygon=((-9.0, 6.0), (9.0, 6.0), (9.0, 6.5), (-9.0, 6.5)))

Pose = Callable[[float], tuple[float, float]]


@dataclass(frozen=True, eq=False)
class Moment:
    """A scan, and what was made of it."""

    time: float
    scan: Scan
    standing: Flags
    tracked: TrackedHits


def disc(at: tuple[float, float], velocity: tuple[float, float], radius: float = 0.3) -> Obstacle:
    motion = {"from": at, "velocity_mps": velocity}
    circle = {"center": (0, 0), "radius": radius}
    return Obstacle.model_validate({"circle": circle, "motion": motion})


def along(*frames: tuple[float, float, float], radius: float = 0.3) -> Obstacle:
    motion = {"keyframes": frames, "after": "vanish", "before": "stay"}
    circle = {"center": (0, 0), "radius": radius}
    return Obstacle.model_validate({"circle": circle, "motion": motion})


def watched(moving: Sequence[Obstacle], standing: Sequence[Obstacle], seconds: float,
            known: Sequence[Obstacle] = (), pose: Pose = lambda t: (0.0, 0.0), seed: int = 0
            ) -> Iterator[Moment]:  # fmt: skip
    """What a robot makes of its scans on its way."""
    sensor = LidarSensor(standing, SPEC, seed=seed, moving=MovingObstacles(moving))
    tracked = TrackedHits(TrackingPremises(top_speed=2.5, noise=NOISE))
    world = World(known)
    for k in range(round(seconds / STEP) + 1):
        scan = sensor.scan(pose(STEP * k), 0.0, k, STEP * k)
        tracked, stands = tracked.with_scan(scan, STEP * k, world)
        yield Moment(STEP * k, scan, stands, tracked)


def nearest(moment: Moment, place: tuple[float, float]) -> ObjectTrack:
    return min(moment.tracked.tracks, key=lambda track: math.dist(track.estimate.place, place))


velocities = st.tuples(st.floats(0.3, 2.0), st.floats(0, math.tau))
movers = st.tuples(st.floats(-6, 6), st.floats(-5, 4), velocities, st.floats(0.15, 0.6))


@given(st.lists(movers, max_size=5), st.floats(0, math.tau), st.integers(0, 99))
@settings(deadline=None, max_examples=25)
def test_every_hit_stands_or_lies_in_the_disc_of_a_track(
    rows: list[tuple[float, float, tuple[float, float], float]], way: float, seed: int
) -> None:
    """Also where things meet, pass through each other and through the robot."""
    moving = [disc((x, y), (v * math.cos(a), v * math.sin(a)), r) for x, y, (v, a), r in rows]
    post = Obstacle.model_validate({"circle": {"center": (3, -2), "radius": 0.4}})

    def pose(t: float) -> tuple[float, float]:
        return (0.8 * t * math.cos(way), 0.8 * t * math.sin(way))

    for moment in watched(moving, [WALL, post], 4.0, [WALL], pose, seed):
        hits = moment.scan.hits[~moment.standing]
        if not len(hits):
            continue
        tracks = moment.tracked.tracks
        places = np.array([track.estimate.place for track in tracks])
        radii = np.array([track.radius for track in tracks])
        beyond = np.hypot(*(hits[:, None] - places).transpose(2, 0, 1)) - radii
        assert beyond.min(axis=1).max() <= 1e-9
        numbers = [track.number for track in tracks]
        assert len(set(numbers)) == len(numbers)
        assert all(t.estimate.axis.determinant > 0.0 for t in tracks)
        assert all(t.estimate.axis.place > 0.0 for t in tracks)


@given(st.floats(-1.5, 1.5), st.floats(0.5, 2.0), st.floats(-0.5, 0.5), st.floats(0.15, 0.6))
@settings(deadline=None, max_examples=25)
def test_one_that_passes_is_one_and_is_known_to_move(
    aside: float, speed: float, slant: float, radius: float
) -> None:
    velocity = (speed * math.cos(slant), speed * math.sin(slant))
    start = (-2.5 * velocity[0], -2.5 - aside - 2.5 * velocity[1])
    numbers = set()
    for moment in watched([disc(start, velocity, radius)], [WALL], 5.0, [WALL]):
        t = moment.time
        there = (start[0] + velocity[0] * t, start[1] + velocity[1] * t)
        if math.hypot(*there) < radius + 0.4:
            return  # over the robot
        track = nearest(moment, there)
        numbers.add(track.number)
        if t < 3.0:
            continue
        assert track.moves
        assert math.dist(track.estimate.place, there) < 0.12 + 0.2 * radius
        assert math.dist(track.estimate.velocity, velocity) < 0.35
        assert len(moment.tracked.tracks) == 1
    assert len(numbers) == 1


@given(st.lists(st.tuples(st.floats(-7, 7), st.floats(-5, 5), st.floats(0.05, 0.8)), max_size=6),
       st.floats(0, math.tau), st.integers(0, 99))  # fmt: skip
@settings(deadline=None, max_examples=25)
def test_where_nothing_moves_nothing_is_said_to_move(
    rows: list[tuple[float, float, float]], way: float, seed: int
) -> None:
    """However ever more of posts and walls comes into sight of a robot that drives by."""
    posts = [
        Obstacle.model_validate({"circle": {"center": (x, y), "radius": r}}) for x, y, r in rows
    ]

    def pose(t: float) -> tuple[float, float]:
        return (t * math.cos(way), t * math.sin(way))

    assume(all(math.dist(pose(0.1 * k), row[:2]) > row[2] + 0.3 for row in rows for k in range(41)))
    for moment in watched([], [WALL, *posts], 4.0, [], pose, seed):
        assert not any(track.moves for track in moment.tracked.tracks)


def test_what_stays_stands_and_what_has_moved_stands_later() -> None:
    post = Obstacle.model_validate({"circle": {"center": (3, 0), "radius": 0.3}})
    stood = [m.time for m in watched([], [post], 2.0) if m.standing.any()]
    assert stood[0] == pytest.approx(0.8)
    comes = along((0.0, -3.0, 0.0), (2.0, -1.5, 0.0), (20.0, -1.5, 0.0))
    moments = list(watched([comes], [], 8.0))
    assert not any(m.standing.any() for m in moments if m.time < 5.5)
    assert all(m.tracked.tracks[0].moves for m in moments if 1.5 < m.time < 5.5)
    assert any(m.standing.any() for m in moments if m.time >= 5.5)


@pytest.mark.parametrize(("speed", "y"), [(0.3, -6.0), (0.3, 0.0), (0.5, 9.2)])
def test_what_goes_slowly_far_away_leaves_nothing_behind_in_what_stands(
    speed: float, y: float
) -> None:
    """After 0.8 s it was said to stand, since so little of it had moved clearly."""
    for moment in watched([disc((-7.0, y), (0.7 * speed, -0.7 * speed), 0.5)], [], 5.0):
        assert not moment.standing.any()


def test_what_comes_into_reach_has_no_speed_that_it_has_not() -> None:
    """Ever more of it is seen, so its middle seems to go outward: within its error it doesn't."""
    start, velocity = (10.5, 0.0), (-1.0, 0.5)
    for moment in watched([disc(start, velocity, 0.5)], [], 2.5):
        for track in moment.tracked.tracks:
            away = math.dist(track.estimate.velocity, velocity)
            assert away < 2.5 * track.estimate.velocity_error
    assert away < 0.2


def test_what_stops_and_starts_again_keeps_its_number_and_its_speed_follows() -> None:
    way = along((0.0, -3.0, 3.0), (2.0, -1.0, 3.0), (4.0, -1.0, 3.0), (6.0, 1.0, 3.0))
    moments = list(watched([way], [], 6.0))
    speeds = {round(m.time, 1): math.hypot(*m.tracked.tracks[0].estimate.velocity) for m in moments}
    assert speeds[1.9] == pytest.approx(1.0, abs=0.15)
    assert speeds[3.9] < 0.15
    assert speeds[5.5] == pytest.approx(1.0, abs=0.15)
    assert {m.tracked.tracks[0].number for m in moments if m.tracked.tracks} == {1}
    assert not any(m.standing.any() for m in moments)


def test_what_is_gone_is_forgotten_where_beams_see_through_its_place() -> None:
    goes = along((0.0, 2.0, -1.5), (3.0, 2.0, 1.5))
    moments = list(watched([goes], [], 4.0))
    assert moments[29].tracked.tracks
    gone = [m.time for m in moments if m.time > 3.01 and not m.tracked.tracks]
    assert gone[0] <= 3.3


def test_what_is_hidden_goes_on_and_is_met_again_as_the_same() -> None:
    screen = Obstacle(polygon=((1.4, -0.25), (1.5, -0.25), (1.5, 0.25), (1.4, 0.25)))
    walks = disc((3.5, -2.4), (0.0, 1.2), radius=0.25)
    moments = list(watched([walks], [screen], 4.0, [screen]))
    hidden = [m for m in moments if all(track.seen < m.time for track in m.tracked.tracks)]
    assert hidden
    before = nearest(moments[10], (3.5, -1.2)).number
    assert nearest(moments[-1], (3.5, 2.4)).number == before


def test_two_that_pass_beside_each_other_keep_their_numbers() -> None:
    rows = [((-3.0, 2.0), (1.2, 0.0)), ((3.0, 3.2), (-1.2, 0.0))]
    moments = list(watched([disc(*row) for row in rows], [], 5.0))
    for (x, y), (vx, _) in rows:
        numbers = {nearest(m, (x + vx * m.time, y)).number for m in moments}
        assert len(numbers) == 1


def test_two_that_meet_are_one_large_thing_until_they_part() -> None:
    one = along((0.0, -2.0, 3.0), (2.0, -0.3, 3.0), (4.0, -0.3, 3.0), (6.0, -2.0, 3.0))
    other = along((0.0, 2.0, 3.0), (2.0, 0.3, 3.0), (4.0, 0.3, 3.0), (6.0, 2.0, 3.0))
    moments = list(watched([one, other], [], 5.9))
    together = next(m for m in moments if m.time > 2.95)
    assert max(track.radius for track in together.tracked.tracks) > 0.5
    parted = moments[-1]
    first, second = nearest(parted, (-1.9, 3.0)), nearest(parted, (1.9, 3.0))
    assert first.number != second.number
    for track, x in ((first, -1.9), (second, 1.9)):
        assert math.dist(track.estimate.place, (x, 3.0)) < 0.2
        assert track.radius < 0.6


def test_scans_come_in_the_order_in_which_they_were_taken() -> None:
    *_, last = watched([], [WALL], 0.3)
    with pytest.raises(GeometryError, match="order"):
        last.tracked.with_scan(last.scan, 0.1, World())


def test_an_empty_scan_and_one_twice_at_one_time_are_looks_like_others() -> None:
    blind = Scan((0.0, 0.0), 0.0, -1.0, 0.1, 9.0, np.full(21, np.nan))
    tracked = TrackedHits(TrackingPremises(top_speed=2.0))
    for _ in range(2):
        tracked, standing = tracked.with_scan(blind, 1.0, World())
    assert standing.shape == (0,)
    assert tracked.tracks == ()
    *_, last = watched([disc((2.0, 0.0), (0.0, 0.5))], [], 1.0)
    again, _ = last.tracked.with_scan(last.scan, last.time, World())
    assert [t.number for t in again.tracks] == [t.number for t in last.tracked.tracks]
