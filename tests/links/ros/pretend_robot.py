"""A robot as its ROS would show it: poses from what it is told, a lidar, tf. It has no clock."""

import math
from typing import Any

import numpy as np
import shapely

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import LidarSensor

IDENTITY = {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}
EPOCH = 1.7e9
"""What its clock shows at the start [s]."""


def header(time: float, frame: str) -> dict[str, Any]:
    sec, nanosec = divmod(round((EPOCH + time) * 1e9), 10**9)
    return {"stamp": {"sec": sec, "nanosec": nanosec}, "frame_id": frame}


def turned(heading: float) -> dict[str, float]:
    return {"x": 0.0, "y": 0.0, "z": math.sin(heading / 2), "w": math.cos(heading / 2)}


def transform(time: float, parent: str, child: str, x: float, y: float, heading: float) -> Any:
    moved = {"x": x, "y": y, "z": 0.0}
    return {
        "transforms": [
            {
                "header": header(time, parent),
                "child_frame_id": child,
                "transform": {"translation": moved, "rotation": turned(heading)},
            }
        ]
    }


class PretendRobot:
    """Goes as fast as it is told, a little later; odometry begins at 0 wherever it stands."""

    def __init__(self, obstacles: list[Obstacle], spec: Any, start: tuple[float, float, float]):
        self.start, self.x, self.y, self.heading = start, *start
        self.told: list[tuple[float, float, float]] = []
        self.speed = self.turn = 0.0
        self.obstacles = obstacles
        self.lidar = None if spec is None else LidarSensor(obstacles, spec)
        self.number = 0
        self.nearest = math.inf

    def hears(self, time: float, twist: Any) -> None:
        self.told.append((time, twist["linear"]["x"], twist["angular"]["z"]))

    def moves(self, time: float, step: float, delay: float = 0.1) -> None:
        due = [one for one in self.told if one[0] <= time - delay]
        if due:
            self.speed, self.turn = due[-1][1:]
        self.heading += step * self.turn
        self.x += step * self.speed * math.cos(self.heading)
        self.y += step * self.speed * math.sin(self.heading)
        for one in self.obstacles:
            assert one.circle is not None
            center = shapely.Point(one.circle.center)
            gap = center.distance(shapely.Point(self.x, self.y)) - one.circle.radius
            self.nearest = min(self.nearest, gap)

    def map_to_odom(self, time: float) -> Any:
        return transform(time, "map", "odom", *self.start)

    def laser_mount(self, time: float) -> Any:
        return transform(time, "base_link", "laser", 0.1, 0.0, math.pi)

    def odometry(self, time: float) -> Any:
        dx, dy = self.x - self.start[0], self.y - self.start[1]
        c, s = math.cos(self.start[2]), math.sin(self.start[2])
        none = np.zeros(36)
        pose = {
            "position": {"x": c * dx + s * dy, "y": c * dy - s * dx, "z": 0.0},
            "orientation": turned(self.heading - self.start[2]),
        }
        twist = {
            "linear": {"x": self.speed, "y": 0.0, "z": 0.0},
            "angular": {"x": 0.0, "y": 0.0, "z": self.turn},
        }
        return {
            "header": header(time, "odom"),
            "child_frame_id": "base_link",
            "pose": {"pose": pose, "covariance": none},
            "twist": {"twist": twist, "covariance": none},
        }

    def scan(self, time: float) -> Any:
        assert self.lidar is not None
        at = (
            self.x + 0.1 * math.cos(self.heading), self.y + 0.1 * math.sin(self.heading)
        )  # fmt: skip
        seen = self.lidar.scan(at, self.heading + math.pi, self.number)
        self.number += 1
        return {
            "header": header(time, "laser"),
            "angle_min": seen.angle_min,
            "angle_max": seen.angle_min + seen.angle_increment * (len(seen.ranges) - 1),
            "angle_increment": seen.angle_increment,
            "time_increment": 0.0,
            "scan_time": 0.1,
            "range_min": 0.05,
            "range_max": seen.range_max,
            "ranges": seen.ranges.astype(np.float32),
            "intensities": np.zeros(0, np.float32),
        }
