"""What is known after something was told or scanned."""

from __future__ import annotations

from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.perception.belief import Belief
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.yielding.foreseen import foreseen
from viaspline.world.world import World

TANK = Obstacle.model_validate({"circle": {"center": (9, 0), "radius": 1}, "name": "tank"})
ROCK = Obstacle.model_validate({"circle": {"center": (3, 0), "radius": 1}})
ROBOT = RobotSpec.model_validate({"radius_m": 0.3, "sensor": {"lidar": {"range_m": 6}}})


def test_what_is_told_has_the_name_that_it_has_in_the_world() -> None:
    before = Knowledge(World([TANK]), frozenset([TANK]))
    knowledge, new = before.with_obstacles([ROCK])
    assert new.names == ("obstacle 2",)
    assert knowledge.world.names == ("tank", "obstacle 2")
    assert knowledge.told == {TANK, ROCK}
    assert before.world.names == ("tank",)


def test_what_is_told_comes_before_what_a_lidar_has_seen() -> None:
    assert ROBOT.sensor is not None
    assert ROBOT.sensor.lidar is not None
    world = World([TANK])
    before = Knowledge(world, frozenset([TANK]), Belief.at_start(world, ROBOT))
    scan = LidarSensor([ROCK], ROBOT.sensor.lidar).scan((0.0, 0.0), 0.0)
    seen, news = before.with_scan(scan, 0.0, foreseen)
    assert len(news.new) == len(seen.world) - 1 > 0
    told, new = seen.with_obstacles([ROCK])
    assert told.world.names[:2] == ("tank", "obstacle 2")
    assert new.names == ("obstacle 2",)
    assert len(told.world) == len(seen.world) + 1
    assert told.world is told.belief.world if told.belief is not None else False
