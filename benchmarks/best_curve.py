"""The best curve of a kind, by a slow optimiser that shares nothing with the planner.

Direct collocation: places, heading, curvature and squared speed at hundreds of nodes, between which
the curvature changes evenly. Free space is a row of half-planes at each node, one for each convex
obstacle near it, square to its nearest point: all that lies in them is free. Ipopt solves that, the
half-planes are laid anew at what it finds, and so on: nothing gets worse, until nothing gets
better. The homotopy class is that of the curve it begins with.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import casadi as ca
import numpy as np
from driving_time import DrivingLimits, squares_of_speed
from free_space import FreeSpace
from half_planes import HalfPlanes

MOST_NODES = 600
MAX_ROUNDS = 25
BEND_WEIGHT = 1e-4  # of a change of curvature, beside the time or the length
TIME_GIVEN = 2e-3  # of the least time, for a gentler curve
MAX_TURN_RAD = 0.5  # from node to node
SLOWEST = 1e-8  # v², as a share of the greatest: that of a rest
FINEST, GROWTH = 0.1, 1.25  # of the steps beside a via point, as shares of the longest


@dataclass(frozen=True, kw_only=True)
class Task:
    """What is asked for.

    Attributes:
        space: Where it may go.
        legs: A curve of the kind that is asked for, from each via point to the next [m], (n, 2).
        rests: True for each via point at which the robot stands still; start and goal first, last.
        limits: Of the robot.
        headings: By the via point's index, where they are given [rad].
        closed: Whether it comes back to its start, smoothly.
    """

    space: FreeSpace
    legs: tuple[np.ndarray, ...]
    rests: tuple[bool, ...]
    limits: DrivingLimits
    headings: dict[int, float]
    closed: bool = False


@dataclass(frozen=True, kw_only=True)
class Nodes:
    """A curve at its nodes; the curvature changes evenly in between.

    Attributes:
        points: [m], (n, 2).
        headings: [rad], (n,).
        curvature: [1/m], (n,).
        squares: Of the speed [m²/s²], (n,).
        legs: Length of each leg [m], (k,).
        shares: Of its leg's length that each step is, (n - 1,).
        vias: Index of every via point's node, (k + 1,).
    """

    points: np.ndarray
    headings: np.ndarray
    curvature: np.ndarray
    squares: np.ndarray
    legs: np.ndarray
    shares: np.ndarray
    vias: np.ndarray

    @property
    def steps(self) -> np.ndarray:
        """From each node to the next [m], (n - 1,)."""
        return np.repeat(self.legs, np.diff(self.vias)) * self.shares

    @property
    def length(self) -> float:
        """[m]."""
        return float(self.legs.sum())

    @property
    def peak(self) -> float:
        """The largest curvature, either way [1/m]."""
        return float(np.abs(self.curvature).max())

    @property
    def bending(self) -> float:
        """The integral of the squared curvature along the curve [1/m], exact."""
        a, b = self.curvature[:-1], self.curvature[1:]
        return float((self.steps * (a * a + a * b + b * b)).sum() / 3.0)

    @property
    def time(self) -> float:
        """[s]."""
        speeds = np.sqrt(np.maximum(self.squares, 0.0))
        return float((2.0 * self.steps / (speeds[:-1] + speeds[1:])).sum())


@dataclass(frozen=True, kw_only=True)
class Drive:
    """A drive in symbols.

    Attributes:
        bend: Curvature at every node, (n, 1).
        squares: Of the speed, (n, 1).
        steps: (n - 1, 1).
    """

    bend: ca.SX
    squares: ca.SX
    steps: ca.SX

    @property
    def time(self) -> ca.SX:
        """[s]."""
        speeds = ca.sqrt(self.squares)
        return ca.sum1(2.0 * self.steps / (speeds[:-1] + speeds[1:]))

    @property
    def length(self) -> ca.SX:
        """[m]."""
        return ca.sum1(self.steps)

    @property
    def bending(self) -> ca.SX:
        """The integral of the squared curvature [1/m]."""
        a, b = self.bend[:-1], self.bend[1:]
        return ca.sum1(self.steps * (a * a + a * b + b * b)) / 3.0


@dataclass(frozen=True, kw_only=True)
class Aim:
    """What is looked for.

    Attributes:
        cost: Of a drive; the least, about 1 at first.
        most_time: That the drive may take [s].
        least_gain: Of a round that is followed by another.
    """

    cost: Callable[[Drive], ca.SX]
    most_time: float = math.inf
    least_gain: float = 5e-5


def fastest(task: Task) -> Nodes:
    """The curve that is driven in the least time."""
    first = start_nodes(task)
    return _improved(task, first, Aim(cost=lambda drive: drive.time / first.time))


def shortest(task: Task) -> Nodes:
    """The shortest curve, in which the speed has no part but to be told."""
    first = start_nodes(task)
    return _improved(task, first, Aim(cost=lambda drive: drive.length / first.length))


def gentlest(task: Task, fast: Nodes) -> Nodes:
    """The curve that bends least of those that take hardly longer than the fastest."""
    most = (1.0 + TIME_GIVEN) * fast.time
    bending = max(fast.bending, 1e-6)
    aim = Aim(cost=lambda drive: drive.bending / bending, most_time=most, least_gain=1e-2)
    return _improved(task, fast, aim)


def start_nodes(task: Task) -> Nodes:
    """The curve that is begun with."""
    longest = max(task.space.required / 3.0, sum(map(_long, task.legs)) / MOST_NODES)
    rows, shares, vias = [task.legs[0][:1]], [], [0]
    for leg in task.legs:
        share = _graded(_long(leg), longest)
        at = np.r_[0.0, np.cumsum(np.hypot(*np.diff(leg, axis=0).T))]
        wanted = np.cumsum(share) * at[-1]
        wanted[-1] = at[-1]
        rows.append(np.column_stack([np.interp(wanted, at, leg[:, k]) for k in (0, 1)]))
        shares.append(share)
        vias.append(vias[-1] + len(share))
    points, along = np.vstack(rows), np.concatenate(shares)
    lengths = np.array([_long(leg) for leg in task.legs])
    steps = np.repeat(lengths, np.diff(vias)) * along
    chords = np.unwrap(np.arctan2(*np.diff(points, axis=0).T[::-1]))
    headings = np.r_[chords[0], 0.5 * (chords[:-1] + chords[1:]), chords[-1]]
    bound = np.minimum(task.limits.curvature, MAX_TURN_RAD / np.r_[steps, steps[-1]])
    curvature = np.clip(np.gradient(headings, np.r_[0.0, np.cumsum(steps)]), -bound, bound)
    nodes = Nodes(
        points=points, headings=headings, curvature=curvature, squares=np.zeros(len(points)),
        legs=lengths, shares=along, vias=np.array(vias),
    )  # fmt: skip
    return timed(task, nodes)


def _graded(length: float, longest: float) -> np.ndarray:
    """Steps of a leg as shares of its length, short beside its ends."""
    sizes: list[float] = []
    size, covered = FINEST, 0.0
    while covered < 0.5 * length / longest:
        sizes.append(size)
        covered += size
        size = min(1.0, size * GROWTH)
    steps = np.array(sizes + sizes[::-1])
    return steps / steps.sum()


class UnsolvedError(Exception):
    """Ipopt found nothing in the free space about the curve that was begun with."""


def _improved(task: Task, first: Nodes, aim: Aim) -> Nodes:
    found, cost = None, math.inf
    for _ in range(MAX_ROUNDS):
        better, reached = _solved(task, found or first, aim)
        if better is None:
            break
        found = better
        if cost - reached < aim.least_gain * reached:
            break
        cost = reached
    if found is None:
        raise UnsolvedError
    return timed(task, found)


def timed(task: Task, nodes: Nodes) -> Nodes:
    """The same curve, driven as fast as it can be."""
    rests = np.zeros(len(nodes.points), bool)
    rests[nodes.vias[list(task.rests)]] = True
    squares = squares_of_speed(nodes.steps, nodes.curvature, rests, task.limits)
    return replace(nodes, squares=squares)


def _solved(task: Task, nodes: Nodes, aim: Aim) -> tuple[Nodes | None, float]:
    """The best curve in the half-planes about a curve, and its cost; None where Ipopt fails."""
    count = len(nodes.points)
    x, y, heading, bend, square = (ca.SX.sym(name, count) for name in ("x", "y", "t", "k", "q"))
    legs = ca.SX.sym("l", len(task.legs))
    top = task.limits.speed**2
    owner = np.repeat(np.arange(len(task.legs)), np.diff(nodes.vias))
    steps = legs[owner.tolist(), 0] * ca.DM(nodes.shares)
    rows = [
        *_integrated(x, y, heading, bend, steps),
        *_driveable(bend, square * top, steps, task.limits),
        *_free(task, nodes, x, y),
    ]
    if task.closed:
        turned = 2.0 * math.pi * round((nodes.headings[-1] - nodes.headings[0]) / (2.0 * math.pi))
        rows.append((heading[-1] - heading[0] - turned, 0.0, 0.0))
        rows.append((bend[-1] - bend[0], 0.0, 0.0))
    drive = Drive(bend=bend, squares=square * top, steps=steps)
    if aim.most_time < math.inf:
        rows.append((drive.time / aim.most_time, -np.inf, 1.0))
    weight = BEND_WEIGHT * task.space.required**4 / sum(map(_long, task.legs))
    cost = aim.cost(drive) + weight * ca.sum1(ca.diff(bend) ** 2 / steps)
    unknown = ca.vertcat(x, y, heading, bend, square, legs)
    values = np.concatenate((
        nodes.points[:, 0], nodes.points[:, 1], nodes.headings, nodes.curvature,
        nodes.squares / top, nodes.legs,
    ))  # fmt: skip
    low, high = _bounds(task, nodes)
    solver = ca.nlpsol(
        "best", "ipopt",
        {"x": unknown, "f": cost, "g": ca.vertcat(*(row[0] for row in rows))},
        {"ipopt.print_level": 0, "print_time": False, "ipopt.sb": "yes", "ipopt.max_iter": 150,
         "ipopt.tol": 1e-6, "ipopt.acceptable_tol": 1e-5, "ipopt.acceptable_iter": 5,
         "ipopt.mu_init": 1e-3, "ipopt.bound_relax_factor": 1e-9},
    )  # fmt: skip
    lower, upper = (
        np.concatenate([np.broadcast_to(row[k], row[0].shape[0]) for row in rows]) for k in (1, 2)
    )
    found = solver(x0=np.clip(values, low, high), lbx=low, ubx=high, lbg=lower, ubg=upper)
    if not solver.stats()["success"]:
        return None, math.inf
    return _unpacked(nodes, np.array(found["x"]).ravel(), top), float(found["f"])


def _unpacked(nodes: Nodes, values: np.ndarray, top: float) -> Nodes:
    count = len(nodes.points)
    x, y, headings, curvature, squares = values[: 5 * count].reshape(5, count)
    return replace(
        nodes, points=np.column_stack((x, y)), headings=headings, curvature=curvature,
        squares=squares * top, legs=values[5 * count :],
    )  # fmt: skip


def _integrated(x, y, heading, bend, steps):
    """From node to node along a curve whose curvature changes evenly; positions by Simpson."""
    middle = heading[:-1] + steps * (3.0 * bend[:-1] + bend[1:]) / 8.0
    turned = heading[:-1] + steps * (bend[:-1] + bend[1:]) / 2.0
    yield heading[1:] - turned, 0.0, 0.0
    for place, part in ((x, ca.cos), (y, ca.sin)):
        mean = (part(heading[:-1]) + 4.0 * part(middle) + part(heading[1:])) / 6.0
        yield ca.diff(place) - steps * mean, 0.0, 0.0


def _driveable(bend, squares, steps, limits: DrivingLimits):
    """Within the limits along the path and across it, and no tighter than nodes can tell."""
    change = ca.diff(squares)
    yield change - 2.0 * limits.accel * steps, -np.inf, 0.0
    yield change + 2.0 * limits.brake * steps, 0.0, np.inf
    yield bend * squares, -limits.lateral, limits.lateral
    yield (bend[:-1] + bend[1:]) * steps / 2.0, -MAX_TURN_RAD, MAX_TURN_RAD


def _free(task: Task, nodes: Nodes, x, y):
    """At every node the half-planes of what is near."""
    planes = HalfPlanes.about(task.space, nodes.points)
    if len(planes.node):
        node = planes.node.tolist()
        across = ca.DM(planes.normal[:, 0]) * x[node, 0] + ca.DM(planes.normal[:, 1]) * y[node, 0]
        yield across - ca.DM(planes.offset), -1e-9, np.inf


def _bounds(task: Task, nodes: Nodes) -> tuple[np.ndarray, np.ndarray]:
    """Of the unknowns: via points stay where they are, and nodes within what was looked at."""
    count, trust = len(nodes.points), HalfPlanes.trust(task.space)
    away = np.full(count, trust)
    away[nodes.vias] = 0.0
    top = np.ones(count)
    top[nodes.vias[list(task.rests)]] = SLOWEST
    x0, y0, x1, y1 = task.space.solids.bounds
    room = task.space.required
    turn = np.full(count, np.inf)
    low_turn, high_turn = -turn, turn
    for via, heading in task.headings.items():
        here = nodes.headings[nodes.vias[via]]
        asked = heading + 2.0 * math.pi * round((here - heading) / (2.0 * math.pi))
        low_turn[nodes.vias[via]] = high_turn[nodes.vias[via]] = asked
    x, y = nodes.points.T
    vias = away == 0.0
    low_x, high_x = np.maximum(x - away, x0 + room), np.minimum(x + away, x1 - room)
    low_y, high_y = np.maximum(y - away, y0 + room), np.minimum(y + away, y1 - room)
    for low, high, at in ((low_x, high_x, x), (low_y, high_y, y)):
        low[vias] = high[vias] = at[vias]
    tight = np.full(count, task.limits.curvature)
    slow = np.full(count, SLOWEST)
    return (
        np.concatenate((low_x, low_y, low_turn, -tight, slow, 0.2 * nodes.legs)),
        np.concatenate((high_x, high_y, high_turn, tight, top, 5.0 * nodes.legs)),
    )


def _long(line: np.ndarray) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def legs_of(points: np.ndarray, vias: np.ndarray) -> tuple[np.ndarray, ...]:
    """A polyline cut at indices of its points."""
    return tuple(points[a : b + 1] for a, b in pairwise(vias.tolist()))
