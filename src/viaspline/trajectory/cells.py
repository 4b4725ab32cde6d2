"""Tangent, curvature and change of heading along a curve, cell by cell, with their errors.

Tested through ``trajectory/test_coupled``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.timing import cut_cells as kernels
from viaspline.kernels.timing.cell_frames import fill_cells

MIN_SAMPLES = 1000
"""Number of cells of a curve that is only known by its values."""

ERROR_SAFETY = 1.5
"""What is measured of an error is taken so many times."""

MAX_CELL_TURN_RAD = 0.1  # turn of the heading of a curve in space within one cell [rad]
MIN_CELL = 1e-7  # cell that is cut for it, in its span's parameter
CELL_HALVINGS = 24
_PLACES = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
_BOOLE = np.array([7.0, 32.0, 12.0, 32.0, 7.0]) / 90.0


class Evaluable(Protocol):
    """Any curve that can be evaluated."""

    @property
    def domain(self) -> tuple[float, float]:
        """First and last parameter."""

    def evaluate(self, u: ArrayLike, derivative: int = 0) -> Floats:
        """Points or derivatives at parameters (n,), shape (n, d)."""


@dataclass(frozen=True, kw_only=True)
class CellSize:
    """How fine the cells have to be.

    Attributes:
        longest: No cell is longer [m].
        least: A cell that is shorter is fine enough [m].
        accel: Bound of the acceleration along the curve [m/s²].
        square: Bound of v² [m²/s²].
        axis: The least acceleration that is allowed along an axis or across the path [m/s²]; inf
            if there is no limit.
        yaw_accel: [rad/s²]; inf if there is no limit.
        heading: Whether a limit asks for the change of the heading.
    """

    longest: float
    least: float
    accel: float
    square: float
    axis: float = np.inf
    yaw_accel: float = np.inf
    heading: bool = False


@dataclass(frozen=True)
class Cells:
    """A curve in short pieces: T, K = dT/ds and heading as quadratics of the distance.

    Attributes:
        along: Ends of the cells as distances along the curve [m], shape (n + 1,).
        tangents: Bernstein coefficients of T, shape (n, d, 3).
        bends: Of K [1/m], shape (n, d, 3).
        yaws: Of dψ/ds [1/m] and d²ψ/ds² [1/m²] of the heading ψ over the ground, shape (n, 2, 3);
            (0, 2, 3) if it was not asked for.
        misses: What T, K, dψ/ds and d²ψ/ds² miss at most, shape (n, 4): proven for cubics in the
            plane, measured for the headings of curves in space and for sampled curves.
        rests: Ends of cells at which the curve has a corner or a cusp, shape (n + 1,).
    """

    along: Floats
    tangents: Floats
    bends: Floats
    yaws: Floats
    misses: Floats
    rests: Flags

    @property
    def jumps(self) -> Floats:
        """How far dψ/ds jumps at the inner ends of the cells [1/m], shape (n - 1,)."""
        return np.asarray(np.abs(self.yaws[1:, 0, 0] - self.yaws[:-1, 0, 2]))


def cubic_cells(spans: Floats, start: float, end: float, cell_size: CellSize) -> Cells:
    """The cells of a piecewise cubic.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).
        start: Distance along the curve at which they begin [m].
        end: And end; their length is known better than it is measured here.
        cell_size: How fine.
    """
    rows, cusps = kernels.cut_cells(
        spans,
        cell_size.longest,
        cell_size.least,
        cell_size.accel,
        cell_size.square,
        cell_size.axis,
        cell_size.yaw_accel,
    )
    if cell_size.heading and spans.shape[2] > 2:
        rows, cusps = _cut_by_heading(spans, rows, cusps)
    along, shares, tangents, bends, rests = fill_cells(spans, rows, cusps)
    along = start + along * ((end - start) / along[-1])
    along[-1] = end
    misses = np.ascontiguousarray(rows[:, kernels.MISS_T : kernels.MISS_CHANGE + 1])
    yaws = np.empty((0, 2, 3))
    if cell_size.heading and spans.shape[2] > 1:
        turns = _turns_of_spans(spans, rows)
        yaws, measured = _fitted(np.moveaxis(turns, -1, 1), shares)
        if spans.shape[2] == 2:
            yaws[:, 1, 1] = 0.5 * (yaws[:, 1, 0] + yaws[:, 1, 2])  # the bound is that of a line
        else:
            misses[:, 2:] = measured
    return Cells(along, tangents, bends, yaws, misses, rests)


def _cut_by_heading(
    spans: Floats, rows: Floats, cusps: NDArray[np.bool_]
) -> tuple[Floats, NDArray[np.bool_]]:
    """Cells in whose ground track the heading turns but little; what is proven of them holds on.

    A curve in space that climbs nearly straight up turns its heading within a few millimetres.
    """
    ground = 3.0 * np.diff(spans[:, :, :2], axis=1)
    for _ in range(CELL_HALVINGS):
        a, b = rows[:, kernels.FIRST, None], rows[:, kernels.LAST, None]
        c = ground[rows[:, kernels.SPAN].astype(int)]
        first, last = (_blossom(c, u, u) for u in (a, b))
        hulls = np.stack((first, _blossom(c, a, b), last), axis=1)
        angles = np.arctan2(hulls[..., 1], hulls[..., 0])
        spread = np.abs(np.remainder(np.diff(angles, axis=1) + np.pi, 2 * np.pi) - np.pi).sum(1)
        wide = (spread > MAX_CELL_TURN_RAD) & (
            rows[:, kernels.LAST] - rows[:, kernels.FIRST] > MIN_CELL
        )
        if not wide.any():
            break
        index = np.repeat(np.arange(len(rows)), 1 + wide)
        second = np.flatnonzero(np.diff(index) == 0) + 1
        rows, cusps = rows[index], cusps[index]
        middle = 0.5 * (rows[second, kernels.FIRST] + rows[second, kernels.LAST])
        rows[second - 1, kernels.LAST] = middle
        rows[second, kernels.FIRST] = middle
    return np.ascontiguousarray(rows), np.ascontiguousarray(cusps)


def _blossom(c: Floats, u: Floats, w: Floats) -> Floats:
    """The polar form of quadratics with Bézier points c (n, 3, 2) at parameters (n, 1)."""
    return np.asarray(
        (1 - u) * (1 - w) * c[:, 0] + ((1 - u) * w + u * (1 - w)) * c[:, 1] + u * w * c[:, 2]
    )


def sampled_cells(
    curve: Evaluable, cell_size: CellSize, count: int = MIN_SAMPLES
) -> tuple[Cells, Floats]:
    """The cells of any curve, from five samples in each; they are shorter where it bends.

    Args:
        curve: With ``domain`` and ``evaluate``.
        cell_size: How fine.
        count: Number of cells.

    Returns:
        The cells, and their ends as parameters (count + 1,).
    """
    u = _spread(curve, count)
    widths = np.diff(u)
    at = u[:-1, None] + widths[:, None] * _PLACES
    first, second = (np.asarray(curve.evaluate(at.ravel(), order)) for order in (1, 2))
    d = first.shape[-1]
    first, second = first.reshape(count, 5, d), second.reshape(count, 5, d)
    third = np.zeros_like(first)
    if cell_size.heading and cell_size.yaw_accel < np.inf:
        third = np.asarray(curve.evaluate(at.ravel(), 3)).reshape(count, 5, d)
    speed = np.linalg.norm(first, axis=2)
    lengths = widths * (speed @ _BOOLE)
    halves = widths * (speed[:, 0] + 4.0 * speed[:, 1] + speed[:, 2]) / 12.0
    along = np.concatenate(([0.0], np.cumsum(lengths)))
    stuck = speed.min(axis=1) <= 1e-12 * speed.max()
    rests = np.zeros(count + 1, dtype=np.bool_)
    rests[:-1] |= stuck
    rests[1:] |= stuck
    tangent, bend, turns = _frames(first, second, third)
    shares = np.clip(halves / np.where(lengths > 0.0, lengths, 1.0), 0.05, 0.95)
    tangents, miss_t = _fitted(np.moveaxis(tangent, 1, 2), shares)
    bends, miss_k = _fitted(np.moveaxis(bend, 1, 2), shares)
    misses = np.zeros((count, 4))
    misses[:, 0], misses[:, 1] = miss_t.max(axis=1), miss_k.max(axis=1)
    yaws = np.empty((0, 2, 3))
    if cell_size.heading and d > 1:
        yaws, misses[:, 2:] = _fitted(np.moveaxis(turns, 1, 2), shares)
    return Cells(along, tangents, bends, yaws, misses, rests), u


def _spread(curve: Evaluable, count: int) -> Floats:
    """Parameters (count + 1,) that share length and turning of a curve equally, half and half."""
    rough = np.linspace(*curve.domain, 4 * count + 1)
    first, second = (np.asarray(curve.evaluate(rough, order)) for order in (1, 2))
    _, bend, _ = _frames(first, second, np.zeros_like(first))
    speed = np.linalg.norm(first, axis=1)
    turning = speed * np.linalg.norm(bend, axis=1)
    turning = np.minimum(turning, 1e3 * np.median(turning))
    share = np.zeros(rough.size)
    for rate in (speed, turning):
        done = np.concatenate(([0.0], np.cumsum(rate[1:] + rate[:-1])))
        if done[-1] > 0.0:
            share += done / done[-1]
    u = np.interp(np.linspace(0.0, share[-1], count + 1), share, rough)
    u[0], u[-1] = curve.domain
    return u


def _turns_of_spans(spans: Floats, rows: Floats) -> Floats:
    """dψ/ds and d²ψ/ds² at five places of every cell, shape (n, 5, 2)."""
    index = rows[:, kernels.SPAN].astype(int)
    width = (rows[:, kernels.LAST] - rows[:, kernels.FIRST])[:, None, None]
    u = rows[:, kernels.FIRST, None, None] + width * _PLACES[:, None]
    c = 3.0 * np.diff(spans[index], axis=1)[:, :, None, :]
    v = 1.0 - u
    first = v * v * c[:, 0] + 2.0 * u * v * c[:, 1] + u * u * c[:, 2]
    second = 2.0 * (v * (c[:, 1] - c[:, 0]) + u * (c[:, 2] - c[:, 1]))
    third = np.broadcast_to(2.0 * (c[:, 2] - 2.0 * c[:, 1] + c[:, 0]), first.shape)
    turns = _frames(first, second, third)[2]
    turns[rows[:, kernels.STRAIGHT] > 0.0] = 0.0
    return turns


def _frames(first: Floats, second: Floats, third: Floats) -> tuple[Floats, Floats, Floats]:
    """T and K, shape (..., d), and dψ/ds and d²ψ/ds², shape (..., 2), from three derivatives."""
    speed = np.linalg.norm(first, axis=-1, keepdims=True)
    speed = np.where(speed > 0.0, speed, 1.0)
    tangent, p2, p3 = first / speed, second / speed**2, third / speed**3
    even = np.sum(tangent * p2, axis=-1, keepdims=True)
    bend = p2 - even * tangent
    ahead = np.sum(bend * bend + tangent * p3, axis=-1, keepdims=True)
    change = p3 - 3.0 * even * bend - ahead * tangent
    turns = np.zeros((*tangent.shape[:-1], 2))
    if tangent.shape[-1] > 1:
        x, y = tangent[..., 0], tangent[..., 1]
        flat = np.maximum(x * x + y * y, 1e-18)
        turns[..., 0] = (x * bend[..., 1] - y * bend[..., 0]) / flat
        turns[..., 1] = (x * change[..., 1] - y * change[..., 0]) / flat
        turns[..., 1] -= 2.0 * turns[..., 0] * (x * bend[..., 0] + y * bend[..., 1]) / flat
    return tangent, bend, turns


def _fitted(values: Floats, shares: Floats) -> tuple[Floats, Floats]:
    """Quadratics through the first, middle and last of five values, and what they miss.

    Args:
        values: At five places of the parameter, shape (n, k, 5).
        shares: Which part of the length lies before the middle one, shape (n,).

    Returns:
        Bernstein coefficients (n, k, 3), and how far they are off between, with ``ERROR_SAFETY``,
        (n, k).
    """
    x = shares[:, None]
    y = 1.0 - x
    middle = values[..., 2] - y * y * values[..., 0] - x * x * values[..., 4]
    middle = middle / (2.0 * x * y)
    fit = np.stack((values[..., 0], middle, values[..., 4]), axis=-1)
    miss = np.zeros(middle.shape)
    for k in (1, 3):
        p = _PLACES[k] + 4.0 * (x - 0.5) * _PLACES[k] * (1.0 - _PLACES[k])
        q = 1.0 - p
        value = q * q * fit[..., 0] + 2.0 * p * q * fit[..., 1] + p * p * fit[..., 2]
        miss = np.maximum(miss, np.abs(value - values[..., k]))
    return np.ascontiguousarray(fit), ERROR_SAFETY * miss
