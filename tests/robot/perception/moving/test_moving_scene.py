"""What moves leaves nothing behind in what is believed to stand."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from viaspline.mission.robot_parts import MovingThings, RobotSpec
from viaspline.mission.sensor_spec import Lidar, Sensor
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.perception.moving.moving_scene import MovingScene
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

LIDAR = Lidar(range_m=10.0, fov_deg=270, beams=720, noise_m=0.01)
ROBOT = RobotSpec(
    radius_m=0.25, clearance_m=0.1, sensor=Sensor(lidar=LIDAR), moving=MovingThings(max_speed_mps=2)
)
WALL = Obstacle(polygon=((-2.0, 4.0), (9.0, 4.0), (9.0, 4.5), (-2.0, 4.5)))
POST = Obstacle.model_validate({"circle": {"center": (4.0, -2.5), "radius": 0.4}})


def beside(standing: World, rng: np.random.Generator) -> Iterator[Obstacle]:
    """Four discs that pass what stands and don't touch it."""
    count = 0
    while count < 4:
        start, velocity = rng.uniform((2, -4), (8, 2)), rng.uniform((-1, -0.3), (-0.5, 0.3))
        way = start + np.linspace(0.0, 6.0, 100)[:, None] * velocity
        if standing.distance(way).min() < 0.6:
            continue
        count += 1
        motion = {"from": start.tolist(), "velocity_mps": velocity.tolist()}
        circle = {"center": (0, 0), "radius": 0.3}
        yield Obstacle.model_validate({"circle": circle, "motion": motion})


@pytest.mark.parametrize("seed", range(4))
def test_there_are_no_ghosts_in_what_is_believed_to_stand(seed: int) -> None:
    """Though walls are new to the robot, which drives among what moves."""
    truth = World([WALL, POST])
    moving = MovingObstacles(beside(truth, np.random.default_rng(seed)))
    sensor = LidarSensor([WALL, POST], LIDAR, seed=seed, moving=moving)
    scene = MovingScene.at_start(World(), ROBOT)
    for k in range(60):
        scan = sensor.scan((0.05 * k, 0.0), 0.0, k, 0.1 * k)
        scene, _ = scene.with_scan(scan, 0.1 * k)
        if len(scene.belief.surfaces):
            assert truth.distance(scene.belief.surfaces.places).max() < 0.05
    assert scene.belief.world.distance([(4.0, -2.1), (3.0, 4.0)]).max() < 0.1
    assert any(track.moves for track in scene.tracked.tracks)
