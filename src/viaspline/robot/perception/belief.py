"""What a robot with a lidar knows: its map, the surfaces it has seen, and where it has looked."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Flags, Floats
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.requirements import LEAST_KEPT_M
from viaspline.robot.perception.body_front import Footprint, body_motion, body_rim
from viaspline.robot.perception.body_room import clear_places
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.scan_history import ScanHistory
from viaspline.robot.perception.surface_points import SurfacePoints
from viaspline.world.outline import outline
from viaspline.world.world import World

DISC_RATIO = 1.0 / 20.0
"""Radius of the discs on surfaces, of the distance that the path keeps."""

MIN_DISC_RADIUS_M, MAX_DISC_RADIUS_M = 0.005, 0.1
"""Its limits [m]."""

MIN_SURFACE_DISTANCE_M = 4.0 * MIN_DISC_RADIUS_M
"""Distance that even a point without clearance keeps from surfaces that it sees [m]."""

LOOKAHEAD_RATIO = 1.3
"""How far a robot looks ahead, of the distance in which it stops."""

JERK_LOOKAHEAD_S = 0.5
"""With a limit of the jerk it looks ahead for so much longer, because it looks more seldom how it
goes on [s]."""

MAX_LOOSE_DISCS = 64
"""Surfaces beyond which all of them are packed anew."""

PLACE_SPACING_RATIO = 1.0
"""From place to place that has to have been seen, of the discs' radius."""

VISIBLE_DEPTH_RATIO = 0.8
"""So far into a disc places can be seen for certain, of its radius."""

BODY_RIM_RATIO = 0.3
"""By which the body is taken for larger where it has to be seen free, of the same radius."""

SAMPLE_SLACK_M = 1e-4
"""By which samples of a path may miss the distance that it was proven to keep [m]."""

ON_MAP_M = 1e-6
"""A hit nearer than this to what is on the map shows just that [m]."""


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
        surfaces: The surfaces that beams have hit.
        scans: The looks round that are remembered.
        body: The robot's radius, or how far its body reaches about its reference point [m].
        inner: The radius of the largest disc in it [m].
        footprint: Its corners if it is a polygon [m].
        lookahead: How far along its path the robot looks [m]: as far as it needs to stop from its
            full speed, and a little more.
        world: The map and the surfaces.
    """

    map: World
    settled: World
    surfaces: SurfacePoints
    scans: ScanHistory
    body: float
    inner: float
    footprint: Footprint | None
    lookahead: float
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
        disc = float(np.clip(DISC_RATIO * required, MIN_DISC_RADIUS_M, MAX_DISC_RADIUS_M))
        cell_size = disc + lidar.noise_m
        brake = robot.max_brake_mps2 or robot.max_accel_mps2
        stop = robot.max_speed_mps**2 / (2.0 * brake)
        if robot.max_jerk_mps3 is not None:
            stop += robot.max_speed_mps * (0.5 * brake / robot.max_jerk_mps3 + JERK_LOOKAHEAD_S)
        lookahead = LOOKAHEAD_RATIO * stop + 2.0 * required
        scans = ScanHistory(
            near=2.0 * lookahead, apart=max(required, 4.0 * cell_size), noise=lidar.noise_m
        )
        surfaces = SurfacePoints.none(cell_size, lidar.noise_m)
        return cls(
            world, world, surfaces, scans, robot.outer_radius, robot.inner_radius, robot.footprint,
            lookahead, world,
        )  # fmt: skip

    @property
    def cell_size(self) -> float:
        """Size of the smallest thing that counts: the radius of the discs on surfaces [m]."""
        return self.surfaces.cell_size

    def with_scan(self, scan: Scan, standing: Flags | None = None) -> tuple[Belief, News]:
        """What is known after one more scan, and what is new about it.

        Args:
            scan: A look round.
            standing: Which of its hits show what stands, shape (h,). None: all of them.
        """
        hits, before = scan.hits, self.surfaces.hits
        if standing is not None:
            hits = hits[standing]
        surfaces = self.surfaces
        strange = np.ones(len(hits), np.bool_)
        if len(self.world) and len(hits):
            distance, index = self.world.nearest(hits)
            seen = index >= len(self.map)
            strange = distance > np.where(seen, 0.0, ON_MAP_M) + surfaces.tolerance
            known = seen & ~strange
            surfaces = surfaces.confirmed(scan, hits[known], index[known] - len(self.map))
        surfaces, moved = surfaces.put_right(before)
        surfaces, new = surfaces.with_hits(hits[strange])
        surfaces, gone = surfaces.without_seen_through(scan)
        belief = replace(self, surfaces=surfaces, scans=self.scans.with_scan(scan))
        latest = len(self.world) - len(self.settled) + len(new)
        if moved or gone or latest > MAX_LOOSE_DISCS:
            belief = belief._packed()
        elif new:
            loose = surfaces.obstacles[-latest:]
            world = self.settled.with_discs(loose, surfaces.discs[-latest:])
            belief = replace(belief, world=world)
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
        if self.footprint is not None:
            count = self._body_seen(self.footprint, path, start, along, floor)
            return float(along[count - 1]) if count else start
        u = np.asarray(path.parameter(along))
        places = np.asarray(path.evaluate(u))[:, :2]
        tangents = np.asarray(path.tangent(u))[:, :2]
        # beams end at surfaces, which lie inside of the discs that the path keeps clear of
        rim = min(
            self.body + BODY_RIM_RATIO * self.cell_size,
            floor + VISIBLE_DEPTH_RATIO * self.cell_size,
        )
        count = self.scans.count(places, tangents, rim, PLACE_SPACING_RATIO * self.cell_size)
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
        if self.footprint is not None:
            gap = max(floor - SAMPLE_SLACK_M - self.inner, LEAST_KEPT_M)
            count = clear_places(self.world, path, start, along, outline(self.footprint), gap)
            return float(along[count - 1]) if count else start
        near = np.flatnonzero(self.world.distance(path.at_distance(along)) < floor - SAMPLE_SLACK_M)
        if not near.size:
            return end
        return float(along[near[0] - 1]) if near[0] else start

    def _body_seen(
        self, footprint: Footprint, path: Path, start: float, along: Floats, floor: float
    ) -> int:
        """How many places of a path a polygon can take inside of what was seen, from the first."""
        gap = PLACE_SPACING_RATIO * self.cell_size
        kept = max(floor - self.inner, 0.0)
        margin = min(BODY_RIM_RATIO * self.cell_size, kept + VISIBLE_DEPTH_RATIO * self.cell_size)
        motion = body_motion(path, start, along, self.body, gap)
        count = self.scans.body_count(motion, body_rim(footprint, margin, gap))
        return int(motion.owners[count]) if count < len(motion.owners) else len(along)

    def _along(self, path: Path, start: float, end: float) -> Floats:
        """Places along a path, the same for every start: multiples of a length, and the end."""
        step = PLACE_SPACING_RATIO * self.cell_size
        places = step * np.arange(np.ceil(start / step), np.ceil(end / step))
        return np.append(places[places < end], end)

    def with_obstacles(self, obstacles: Iterable[Obstacle]) -> Belief:
        """What is known with more obstacles on the map."""
        return replace(self, map=self.map.with_obstacles(obstacles))._packed()

    def _packed(self) -> Belief:
        settled = self.map.with_discs(self.surfaces.obstacles, self.surfaces.discs)
        return replace(self, settled=settled, world=settled)
