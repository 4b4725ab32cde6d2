"""What a robot makes of what it is shown: all that it knows then, and what of it is new."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from viaspline.errors import GeometryError
from viaspline.handed_in import all_of
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigation.knowledge import Foreseen, Knowledge
from viaspline.robot.perception.belief import News
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.moving.motion_sensor import MovingSighting
from viaspline.world.world import World

Sighting = World | News
"""Obstacles that were told for the first time, each by its name; or what a scan has changed."""


def perceive(
    knowledge: Knowledge, sensed: Iterable[Obstacle] | Scan, time: float, ahead: Foreseen
) -> tuple[Knowledge, Sighting | None]:
    """What is known after one more look.

    Args:
        knowledge: What was known before.
        sensed: A lidar's scan, or every obstacle in sight.
        time: Of the look [s].
        ahead: What things that move are taken to do.

    Returns:
        (what is known now, what that look has shown); None if it told of nothing new.

    Raises:
        GeometryError: When there is a scan and the robot has no lidar.
    """
    if isinstance(sensed, Scan):
        if knowledge.belief is None:
            raise GeometryError(
                "a scan was given, but the mission's robot has no lidar; give it one by "
                "robot.sensor.lidar"
            )
        return knowledge.with_scan(sensed, time, ahead)
    in_sight = all_of("sensed", sensed, Obstacle, "give obstacles in sight, or a Scan")
    same = {id(obstacle) for obstacle in knowledge.in_sight}
    others = (obstacle for obstacle in in_sight if id(obstacle) not in same)
    new = tuple(dict.fromkeys(o for o in others if o not in knowledge.told))
    knowledge = replace(knowledge, in_sight=in_sight)
    return knowledge.with_obstacles(new) if new else (knowledge, None)


def told_apart(
    sensed: Iterable[Obstacle | MovingSighting],
) -> tuple[tuple[Obstacle, ...], tuple[MovingSighting, ...]]:
    """What is told of in one look: what stands, and what moves.

    Raises:
        GeometryError: Something is neither; an obstacle has a motion, which a look doesn't show; or
            two sightings are of the same thing.
    """
    told = all_of(
        "sensed", sensed, (Obstacle, MovingSighting), "give obstacles in sight, or a Scan"
    )
    moving = tuple(one for one in told if isinstance(one, MovingSighting))
    for i, one in enumerate(told):
        if isinstance(one, Obstacle) and one.motion is not None:
            raise GeometryError(
                f"sensed[{i}] has a motion, and a look shows where something is; give "
                "MovingSighting(index, obstacle, frame, velocity)"
            )
    indices = [one.index for one in moving]
    if len(set(indices)) < len(indices):
        twice = next(index for index in indices if indices.count(index) > 1)
        raise GeometryError(
            f"sensed has two sightings of moving thing {twice} in one look; give each thing an "
            "index of its own"
        )
    if not moving:
        return told, ()
    return tuple(one for one in told if isinstance(one, Obstacle)), moving
