"""What curve is asked for, and a curve at its nodes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from driving_time import DrivingLimits, squares_of_speed
from free_space import FreeSpace

MOST_NODES = 600
MAX_TURN_RAD = 0.5  # from node to node
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
    def places(self) -> np.ndarray:
        """The nodes, then what lies half-way between them [m], (2n - 1, 2)."""
        tangents = np.column_stack((np.cos(self.headings), np.sin(self.headings)))
        bulge = self.steps[:, None] / 8.0 * (tangents[:-1] - tangents[1:])
        return np.vstack((self.points, 0.5 * (self.points[:-1] + self.points[1:]) + bulge))

    @property
    def line(self) -> np.ndarray:
        """The same in their order [m], (2n - 1, 2)."""
        count = len(self.points)
        line = np.empty((2 * count - 1, 2))
        line[::2], line[1::2] = self.places[:count], self.places[count:]
        return line

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


def start_nodes(task: Task) -> Nodes:
    """The curve that is begun with."""
    longest = max(task.space.required / 3.0, sum(map(line_length, task.legs)) / MOST_NODES)
    rows, shares, vias = [task.legs[0][:1]], [], [0]
    for leg in task.legs:
        share = _graded(line_length(leg), longest)
        at = np.r_[0.0, np.cumsum(np.hypot(*np.diff(leg, axis=0).T))]
        wanted = np.cumsum(share) * at[-1]
        wanted[-1] = at[-1]
        rows.append(np.column_stack([np.interp(wanted, at, leg[:, k]) for k in (0, 1)]))
        shares.append(share)
        vias.append(vias[-1] + len(share))
    points, along = np.vstack(rows), np.concatenate(shares)
    lengths = np.array([line_length(leg) for leg in task.legs])
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


def timed(task: Task, nodes: Nodes) -> Nodes:
    """The same curve, driven as fast as it can be."""
    rests = np.zeros(len(nodes.points), bool)
    rests[nodes.vias[list(task.rests)]] = True
    squares = squares_of_speed(nodes.steps, nodes.curvature, rests, task.limits)
    return replace(nodes, squares=squares)


def line_length(line: np.ndarray) -> float:
    """Of a polyline [m]."""
    return float(np.hypot(*np.diff(line, axis=0).T).sum())
