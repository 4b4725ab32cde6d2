"""The best curve inside of half-planes, by Ipopt.

Unknown are place, heading, curvature and squared speed at every node, and the length of each leg;
between nodes the curvature changes evenly.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import casadi as ca
import numpy as np
from curve_nodes import MAX_TURN_RAD, Nodes, Task, line_length
from driving_time import DrivingLimits
from half_planes import HalfPlanes

BEND_WEIGHT = 1e-4  # of a change of curvature, beside the time or the length
SLOWEST = 1e-8  # v², as a share of the greatest: that of a rest
OPTIONS = {
    "print_time": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.max_iter": 150,
    "ipopt.tol": 1e-6,
    "ipopt.acceptable_tol": 1e-5,
    "ipopt.acceptable_iter": 5,
    "ipopt.mu_init": 1e-3,
    "ipopt.bound_relax_factor": 1e-9,
}


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


@dataclass(frozen=True, kw_only=True)
class Unknowns:
    """A curve and the drive on it in symbols; attributes as those of nodes, (n, 1) and (k, 1)."""

    x: ca.SX
    y: ca.SX
    headings: ca.SX
    curvature: ca.SX
    squares: ca.SX  # as a share of the greatest
    legs: ca.SX

    @classmethod
    def like(cls, nodes: Nodes) -> Unknowns:
        """As many as a curve has nodes."""
        count = len(nodes.points)
        names = ("x", "y", "headings", "curvature", "squares")
        symbols = {name: ca.SX.sym(name, count) for name in names}
        return cls(**symbols, legs=ca.SX.sym("legs", len(nodes.legs)))

    @property
    def column(self) -> ca.SX:
        """All of them."""
        return ca.vertcat(self.x, self.y, self.headings, self.curvature, self.squares, self.legs)

    def drive(self, nodes: Nodes, top: float) -> Drive:
        """The drive on it, the greatest squared speed given [m²/s²]."""
        owner = np.repeat(np.arange(len(nodes.legs)), np.diff(nodes.vias)).tolist()
        steps = self.legs[owner, 0] * ca.DM(nodes.shares)
        return Drive(bend=self.curvature, squares=self.squares * top, steps=steps)


def solved(task: Task, nodes: Nodes, aim: Aim) -> tuple[Nodes | None, float]:
    """The best curve in the half-planes about a curve, and its cost; None where Ipopt fails."""
    unknowns, top = Unknowns.like(nodes), task.limits.speed**2
    drive = unknowns.drive(nodes, top)
    rows = list(_rows(task, nodes, aim, unknowns, drive))
    weight = BEND_WEIGHT * task.space.required**4 / sum(map(line_length, task.legs))
    cost = aim.cost(drive) + weight * ca.sum1(ca.diff(drive.bend) ** 2 / drive.steps)
    held = ca.vertcat(*(row for row, _, _ in rows))
    solver = ca.nlpsol("best", "ipopt", {"x": unknowns.column, "f": cost, "g": held}, OPTIONS)
    low, high = _bounds(task, nodes)
    least, most = (
        np.concatenate([np.broadcast_to(row[k], row[0].shape[0]) for row in rows]) for k in (1, 2)
    )
    begun = np.clip(_values(nodes, top), low, high)
    found = solver(x0=begun, lbx=low, ubx=high, lbg=least, ubg=most)
    if not solver.stats()["success"]:
        return None, math.inf
    return _unpacked(nodes, np.array(found["x"]).ravel(), top), float(found["f"])


def _values(nodes: Nodes, top: float) -> np.ndarray:
    """Of the unknowns, in their order."""
    squares = nodes.squares / top
    return np.concatenate((*nodes.points.T, nodes.headings, nodes.curvature, squares, nodes.legs))


def _unpacked(nodes: Nodes, values: np.ndarray, top: float) -> Nodes:
    count = len(nodes.points)
    x, y, headings, curvature, squares = values[: 5 * count].reshape(5, count)
    return replace(
        nodes, points=np.column_stack((x, y)), headings=headings, curvature=curvature,
        squares=squares * top, legs=values[5 * count :],
    )  # fmt: skip


def _rows(task: Task, nodes: Nodes, aim: Aim, unknowns: Unknowns, drive: Drive):
    """What has to lie between two bounds, each with these."""
    yield from _integrated(unknowns, drive.steps)
    yield from _driveable(drive, task.limits)
    yield from _free(task, nodes, unknowns, drive.steps)
    if task.closed:
        whole = round((nodes.headings[-1] - nodes.headings[0]) / math.tau)
        yield unknowns.headings[-1] - unknowns.headings[0] - math.tau * whole, 0.0, 0.0
        yield drive.bend[-1] - drive.bend[0], 0.0, 0.0
    if aim.most_time < math.inf:
        yield drive.time / aim.most_time, -np.inf, 1.0


def _integrated(unknowns: Unknowns, steps):
    """From node to node along a curve whose curvature changes evenly; positions by Simpson."""
    heading, bend = unknowns.headings, unknowns.curvature
    middle = heading[:-1] + steps * (3.0 * bend[:-1] + bend[1:]) / 8.0
    turned = heading[:-1] + steps * (bend[:-1] + bend[1:]) / 2.0
    yield heading[1:] - turned, 0.0, 0.0
    for place, part in ((unknowns.x, ca.cos), (unknowns.y, ca.sin)):
        mean = (part(heading[:-1]) + 4.0 * part(middle) + part(heading[1:])) / 6.0
        yield ca.diff(place) - steps * mean, 0.0, 0.0


def _driveable(drive: Drive, limits: DrivingLimits):
    """Within the limits along the path and across it, and no tighter than nodes can tell."""
    change, bend = ca.diff(drive.squares), drive.bend
    yield change - 2.0 * limits.accel * drive.steps, -np.inf, 0.0
    yield change + 2.0 * limits.brake * drive.steps, 0.0, np.inf
    yield bend * drive.squares, -limits.lateral, limits.lateral
    yield (bend[:-1] + bend[1:]) * drive.steps / 2.0, -MAX_TURN_RAD, MAX_TURN_RAD


def _free(task: Task, nodes: Nodes, unknowns: Unknowns, steps):
    """At every node, and half-way to the next, the half-planes of what is near."""
    planes = HalfPlanes.about(task.space, nodes.places)
    if len(planes.node):
        rows = planes.node.tolist()
        x = _with_middles(unknowns.x, ca.cos(unknowns.headings), steps)[rows, 0]
        y = _with_middles(unknowns.y, ca.sin(unknowns.headings), steps)[rows, 0]
        across = ca.DM(planes.normal[:, 0]) * x + ca.DM(planes.normal[:, 1]) * y
        yield across - ca.DM(planes.offset), -1e-9, np.inf


def _with_middles(place, tangent, steps):
    """A coordinate at the nodes, then half-way between them."""
    middle = 0.5 * (place[:-1] + place[1:]) + steps / 8.0 * (tangent[:-1] - tangent[1:])
    return ca.vertcat(place, middle)


def _bounds(task: Task, nodes: Nodes) -> tuple[np.ndarray, np.ndarray]:
    """Of the unknowns, in their order."""
    count, limits = len(nodes.points), task.limits
    low_place, high_place = _places(task, nodes)
    low_heading, high_heading = np.full(count, -np.inf), np.full(count, np.inf)
    for via, heading in task.headings.items():
        node = nodes.vias[via]
        turns = round((nodes.headings[node] - heading) / math.tau)
        low_heading[node] = high_heading[node] = heading + math.tau * turns
    bend, slow, fast = np.full(count, limits.curvature), np.full(count, SLOWEST), np.ones(count)
    fast[nodes.vias[list(task.rests)]] = SLOWEST
    return (
        np.concatenate((*low_place, low_heading, -bend, slow, 0.2 * nodes.legs)),
        np.concatenate((*high_place, high_heading, bend, fast, 5.0 * nodes.legs)),
    )


def _places(task: Task, nodes: Nodes) -> tuple[np.ndarray, np.ndarray]:
    """Where nodes may be [m]: near, inside of the bounds, and via points where they are, (2, n)."""
    trust, room, bounds = (
        HalfPlanes.trust(task.space),
        task.space.required,
        task.space.solids.bounds,
    )
    low = np.maximum(nodes.points - trust, np.add(bounds[:2], room))
    high = np.minimum(nodes.points + trust, np.subtract(bounds[2:], room))
    low[nodes.vias] = high[nodes.vias] = nodes.points[nodes.vias]
    return low.T, high.T
