"""What a sensor in space tells, and where what it tells of is taken to be."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.moving_solids import gaps_to
from viaspline.space.online.solid_sensor import SolidSensor
from viaspline.space.online.solid_tracks import SolidTracks
from viaspline.tracks.followed import STOOD_S
from viaspline.tracks.straight_on import HORIZON_S

speeds = st.floats(-4, 4)


def ball(velocity: tuple[float, float, float], start: tuple[float, float, float]) -> MovingSolid:
    motion = {"from": start, "velocity_mps": velocity}
    data = {"ball": {"center": (0, 0, 0), "radius": 1.0}, "name": "kite", "motion": motion}
    return MovingSolid.of(Obstacle.model_validate(data), "kite", 0.0, 100.0)


def test_a_thing_is_seen_when_a_part_of_it_is_in_range() -> None:
    sensor = SolidSensor((ball((-2, 0, 0), (9, 0, 0)),), reach=5.0)
    here = np.zeros(3)
    assert sensor.seen(here, 1.4, 0) == ()
    [seen] = sensor.seen(here, 1.5, 0)
    assert seen.place.tolist() == [6.0, 0.0, 0.0]
    assert seen.velocity == (-2.0, 0.0, 0.0)


def test_noise_depends_on_the_seed_and_the_look_alone() -> None:
    solids = (ball((1, 0, 0), (0, 0, 0)),)
    first, again = (SolidSensor(solids, 9.0, 0.3, seed=4).seen(np.zeros(3), 1.0, 7)
                    for _ in range(2))  # fmt: skip
    other = SolidSensor(solids, 9.0, 0.3, seed=4).seen(np.zeros(3), 1.0, 8)
    assert first[0].velocity == again[0].velocity != other[0].velocity
    assert np.abs(np.array(first[0].velocity) - (1, 0, 0)).max() <= 0.9


@given(speeds, speeds, speeds, st.integers(0, 99), st.floats(0, 0.3))
def test_what_goes_straight_on_stays_in_its_tube(
    vx: float, vy: float, vz: float, seed: int, noise: float
) -> None:
    truth = ball((vx, vy, vz), (1, 2, 3))
    sensor = SolidSensor((truth,), 999.0, noise, seed)
    tracks = SolidTracks(noise)
    for k in range(6):
        tracks = tracks.with_sightings(sensor.seen(np.zeros(3), 0.1 * k, k), 0.1 * k)
    [tube] = tracks.foreseen(0.5, 20.0, 0.0)
    error = tracks.tracks[0].estimate
    off = np.linalg.norm(error.velocity - (vx, vy, vz))
    within = off <= error.velocity_error  # as in two of three cases and more
    times = np.linspace(0.5, 0.5 + 0.9 * (tube.times[-2] - 0.5), 40)
    gaps = np.linalg.norm(tube.at(times) - truth.at(times), axis=1) - tube.off_at(times)
    assert not within or gaps.max() <= 1e-6 or (noise == 0.0 and gaps.max() < 0.1)


def test_it_is_reckoned_with_for_a_while_and_what_stands_for_good() -> None:
    moving, still = ball((1, 0, 0), (0, 0, 0)), ball((0, 0, 0), (5, 0, 0))
    sensor, tracks = SolidSensor((moving, still), 99.0), SolidTracks(0.0)
    for k in range(int(10 * STOOD_S) + 2):
        tracks = tracks.with_sightings(sensor.seen(np.zeros(3), 0.1 * k, k), 0.1 * k)
    now = 0.1 * k
    goes, stands = tracks.foreseen(now, 90.0, 0.0)
    body, far = FlyingBody(0, 0, 0), np.array([now + HORIZON_S + 0.2, 80.0])
    places = np.zeros((2, 3))
    assert np.isinf(gaps_to(goes, body, places, far)).all()
    assert gaps_to(stands, body, places, far) == pytest.approx((4, 4), abs=0.05)


def test_what_jumps_is_followed_anew() -> None:
    tracks = SolidTracks(0.0)
    for time, x in ((0.0, 0.0), (0.1, 0.1), (0.2, 7.0)):
        sensor = SolidSensor((ball((1, 0, 0), (x - time, 0, 0)),), 99.0)
        tracks = tracks.with_sightings(sensor.seen(np.zeros(3), time, 0), time)
    assert tracks.tracks[0].jumped
    assert tracks.tracks[0].estimate.place[0] == pytest.approx(7.0)
