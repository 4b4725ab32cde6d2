"""Whether what touched a robot could be known of while there was still time to brake for it.

Tested through ``tracks/test_encounters``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.perception.moving.motion_sensor import MotionSensor
from viaspline.robot.simulation.driven_motion import DrivenMotion
from viaspline.trajectory.limits import REACTION_S
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

REMEMBERED_S = 2.0
"""What a lidar has shown so lately is still reckoned with where something hides it [s]."""

JUMP_STEP_S = 0.01
"""From one instant to the next at which it is looked whether something has jumped [s]."""

ROUNDING_M = 1e-6
"""What is farther from where it could have gone than by this has jumped [m]."""

ON_SURFACE_M = 1e-3
"""A hit that is no farther from a thing shows it [m]."""


@dataclass(frozen=True)
class Appearance:
    """When the sensor of a robot could show what, on a drive.

    Attributes:
        mission: What was driven.
        world: Everything that stood.
        moving: Everything that moved, what is on the map first.
        motion: Of the body.
    """

    mission: Mission
    world: World
    moving: MovingObstacles
    motion: DrivenMotion

    def was_late(self, index: int, time: float) -> bool:
        """Whether something could not be seen until the robot couldn't stand in time any more.

        It could if the last look from which the robot could have braked to a stand showed it, and
        it has gone from there to where it touched the robot without a jump; a lidar may have shown
        it a little before that. What is on the map was known from the start.

        Args:
            index: Of what touched the robot.
            time: When it did [s].
        """
        if index < len(self.mission.world.moving):
            return False
        times = self.motion.times[self.motion.looks]
        in_time = np.flatnonzero(times <= self._needed_by(time))
        for k in reversed(in_time.tolist()):
            if times[k] < times[in_time[-1]] - self._memory:
                break
            if self._shows(index, int(self.motion.looks[k])):
                return self._jumps(index, float(times[k]), time)
        return True

    @property
    def _memory(self) -> float:
        """For how long the robot remembers what it isn't shown any more [s]."""
        sensor = self.mission.robot.sensor
        return 0.0 if sensor is None or sensor.lidar is None else REMEMBERED_S

    def _needed_by(self, time: float) -> float:
        """The last moment from which the robot could brake to a stand before a time [s]."""
        times, speeds = self.motion.times, self.motion.speeds
        stands = times + _delay(self.mission.robot) + np.abs(speeds) / _brake(self.mission.robot)
        in_time = np.flatnonzero((stands <= time) & (times <= time))
        return float(times[in_time[-1]]) if in_time.size else -math.inf

    def _shows(self, index: int, moment: int) -> bool:
        """Whether the sensor shows something at a moment of the drive."""
        sensor, place = self.mission.robot.sensor, self.motion.places[moment]
        time, alone = float(self.motion.times[moment]), self.moving.alone(index)
        if sensor is None:
            return False
        if sensor.lidar is None:
            return bool(MotionSensor(alone, sensor.reach).seen(place, time))
        exact = sensor.lidar.model_copy(update={"noise_m": 0.0})
        lidar = LidarSensor(self.world.obstacles, exact, moving=self.moving)
        hits = lidar.scan(tuple(place.tolist()), float(self.motion.headings[moment]), time=time)
        points = hits.hits
        return bool(len(points)) and bool(alone.distance(points, time).min() <= ON_SURFACE_M)

    def _jumps(self, index: int, begin: float, end: float) -> bool:
        """Whether something isn't there, or elsewhere than it could have gone, for a moment."""
        alone = self.moving.alone(index)
        times = np.linspace(begin, end, max(math.ceil((end - begin) / JUMP_STEP_S), 1) + 1)
        frames = np.array([alone.frames(time)[0] for time in times.tolist()])
        if not np.isfinite(frames).all():
            return True
        farthest = float(alone.packed.reaches[0])
        step = float(alone.packed.speeds[0]) * float(times[1] - times[0]) + ROUNDING_M
        return max(_gone(frames, farthest), _gone(frames, 0.0)) > step


def _gone(frames: Floats, reach: float) -> float:
    """How far a point so far before the middle of a frame goes in one step at most [m]."""
    ahead = np.column_stack((np.cos(frames[:, 2]), np.sin(frames[:, 2])))
    return float(np.hypot(*np.diff(frames[:, :2] + reach * ahead, axis=0).T).max())


def _brake(robot: RobotSpec) -> float:
    return robot.max_brake_mps2 or robot.max_accel_mps2


def _delay(robot: RobotSpec) -> float:
    """From a look until the robot brakes for what it shows [s]."""
    drive = robot.drive
    return REACTION_S if drive is None else REACTION_S + drive.delay_s + drive.lag_s
