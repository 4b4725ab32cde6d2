"""Measuring how a path drives, from its exact curve and its time law.

Tested through ``machine/test_drivability``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.curve.path import GUIDE, Path
from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve import curvature_profile as profile_kernels
from viaspline.kernels.curve.cusps import SAME_CUSP
from viaspline.kernels.timing import across
from viaspline.machine.drivability import (
    BENT_1PM,
    NEAR_CUSP_RAD,
    STRAIGHT_1PM,
    Drivability,
    NearCusp,
    PathPlace,
    SpotTurn,
)
from viaspline.machine.drivability_verdict import place_slip, reasons_against
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.turns_on_spot import (
    SAME_DISTANCE_M,
    beside_cusps_of,
    corners,
    cusps_of,
    seam_corner,
)
from viaspline.mission.robot_parts import RobotSpec
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import NOTHING, World


def drivability_of(
    path: Path, trajectory: Trajectory, robot: RobotSpec, world: World, *, closed: bool = False
) -> Drivability:
    """How a path drives.

    Args:
        path: What is driven.
        trajectory: Its time law, of all of it.
        robot: Its body, its drive and its limits.
        world: What stands beside the path; it gives places their names.
        closed: Whether the path goes on where it begins: then a corner at its seam counts.

    Example:
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.trajectory.retime import retime
        >>> bend = Path([[(0, 0), (0, 2.2), (1.8, 4), (4, 4)]], vias=[])
        >>> law = retime(bend, Limits(max_speed=2, max_accel=1, max_lateral_accel=0.5))
        >>> found = drivability_of(bend, law, RobotSpec(max_lateral_accel_mps2=0.5), World([]))
        >>> found.verdict, round(found.sharpest_radius, 2), round(found.max_lateral_accel, 2)
        ('good', 3.95, 0.48)
    """
    drive = _Drive(path, trajectory, robot, world, closed)
    sharpest, radius = drive.sharpest
    lateral, lateral_at = drive.largest(1.0)
    jumps, largest_jump, jump_at = drive.jumps
    limits = limits_of(robot)
    yaw_rate: tuple[float, PathPlace | None] = (0.0, None)
    if limits.max_yaw_rate is not None and path.dimension == 2:
        yaw_rate = drive.largest(0.5)
    turns, cusps = drive.turns, drive.near_cusps
    return Drivability(
        sharpest_radius=radius,
        sharpest=sharpest,
        least_radius=least_radius(robot),
        max_lateral_accel=lateral,
        max_lateral_at=lateral_at,
        curvature_jumps=jumps,
        largest_jump=largest_jump,
        largest_jump_at=jump_at,
        sign_changes=drive.sign_changes,
        near_cusps=cusps,
        turns_on_spot=turns,
        reasons=reasons_against(
            (radius, sharpest, least_radius(robot)), cusps, turns,
            limits, trajectory, (lateral, lateral_at), yaw_rate,
        ),
    )  # fmt: skip


def drivability_in_space(path: Path, trajectory: Trajectory, robot: RobotSpec) -> Drivability:
    """How a path in space flies; where it turns on the spot counts for nothing, for it hovers.

    Args:
        path: What is flown.
        trajectory: Its time law, of all of it.
        robot: Its body and its limits.

    Example:
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.trajectory.retime import retime
        >>> bend = Path([[(0, 0, 9), (0, 0.1, 9), (0, 0.1, 9), (0.1, 0.1, 9)]], vias=[])
        >>> law = retime(bend, Limits(max_speed=2, max_accel=1))
        >>> drivability_in_space(bend, law, RobotSpec(radius_m=0.3)).reasons[0].text
        "its sharpest bend has a radius of 0.027 m, less than the robot's own 0.3 m"
    """
    drive = _Drive(path, trajectory, robot, World([]), closed=False)
    sharpest, radius = drive.sharpest
    lateral, lateral_at = drive.largest(1.0)
    jumps, largest_jump, jump_at = drive.jumps
    cusps, least = drive.near_cusps, least_radius(robot)
    reasons = reasons_against(
        (radius, sharpest, least), cusps, (), limits_of(robot), trajectory, (lateral, lateral_at),
        (0.0, None),
    )  # fmt: skip
    return Drivability(
        radius, sharpest, least, lateral, lateral_at, jumps, largest_jump, jump_at, 0, cusps, (),
        reasons,
    )  # fmt: skip


def least_radius(robot: RobotSpec) -> float:
    """The least radius that is round enough for a robot [m]: its turning circle, else its body's.

    >>> least_radius(RobotSpec(radius_m=0.4)), least_radius(RobotSpec(min_turn_radius_m=2))
    (0.4, 2.0)
    """
    return robot.outer_radius if robot.turn_radius is None else robot.turn_radius


@dataclass(frozen=True)
class _Drive:
    """A path with its time law, and what is measured of them."""

    path: Path
    trajectory: Trajectory
    robot: RobotSpec
    world: World
    closed: bool

    @cached_property
    def nodes(self) -> Floats:
        """Rows of u, curvature and span, between which it only rises or falls, shape (n, 3)."""
        nodes = profile_kernels.curvature_profile(self.path.spans)
        nodes[np.abs(nodes[:, 1]) < STRAIGHT_1PM, 1] = 0.0
        return nodes

    @cached_property
    def cusps(self) -> Floats:
        """From where to where it turns on the spot inside of spans, as parameters, shape (k, 2)."""
        at = cusps_of(self.path)
        beside = beside_cusps_of(self.path, at)
        return np.column_stack((at - beside, at + beside))

    @cached_property
    def sharpest(self) -> tuple[PathPlace | None, float]:
        """Where the path is sharpest, and its radius there [m]."""
        u, bends = self.nodes[:, 0], np.abs(self.nodes[:, 1])
        for first, last in self.cusps:
            bends[(u >= first) & (u <= last)] = 0.0
        nearly = self.cusps[np.diff(self.cusps, axis=1)[:, 0] > 2.5 * SAME_CUSP].ravel()
        u = np.append(u, nearly)  # a path is sharpest where it turns, and next to that
        bends = np.append(bends, np.abs(self.path.curvature(nearly)))
        sharpest = int(np.argmax(bends))
        if bends[sharpest] == 0.0:
            return None, math.inf
        return self.place(float(u[sharpest])), 1.0 / float(bends[sharpest])

    @property
    def sign_changes(self) -> int:
        """How often it bends to one side and then to the other."""
        bends = self.nodes[:, 1][np.abs(self.nodes[:, 1]) > BENT_1PM]
        return int(np.count_nonzero(np.diff(np.sign(bends))))

    @property
    def jumps(self) -> tuple[int, float, PathPlace | None]:
        """How often the curvature jumps while driving, the largest jump [1/m], and where."""
        jumps = self.path.curvature_jumps()
        joints = np.arange(1.0, len(self.path.spans))
        stands = self.trajectory.speed_at(np.asarray(self.path.distance(joints))) == 0.0
        jumps = np.where(stands, 0.0, jumps)
        count = int(np.count_nonzero(jumps > BENT_1PM))
        if not count:
            return 0, 0.0, None
        at = int(np.argmax(jumps))
        return count, float(jumps[at]), self.place(float(joints[at]))

    @property
    def near_cusps(self) -> tuple[NearCusp, ...]:
        """Stretches that are sharper than the robot's own circle and turn far, but not at once."""
        radius = least_radius(self.robot)
        if radius <= 0.0 or self.sharpest[1] >= radius:
            return ()
        spans, nodes = self.path.spans, self.nodes
        rows = profile_kernels.sharp_stretches(spans, nodes, 1.0 / radius)
        found = []
        for first, last, peak, turn in rows[rows[:, profile_kernels.TURN] >= NEAR_CUSP_RAD]:
            if ((self.cusps[:, 0] >= first) & (self.cusps[:, 1] <= last)).any():
                continue
            length = float(self.path.distance(last) - self.path.distance(first))
            inside = (nodes[:, 0] >= first) & (nodes[:, 0] <= last) & (nodes[:, 1] == peak)
            u = float(nodes[inside][0, 0]) if inside.any() else float(first)
            found.append(NearCusp(float(turn), length, 1.0 / abs(float(peak)), self.place(u)))
        return tuple(found)

    @property
    def turns(self) -> tuple[SpotTurn, ...]:
        """Corners and cusps; that at the seam of a round is the last."""
        law = self.trajectory
        at, angles = corners(self.path)
        seam = seam_corner(self.path) if self.closed else 0.0
        if seam:
            at, angles = np.append(at, self.path.length), np.append(angles, seam)
        found = []
        for distance, angle in zip(at, angles, strict=True):
            near = [s.dwell for s in law.stations if abs(s.distance - distance) <= SAME_DISTANCE_M]
            found.append(
                SpotTurn(
                    turn=float(angle),
                    time=sum(near),
                    speed=self._slowest(float(distance)),
                    asked=self._is_asked(float(distance)),
                    place=self.place(self.path.parameter(distance)),
                )
            )
        return tuple(found)

    def _slowest(self, distance: float) -> float:
        """The least speed about a corner [m/s]: a cusp lies on a very short arc.

        What is at rest as near as places of the path are known is at rest.
        """
        around = np.concatenate((
            distance + SAME_DISTANCE_M * np.array([-1.0, 0.0, 1.0]),
            *(ends for ends in np.asarray(self.path.distance(self.cusps)).reshape(-1, 2)
              if ends[0] <= distance <= ends[1]),
        ))  # fmt: skip
        law = self.trajectory
        within = (law.distances >= around.min()) & (law.distances <= around.max())
        slowest = float(np.concatenate((law.speeds[within], law.speed_at(around))).min())
        accel = float(np.abs(law.accelerations).max(initial=0.0))
        return 0.0 if slowest**2 <= 2.0 * accel * place_slip(self.path.length) else slowest

    def _is_asked(self, distance: float) -> bool:
        where = self.robot.turns_on_spot
        return any(
            abs(at - distance) <= SAME_DISTANCE_M
            and (where == "vias" or (where == "stations" and via.dwell > 0.0))
            for via, at in self.path.stops
        )

    def largest(self, power: float) -> tuple[float, PathPlace | None]:
        """The largest curvature times v^(2 power), and where."""
        law = self.trajectory
        none = np.zeros(len(law.accelerations))
        pieces = np.column_stack((
            law.speeds[:-1], law.accelerations,
            none if law.changes is None else law.changes, none if law.jerks is None else law.jerks,
            np.diff(law.distances),
        ))  # fmt: skip
        bends = np.zeros(len(self.path.spans))
        np.maximum.at(bends, self.nodes[:, 2].astype(int), np.abs(self.nodes[:, 1]))
        if not bends.any():
            return 0.0, None
        slip = 2.0 * place_slip(self.path.length) * float(np.abs(law.accelerations).max())
        value, u = across.largest_across(self.path.spans, bends, pieces, self._cells, power, slip)
        return float(value), None if value == 0.0 else self.place(float(u))

    @cached_property
    def _cells(self) -> Floats:
        """Parts of the path that lie on one span and on one piece of the law, shape (n, 5).

        What it turns on the spot is none of it.
        """
        path, distances = self.path, self.trajectory.distances
        joints = np.concatenate((np.arange(len(path.spans) + 1.0), self.cusps.ravel()))
        at_joints = np.asarray(path.distance(joints))
        s = np.concatenate((distances, at_joints))
        u = np.concatenate((path.parameter(np.clip(distances, 0.0, path.length)), joints))
        order = np.argsort(u, kind="stable")
        s, u = s[order], u[order]
        turns = [(u[:-1] >= first) & (u[1:] <= last) for first, last in self.cusps]
        drives = ~np.any(turns, axis=0) if turns else True
        wide = np.flatnonzero((np.diff(u) > 0.0) & (np.diff(s) > 0.0) & drives)
        piece = np.searchsorted(distances, 0.5 * (s[wide] + s[wide + 1]), side="right") - 1
        piece = np.clip(piece, 0, len(distances) - 2)
        begin = distances[piece]
        return np.column_stack((piece, u[wide], u[wide + 1], s[wide] - begin, s[wide + 1] - begin))

    def place(self, u: float) -> PathPlace:
        """A place by its parameter."""
        at = tuple(self.path.evaluate(u).tolist())
        return PathPlace(float(self.path.distance(u)), at, self._near(at))

    def _near(self, at: tuple[float, ...]) -> str:
        vias = [via for via in self.path.vias if via.name != GUIDE]
        apart = [math.dist(via.at[:2], at[:2]) for via in vias]
        gaps, index = self.world.nearest([at[:2]])
        obstacle = "" if int(index[0]) == NOTHING else self.world.name(int(index[0]))
        if not vias:
            return obstacle
        nearest = int(np.argmin(apart))
        if vias[nearest].kind == "user" and (not obstacle or apart[nearest] <= gaps[0]):
            return str(vias[nearest].name)
        detour = vias[nearest].kind == "detour" and apart[nearest] <= gaps[0]
        if detour and not obstacle:
            return "a detour point"
        return f"a detour point beside {obstacle}" if detour else obstacle
