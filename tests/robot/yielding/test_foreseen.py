"""What is seen to move goes straight on for a while, as far as is foreseen."""

from __future__ import annotations

import math

import pytest

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.moving.motion_sensor import MovingSighting
from viaspline.robot.perception.moving.track_sightings import TrackedSightings
from viaspline.robot.yielding.foreseen import HORIZON_S, foreseen

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
    assert unsure.distance(place, 5.1)[0] < sure.distance(place, 5.1)[0] - 0.3
