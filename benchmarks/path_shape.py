"""The shape of a curve: what its control polygons say, without the package's own report.

Samples lie as close as the curve turns: between two of them it turns by ``MAX_TURN_RAD`` at most
(but for corners and cusps). Both sides of every joint are sampled.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

FIRST_PIECES = 64  # of a span, before it is looked at where it turns
MAX_TURN_RAD = 0.01
MAX_HALVINGS = 30
STANDING = 1e-7  # of a span's greatest speed in its parameter: less has no direction
CORNER_RAD = 0.05  # between samples that lie as close as they can
NEAR_TURN_RAD = math.radians(143.0)
NEAR_TURN_SHARE = 1.0 / 200.0  # of a span's length


@dataclass(frozen=True)
class Shape:
    """A curve as points close together.

    Attributes:
        points: [m], shape (n, 2).
        headings: Unwound [rad], shape (n,).
        curvature: Signed, left is positive [1/m], shape (n,).
        along: Distance from the start [m], shape (n,).
        span: Index of the cubic that each point lies on; one that is a place has none, (n,).
    """

    points: np.ndarray
    headings: np.ndarray
    curvature: np.ndarray
    along: np.ndarray
    span: np.ndarray

    @classmethod
    def of(cls, spans: np.ndarray) -> Shape:
        """The shape of Bézier control polygons [m], (m, 4, 2)."""
        spans = np.asarray(spans, float)[..., :2]
        moving = np.flatnonzero(np.ptp(spans, axis=1).max(axis=1) > 0.0)
        rows = [_sampled(spans[k]) for k in moving]
        points, headings, curvature = (np.concatenate(part) for part in zip(*rows, strict=True))
        owner = np.repeat(moving, [len(row[0]) for row in rows])
        return cls(points, np.unwrap(headings), curvature, _travelled(points), owner)

    @property
    def length(self) -> float:
        """[m]."""
        return float(self.along[-1])

    @property
    def peak(self) -> float:
        """The largest curvature, either way [1/m]."""
        return float(np.abs(self.curvature).max())

    @cached_property
    def bending(self) -> float:
        """The integral of the squared curvature along the curve [1/m]."""
        return float(np.trapezoid(self.curvature**2, self.along))

    @property
    def corners(self) -> int:
        """Places at which the heading jumps."""
        return int(np.count_nonzero(np.abs(np.diff(self.headings)) > CORNER_RAD))

    def is_sharper(self, radius: float) -> bool:
        """Whether it bends more tightly than a circle [m] anywhere, or has a corner."""
        return self.corners > 0 or self.peak > 1.0 / radius

    def sign_changes(self, threshold: float = 0.02) -> int:
        """How often it turns the other way, bends of less than ``threshold`` [1/m] left out."""
        turning = self.curvature[np.abs(self.curvature) > threshold]
        return int(np.count_nonzero(np.diff(np.sign(turning))))

    def near_turns(self) -> int:
        """Spans that nearly turn back on themselves within a small share of their length."""
        return sum(self._turns_back(k) for k in range(int(self.span[-1]) + 1))

    def _turns_back(self, k: int) -> bool:
        here = self.span == k
        along, headings = self.along[here], self.headings[here]
        window = NEAR_TURN_SHARE * (along[-1] - along[0])
        later = np.interp(along + window, along, headings)
        return bool(np.abs(later - headings).max() >= NEAR_TURN_RAD)


def turning_sides(points: np.ndarray, least: float = math.radians(1.0)) -> int:
    """How often a polyline turns the other way, turns of less than ``least`` [rad] left out."""
    steps = np.diff(np.asarray(points, float), axis=0)
    steps = steps[np.hypot(*steps.T) > 1e-9]
    headings = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    changes, side, extreme = 0, 0, headings[0]
    for heading in headings[1:]:
        turned = heading - extreme
        if side * turned > 0.0:
            extreme = heading
        elif abs(turned) > least:
            changes += side != 0
            side, extreme = int(np.sign(turned)), heading
    return changes


def _sampled(span: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points, headings and curvatures along one cubic."""
    w = np.linspace(0.0, 1.0, FIRST_PIECES + 1)
    for _ in range(MAX_HALVINGS):
        first = _tangents(span, w)
        speed = np.hypot(*first.T)
        tells = speed > STANDING * speed.max()
        turn = np.abs(_between(first[:-1], first[1:]))
        wide = (turn > MAX_TURN_RAD) & tells[:-1] & tells[1:]
        if not wide.any():
            break
        w = np.sort(np.concatenate((w, 0.5 * (w[:-1] + w[1:])[wide])))
    v = 1.0 - w[:, None]
    u = w[:, None]
    a, b, c, d = span
    points = v**3 * a + 3 * v * v * u * b + 3 * v * u * u * c + u**3 * d
    first = _tangents(span, w)
    second = 6.0 * (v * (c - 2 * b + a) + u * (d - 2 * c + b))
    speed = np.hypot(*first.T)
    rows = _moving(speed)  # where it stands still, heading and curvature are those beside it
    first, second, speed = first[rows], second[rows], speed[rows]
    cross = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    return points, np.arctan2(first[:, 1], first[:, 0]), cross / speed**3


def _moving(speed: np.ndarray) -> np.ndarray:
    """For every sample itself, or the nearest at which the curve moves, (n,)."""
    moving = np.flatnonzero(speed > STANDING * speed.max())
    here = np.arange(len(speed))
    after = np.minimum(np.searchsorted(moving, here), len(moving) - 1)
    before = np.maximum(after - 1, 0)
    nearer = np.abs(moving[before] - here) < np.abs(moving[after] - here)
    return moving[np.where(nearer, before, after)]


def _tangents(span: np.ndarray, w: np.ndarray) -> np.ndarray:
    a, b, c, d = span
    u = w[:, None]
    v = 1.0 - u
    return 3.0 * (v * v * (b - a) + 2 * v * u * (c - b) + u * u * (d - c))


def _between(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Signed angles from one row of vectors to another [rad]."""
    cross = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    return np.arctan2(cross, (one * other).sum(axis=1))


def _travelled(points: np.ndarray) -> np.ndarray:
    return np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
