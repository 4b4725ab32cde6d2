"""Records a drive: what others show of it, and exactly what its navigator was given and decided.

Tested through ``bags/test_bag_file``.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline import __version__
from viaspline.bags.bag_writer import BagWriter
from viaspline.bags.mission_json import mission_text, obstacle_text
from viaspline.bags.own_messages import STEP, STEP_TOPIC, TOLD, TOLD_TOPIC
from viaspline.bags.step_message import step_message
from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import Plan
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.simulation.driven_step import DrivenStep
from viaspline.robot.state import RobotState
from viaspline.ros_messages.grid_message import Box, occupancy
from viaspline.ros_messages.laserscan_message import laserscan
from viaspline.ros_messages.log_message import log_line
from viaspline.ros_messages.marker_message import forget_all
from viaspline.ros_messages.odometry_message import odometry
from viaspline.ros_messages.path_message import path_message
from viaspline.ros_messages.plan_marks import event_mark, path_marks, plan_marks
from viaspline.ros_messages.stamps import BASE_FRAME, LASER_FRAME, MAP_FRAME, ODOM_FRAME
from viaspline.ros_messages.transform_message import FramePose, transforms
from viaspline.ros_messages.twist_message import command_twist

MISSION_FILE_NAME: Final = "mission.json"
ABOUT: Final = "viaspline"
"""The name of the record that says how the drive was driven."""

PERIOD_KEY, REACTION_KEY, SEED_KEY, VERSION_KEY = "period_s", "reaction_s", "seed", "version"
MOST_POSES: Final = 500
"""Poses of a path, at most."""
LEFT_OUT_S: Final = 0.5
"""From one pose to the next where a robot that follows exactly has left out steps [s]."""
LEAST_SPACING_M: Final = 0.05
MARGIN_M: Final = 2.0
"""What the map shows around the path where a mission has no bounds [m]."""


class DriveRecorder:
    """Writes the steps of a drive into a bag.

    Args:
        bag: Where to.
        asked: The mission as it was asked for; from it the plan can be made again.
        plan: Its plan.
        period: From one step to the next [s].
        reaction: The longest time between two of them [s].
        seed: Of the simulation.

    Raises:
        GeometryError: The mission is one in space.
    """

    def __init__(
        self, bag: BagWriter, asked: Mission, plan: Plan, *, period: float, reaction: float,
        seed: int,
    ) -> None:  # fmt: skip
        self._bag, self._plan, self._period = bag, plan, period
        self._numbers: dict[Obstacle, int] = {}
        self._same: dict[int, tuple[Obstacle, int]] = {}
        self._last: DrivenStep | None = None
        self._path: Path | None = None
        self._before: tuple[float, float] | None = None
        self._marked = 0
        self._size = max(0.25, 0.01 * plan.path.length)
        bag.attach(MISSION_FILE_NAME, "application/json", mission_text(asked).encode())
        bag.note(
            ABOUT,
            {
                VERSION_KEY: __version__,
                SEED_KEY: str(seed),
                PERIOD_KEY: repr(period),
                REACTION_KEY: repr(reaction),
            },
        )
        world, box = plan.world, _shown(plan)
        bag.write("/map", "nav_msgs/msg/OccupancyGrid", 0.0, occupancy(0.0, world, box))
        fixed = transforms(
            0.0, [FramePose(MAP_FRAME, ODOM_FRAME), FramePose(BASE_FRAME, LASER_FRAME)]
        )
        bag.write("/tf_static", "tf2_msgs/msg/TFMessage", 0.0, fixed)

    def note(self, step: DrivenStep) -> None:
        """Write a step; to be called with every one, in order."""
        if self._last is not None:
            self._left_out(self._last, step.time)
        time, nav = step.time, step.nav
        self._pose(time, step.state)
        if isinstance(step.sensed, Scan):
            scan = laserscan(time, step.sensed, period=self._period)
            self._bag.write("/scan", "sensor_msgs/msg/LaserScan", time, scan)
        message = step_message(step, lambda one: self._number(one, time))
        self._bag.write(STEP_TOPIC, STEP, time, message)
        if nav.path is not self._path:
            self._new_path(time, nav.path)
        self._bag.write("/cmd_vel", "geometry_msgs/msg/Twist", time, command_twist(step.command))
        for event in nav.events:
            self._bag.write("/rosout", "rcl_interfaces/msg/Log", time, log_line(time, event))
        if nav.events:
            marks = [
                event_mark(time, self._marked + i, event, self._size)
                for i, event in enumerate(nav.events)
            ]
            self._marked += len(marks)
            self._marks(time, marks)
        self._last = step

    def _left_out(self, last: DrivenStep, until: float) -> None:
        """The poses at the steps that a robot that follows exactly has left out."""
        if last.nav.controller is not None:
            return
        count = math.ceil((until - last.time) / LEFT_OUT_S - 1e-9)
        times = last.time + LEFT_OUT_S * np.arange(1, count)
        if not len(times):
            return
        path, law = last.nav.path, last.nav.trajectory
        distances = np.asarray(law.distance_at(times))
        u = np.asarray(path.parameter(distances))
        places, headings = np.asarray(path.evaluate(u)), np.asarray(path.heading(u))
        speeds = np.asarray(law.speed_at(distances))
        rows = zip(times.tolist(), places.tolist(), headings.tolist(), speeds.tolist(), strict=True)
        for time, place, heading, speed in rows:
            self._pose(time, RobotState(tuple(place), heading, speed))

    def _pose(self, time: float, state: RobotState) -> None:
        rate = 0.0
        if self._before is not None and time > self._before[0]:
            before, heading = self._before
            rate = math.remainder(state.heading - heading, math.tau) / (time - before)
        self._before = time, state.heading
        frames = [FramePose(ODOM_FRAME, BASE_FRAME, state.position, state.heading)]
        self._bag.write("/tf", "tf2_msgs/msg/TFMessage", time, transforms(time, frames))
        self._bag.write("/odom", "nav_msgs/msg/Odometry", time, odometry(time, state, rate))

    def _new_path(self, time: float, path: Path) -> None:
        spacing = max(path.length / MOST_POSES, LEAST_SPACING_M)
        self._bag.write("/plan", "nav_msgs/msg/Path", time, path_message(time, path, spacing))
        if self._path is None:
            self._marks(time, [forget_all(time), *plan_marks(time, self._plan, self._size)])
        else:
            self._marks(time, path_marks(time, path, self._size))
        self._path = path

    def _marks(self, time: float, marks: list[dict[str, object]]) -> None:
        if marks:
            kind = "visualization_msgs/msg/MarkerArray"
            self._bag.write("/viaspline/markers", kind, time, {"markers": marks})

    def _number(self, obstacle: Obstacle, time: float) -> int:
        """The number of an obstacle; the first time that it is asked for, it is told of."""
        same = self._same.get(id(obstacle))
        if same is not None and same[0] is obstacle:
            return same[1]
        if obstacle not in self._numbers:
            number = self._numbers[obstacle] = len(self._numbers)
            self._same[id(obstacle)] = obstacle, number
            told = {"number": number, "obstacle": obstacle_text(obstacle)}
            self._bag.write(TOLD_TOPIC, TOLD, time, told)
        return self._numbers[obstacle]


def _shown(plan: Plan) -> Box:
    """What of the world a map shows: its bounds, or what is around the path [m]."""
    if plan.world.bounds is not None:
        return plan.world.bounds
    points = np.asarray(plan.path.spans)[..., :2].reshape(-1, 2)
    margin = MARGIN_M + plan.mission.robot.outer_radius
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])
