"""What is new about one more look."""

from __future__ import annotations

import pytest

from viaspline.errors import GeometryError
from viaspline.mission.sensor_spec import Lidar
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.perception.perceive import perceive
from viaspline.robot.yielding.foreseen import foreseen
from viaspline.world.world import World

TANK = Obstacle.model_validate({"circle": {"center": (9, 0), "radius": 1}, "name": "tank"})
ROCK = Obstacle.model_validate({"circle": {"center": (3, 0), "radius": 1}, "name": "rock"})


@pytest.fixture
def known() -> Knowledge:
    return Knowledge(World([TANK]), frozenset([TANK]))


def test_what_is_on_the_map_is_nothing_new(known: Knowledge) -> None:
    assert perceive(known, [TANK, TANK], 0.0, foreseen) == (known, None)
    assert perceive(known, [], 0.0, foreseen) == (known, None)


def test_what_is_told_twice_at_once_is_one_thing(known: Knowledge) -> None:
    knowledge, sighting = perceive(known, iter([ROCK, TANK, ROCK]), 0.0, foreseen)
    assert isinstance(sighting, World)
    assert sighting.names == ("rock",)
    assert knowledge.world.names == ("tank", "rock")
    assert perceive(knowledge, [ROCK], 0.0, foreseen) == (knowledge, None)


def test_a_scan_for_a_robot_without_a_lidar_is_refused(known: Knowledge) -> None:
    scan = LidarSensor([ROCK], Lidar(range_m=5)).scan((0.0, 0.0), 0.0)
    with pytest.raises(GeometryError, match=r"has no lidar; give it one by robot\.sensor\.lidar"):
        perceive(known, scan, 0.0, foreseen)
