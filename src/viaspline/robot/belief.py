"""What a robot with a lidar knows: its map, the surfaces it has seen, and where it has looked."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from viaspline.curve.path import Path
from viaspline.mission.parts import Obstacle, RobotSpec
from viaspline.robot.echoes import Echoes
from viaspline.robot.lidar import Scan
from viaspline.robot.views import Views
from viaspline.world.world import World

GRAIN = 1.0 / 12.0  # radius of the discs on surfaces, of the distance that the path keeps
FINEST, COARSEST = 0.005, 0.1  # and its limits [m]
AHEAD = 1.3  # distances to stop in that a robot looks ahead
GAP = 0.7  # from place to place that has to have been seen, of the discs' radius
RIM = 0.3  # by which the body is taken for larger where it has to be seen free, of the same
SLACK = 1e-4  # by which samples of a path may miss the distance that it was proven to keep [m]
ON_MAP = 1e-6  # a hit nearer than this to what is on the map shows just that [m]


@dataclass(frozen=True)
class News:
    """What a scan changed in what is known.

    Attributes:
        new: Discs that were not there before, or not in these places.
        gone: How many discs have gone.
    """

    new: tuple[Obstacle, ...]
    gone: int


@dataclass(frozen=True, eq=False)
class Belief:
    """What is known, seen and looked at; a new one for every scan.

    Attributes:
        map: What is known without being seen: it stays, whatever the beams say.
        echoes: The surfaces that beams have hit.
        views: The looks round that are remembered.
        body: The robot's radius [m].
        ahead: How far along its path the robot looks [m]: as far as it needs to stop from its full
            speed, and a little more.
        world: The map and the surfaces.
    """

    map: World
    echoes: Echoes
    views: Views
    body: float
    ahead: float
    world: World

    @classmethod
    def at_start(cls, world: World, robot: RobotSpec, position: ArrayLike) -> Belief:
        """What a robot that has just been put down knows.

        Raises:
            AssertionError: When the robot has no lidar.
        """
        assert robot.sensor is not None and robot.sensor.lidar is not None  # noqa: PT018
        lidar = robot.sensor.lidar
        required = robot.radius_m + robot.clearance_m
        grain = float(np.clip(GRAIN * required, FINEST, COARSEST)) + lidar.noise_m
        stop = robot.max_speed_mps**2 / (2.0 * robot.max_accel_mps2)
        ahead = AHEAD * stop + 2.0 * required
        views = Views(near=2.0 * ahead, apart=max(required, 4.0 * grain), noise=lidar.noise_m)
        return cls(world, Echoes.none(grain, lidar.noise_m), views, robot.radius_m, ahead, world)

    def with_scan(self, scan: Scan) -> tuple[Belief, News]:
        """What is known after one more scan, and what is new about it."""
        hits, before = scan.hits, self.echoes.hits
        echoes = self.echoes
        strange = np.ones(len(hits), np.bool_)
        if len(self.world) and len(hits):
            distance, index = self.world.nearest(hits)
            seen = index >= len(self.map)
            strange = distance > np.where(seen, 0.0, ON_MAP) + echoes.tolerance
            known = seen & ~strange
            echoes = echoes.confirmed(hits[known], index[known] - len(self.map))
        echoes, moved = echoes.put_right(before)
        echoes, new = echoes.with_hits(hits[strange])
        echoes, gone = echoes.without_seen_through(scan)
        world = self.world
        if new or moved or gone:
            world = self.map.with_obstacles(echoes.obstacles)
        views = self.views.with_scan(scan)
        return replace(self, echoes=echoes, views=views, world=world), News(moved + new, gone)

    def certain_until(self, path: Path, distance: float, floor: float) -> float:
        """How far along a path the robot can go inside of what it has seen [m].

        Up to there its whole body has only been where beams have passed, and the path keeps its
        distance from everything known.

        Args:
            path: What is driven.
            distance: Where the robot is on it [m].
            floor: Distance to keep from what is known [m].
        """
        step = GAP * self.echoes.grain
        first, last = np.ceil(distance / step), np.floor((distance + self.ahead) / step)
        along = step * np.arange(first, last + 1.0)
        along = np.append(along[along < path.length], min(path.length, distance + self.ahead))
        u = np.asarray(path.parameter(along))
        places = np.asarray(path.evaluate(u))[:, :2]
        tangents = np.asarray(path.tangent(u))[:, :2]
        rim = self.body + RIM * self.echoes.grain
        count = self.views.count(places, tangents, rim, step)
        if len(self.world) and count:
            near = np.flatnonzero(self.world.distance(places[:count]) < floor - SLACK)
            count = int(near[0]) if near.size else count
        return float(along[count - 1]) if count else distance

    def told(self, obstacles: Iterable[Obstacle]) -> Belief:
        """The same with more obstacles on the map."""
        known = self.map.with_obstacles(obstacles)
        return replace(self, map=known, world=known.with_obstacles(self.echoes.obstacles))
