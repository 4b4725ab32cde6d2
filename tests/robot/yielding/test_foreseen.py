"""What is seen to move goes straight on for a while, as far as is foreseen."""

from __future__ import annotations

import math

import numpy as np
import pytest

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.moving.motion_sensor import MovingSighting
from viaspline.robot.perception.moving.moved_away import Glimpse
from viaspline.robot.perception.moving.object_track import ObjectTrack
from viaspline.robot.perception.moving.track_sightings import TrackedSightings
from viaspline.robot.yielding.foreseen import foreseen
from viaspline.tracks.motion_estimate import MotionEstimate
from viaspline.tracks.straight_on import HORIZON_S

DISC = Obstacle.model_validate({"name": "cart", "circle": {"center": (0, 0), "radius": 1.0}})


def seen_twice(noise: float = 0.0) -> TrackedSightings:
    tracked = TrackedSightings(velocity_noise=noise)
    for time in (2.0, 2.1):
        sighting = MovingSighting(0, DISC, (3.0 + 2.0 * (time - 2.0), 1.0, 0.0), (2.0, 0.0))
        tracked = tracked.with_sightings([sighting], time)
    return tracked


def test_it_goes_on_as_it_goes_and_is_not_reckoned_with_for_ever() -> None:
    moving = foreseen(seen_twice().tracks, 2.1)
    assert moving.names == ("cart",)
    there = 3.2 + 2.0 * 4.0
    assert moving.distance((there, 1.0), 6.1)[0] == pytest.approx(-1.0, abs=0.05)
    assert moving.distance((there, 1.0), 2.1 + HORIZON_S + 0.1)[0] == math.inf
    assert moving.distance((3.2, 1.0), 2.0)[0] == math.inf  # what was isn't foreseen


def test_the_less_certain_its_velocity_the_wider_it_becomes() -> None:
    sure, unsure = (foreseen(seen_twice(noise).tracks, 2.1) for noise in (0.0, 0.3))
    place = (3.2 + 2.0 * 3.0, 6.0)
    assert unsure.distance(place, 5.1)[0] < sure.distance(place, 5.1)[0] - 0.15


def test_what_has_just_been_seen_is_foretold_no_longer_than_it_is_known_where_it_will_be() -> None:
    unsure = MotionEstimate.at_first_sight(0.0, (5.0, 0.0), 0.1, 2.0)
    sure = MotionEstimate.at_first_sight(0.0, (5.0, 0.0), 0.1, 0.1)
    scan = Scan((0.0, 0.0), 0.0, 0.0, 0.1, 9.0, np.full(3, np.inf))
    glimpse = Glimpse(0.0, scan, np.zeros((1, 2)), 0.3)
    tracks = [
        ObjectTrack(1, estimate, 0.3, 0.0, False, glimpse, estimate.place)
        for estimate in (unsure, sure)
    ]
    first, second = (foreseen([track], 0.0) for track in tracks)
    assert first.distance((5.0, 0.0), 0.9)[0] < 0.0
    assert first.distance((5.0, 0.0), 1.1)[0] == math.inf
    assert second.distance((5.0, 0.0), HORIZON_S - 0.1)[0] < 0.0
    assert first.distance((9.0, 0.0), 1.0)[0] > 0.0
