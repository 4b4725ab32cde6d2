"""The curve of a true motion: few cubics, proven to be near the arcs that were driven."""

from __future__ import annotations

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats, Ints
from viaspline.machine.rolling_back import without_rolling_back
from viaspline.machine.turned_in_place import STANDING_M

TRACE_TOLERANCE_M = 1e-3
"""How far a cubic may be from the arcs that it stands for [m]."""
MAX_HALVINGS = 7
"""A cubic stands for at most 2 to the power of this steps."""


def trace(
    positions: Floats, headings: Floats, reach: float = 0.0
) -> tuple[PiecewiseCubic, float, Floats]:
    """A curve through the places of a motion that is an arc from each to the next.

    A cubic goes from place to place over 1, 2, 4, … 128 steps with the true headings at its ends.
    At every step within, its point is compared with the true one; between two steps, the arc and
    the cubic are each no farther from their chord than l φ/8 and |q''| Δw²/8, and the chords no
    farther from each other than their ends. The sum bounds the distance everywhere; the longest
    cubics that stay within a millimetre are taken. A body that is a polygon stands where the true
    one rolls back, and the bound has that distance in it. Where it turns while it stands it has
    poses that the curve doesn't have: see ``turned_in_place``.

    Args:
        positions: [m], shape (n, 2), n >= 1.
        headings: Of the motion, running on over whole turns [rad], shape (n,).
        reach: Distance of the body's farthest corner, if it is a polygon that looks the way that
            it goes: the difference of headings moves it [m].

    Returns:
        The curve; the bound [m]; for every place the curve's parameter there, shape (n,).

    Example:
        >>> angle = np.linspace(0.0, 3.0, 301)
        >>> circle = 2.0 * np.column_stack((np.sin(angle), 1.0 - np.cos(angle)))
        >>> curve, bound, _ = trace(circle, angle)
        >>> len(curve.spans), bound < 1e-3, round(curve.length, 1)
        (7, True, 6.0)
    """
    rolled = 0.0
    if reach > 0.0:  # a cubic that goes back would turn the body round
        positions, rolled = without_rolling_back(positions, headings)
    steps = np.hypot(*np.diff(positions, axis=0).T)
    turns = np.abs(np.diff(headings))
    with np.errstate(divide="ignore", invalid="ignore"):
        bulge = np.where(turns > 1e-9, 0.5 * turns / np.sin(np.minimum(0.5 * turns, 1.5)), 1.0)
    along = np.concatenate(([0.0], np.cumsum(steps * bulge)))
    taken = np.zeros(len(steps), np.bool_)
    firsts, widths, bound = [], [], 0.0
    for power in range(MAX_HALVINGS, -1, -1):
        width = 2**power
        first = np.arange(0, len(steps) - width + 1, width)
        first = first[~taken[first]]
        if not len(first):
            continue
        off = _bounds(positions, headings, along, first, width, reach)
        off[along[first + width] - along[first] <= STANDING_M] = 0.0  # no cubic will stand for it
        good = (off <= TRACE_TOLERANCE_M) | (width == 1)
        bound = max(bound, float(off[good].max(initial=0.0)))
        first = first[good]
        taken[(first[:, None] + np.arange(width)).ravel()] = True
        firsts.append(first)
        widths.append(np.full(len(first), width))
    return _curve(positions, headings, along, firsts, widths, bound + rolled)


def _curve(
    positions: Floats, headings: Floats, along: Floats, firsts: list[Ints], widths: list[Ints],
    bound: float,
) -> tuple[PiecewiseCubic, float, Floats]:  # fmt: skip
    first = np.concatenate([*firsts, np.empty(0, np.int64)])
    width = np.concatenate([*widths, np.empty(0, np.int64)])
    order = np.argsort(first)
    first, last = first[order], (first + width)[order]
    moved = along[last] - along[first] > STANDING_M
    first, last = first[moved], last[moved]
    if not len(first):  # it never moved
        here = np.repeat(positions[:1, None, :], 4, axis=1)
        return PiecewiseCubic(here), bound, np.zeros(len(positions))
    spans = _cubics(positions, headings, along, first, last)
    spans[1:, 0] = spans[:-1, 3]
    joints = np.append(along[first], along[last[-1]])
    joints = np.maximum.accumulate(joints)
    u = np.interp(along, joints, np.arange(len(joints), dtype=float))
    return PiecewiseCubic(spans), bound, u


def _cubics(positions: Floats, headings: Floats, along: Floats, first: Ints, last: Ints) -> Floats:
    """Bézier control polygons from place to place, shape (k, 4, 2)."""
    handle = ((along[last] - along[first]) / 3.0)[:, None]
    ahead = np.column_stack((np.cos(headings), np.sin(headings)))
    a, b = positions[first], positions[last]
    return np.stack((a, a + handle * ahead[first], b - handle * ahead[last], b), axis=1)


def _bounds(
    positions: Floats, headings: Floats, along: Floats, first: Ints, width: int, reach: float
) -> Floats:
    """How far each cubic may be from the true motion over ``width`` steps [m], shape (k,)."""
    last = first + width
    spans = _cubics(positions, headings, along, first, last)
    index = first[:, None] + np.arange(width + 1)
    total = np.maximum(along[last] - along[first], STANDING_M)
    w = (along[index] - along[first][:, None]) / total[:, None]
    basis = np.stack(((1 - w) ** 3, 3 * w * (1 - w) ** 2, 3 * w * w * (1 - w), w**3), axis=-1)
    gaps = np.linalg.norm(np.einsum("kwb,kbd->kwd", basis, spans) - positions[index], axis=2)
    turned = np.abs(np.diff(headings[index], axis=1))
    arcs = np.max(np.diff(along[index], axis=1) * turned, axis=1) / 8.0
    bends = np.linalg.norm(spans[:, :-2] - 2.0 * spans[:, 1:-1] + spans[:, 2:], axis=2)
    cubics = 6.0 * bends.max(axis=1) * np.max(np.diff(w, axis=1), axis=1) ** 2 / 8.0
    off: Floats = gaps.max(axis=1) + arcs + cubics
    if reach > 0.0:
        off = off + reach * _turned(spans, w, headings[index])
    return off


def _turned(spans: Floats, w: Floats, headings: Floats) -> Floats:
    """The greatest difference of headings at the steps, and half of what turns between two."""
    legs = np.diff(spans, axis=1)
    basis = np.stack(((1 - w) ** 2, 2 * w * (1 - w), w * w), axis=-1)
    ahead = np.einsum("kwb,kbd->kwd", basis, legs)
    angle = np.arctan2(ahead[..., 1], ahead[..., 0])
    off = np.abs(np.remainder(angle - headings + np.pi, 2.0 * np.pi) - np.pi)
    uneven = np.abs(np.diff(headings, n=2, axis=1)).max(axis=1, initial=0.0)
    return np.asarray(off.max(axis=1) + 0.5 * uneven)
