"""What a robot with a lidar knows: its map, the surfaces it has seen, and where it has looked."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.scan_history import ScanHistory
from viaspline.robot.perception.surface_points import SurfacePoints
from viaspline.world.world import World

GRAIN = 1.0 / 20.0  # radius of the discs on surfaces, of the distance that the path keeps
FINEST, COARSEST = 0.005, 0.1  # and its limits [m]
LEAST_ROOM = 4.0 * FINEST
"""Distance that even a point without clearance keeps from surfaces that it sees [m]."""

AHEAD = 1.3  # distances to stop in that a robot looks ahead
LATEST = 64  # surfaces beyond which all of them are packed anew
GAP = 1.0  # from place to place that has to have been seen, of the discs' radius
INSIDE = 0.8  # of that radius: so far into a disc places can be seen for certain
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
        settled: The map and the surfaces but for the latest, packed once for many scans.
        echoes: The surfaces that beams have hit.
        views: The looks round that are remembered.
        body: The robot's radius [m].
        ahead: How far along its path the robot looks [m]: as far as it needs to stop from its full
            speed, and a little more.
        world: The map and the surfaces.
    """

    map: World
    settled: World
    echoes: SurfacePoints
    views: ScanHistory
    body: float
    ahead: float
    world: World

    @classmethod
    def at_start(cls, world: World, robot: RobotSpec) -> Belief:
        """What a robot that has just been put down knows.

        Raises:
            AssertionError: When the robot has no lidar.
        """
        assert robot.sensor is not None and robot.sensor.lidar is not None  # noqa: PT018
        lidar = robot.sensor.lidar
        required = robot.outer_radius + robot.clearance_m
        cell_size = float(np.clip(GRAIN * required, FINEST, COARSEST)) + lidar.noise_m
        stop = robot.max_speed_mps**2 / (2.0 * (robot.max_brake_mps2 or robot.max_accel_mps2))
        ahead = AHEAD * stop + 2.0 * required
        views = ScanHistory(
            near=2.0 * ahead, apart=max(required, 4.0 * cell_size), noise=lidar.noise_m
        )
        echoes = SurfacePoints.none(cell_size, lidar.noise_m)
        return cls(world, world, echoes, views, robot.outer_radius, ahead, world)

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
            echoes = echoes.confirmed(scan, hits[known], index[known] - len(self.map))
        echoes, moved = echoes.put_right(before)
        echoes, new = echoes.with_hits(hits[strange])
        echoes, gone = echoes.without_seen_through(scan)
        belief = replace(self, echoes=echoes, views=self.views.with_scan(scan))
        latest = len(self.world) - len(self.settled) + len(new)
        if moved or gone or latest > LATEST:
            belief = belief._packed()
        elif new:
            belief = replace(belief, world=self.settled.with_obstacles(echoes.obstacles[-latest:]))
        return belief, News(moved + new, gone)

    def seen_until(self, path: Path, start: float, end: float, floor: float) -> float:
        """How far along a path the body can go where beams have been on all of its front [m].

        Args:
            path: What is driven.
            start: Up to there that is known [m].
            end: Beyond this it is not asked [m].
            floor: Distance that the path keeps from what is known [m].
        """
        if end <= start:
            return end
        along = self._along(path, start, end)
        u = np.asarray(path.parameter(along))
        places = np.asarray(path.evaluate(u))[:, :2]
        tangents = np.asarray(path.tangent(u))[:, :2]
        # beams end at surfaces, which lie inside of the discs that the path keeps clear of
        rim = min(self.body + RIM * self.echoes.cell_size, floor + INSIDE * self.echoes.cell_size)
        count = self.views.count(places, tangents, rim, GAP * self.echoes.cell_size)
        return float(along[count - 1]) if count else start

    def clear_until(self, path: Path, start: float, end: float, floor: float) -> float:
        """How far along a path it keeps a distance from everything known [m].

        Args:
            path: What is driven.
            start: Where the robot is on it [m].
            end: Beyond this it is not asked [m].
            floor: The distance to keep [m].
        """
        if not len(self.world) or end <= start:
            return end
        along = self._along(path, start, end)
        near = np.flatnonzero(self.world.distance(path.at_distance(along)) < floor - SLACK)
        if not near.size:
            return end
        return float(along[near[0] - 1]) if near[0] else start

    def _along(self, path: Path, start: float, end: float) -> Floats:
        """Places along a path, the same for every start: multiples of a length, and the end."""
        step = GAP * self.echoes.cell_size
        places = step * np.arange(np.ceil(start / step), np.ceil(end / step))
        return np.append(places[places < end], end)

    def told(self, obstacles: Iterable[Obstacle]) -> Belief:
        """The same with more obstacles on the map."""
        return replace(self, map=self.map.with_obstacles(obstacles))._packed()

    def _packed(self) -> Belief:
        settled = self.map.with_obstacles(self.echoes.obstacles)
        return replace(self, settled=settled, world=settled)
