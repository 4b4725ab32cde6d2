"""A path along straight lines, its corners rounded as far as there is room."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.fleet.clear_segments import clear_segments
from viaspline.world.world import World

SHARPEST_RAD = 2.8
"""Turns that are sharper are not rounded: the robot stops there and turns back."""
STRAIGHT_RAD = 1e-6
"""Turns that are slighter are none."""
HALVINGS = 4
"""Of a rounding for which there is no room."""
CHORDS = 8
"""Of a rounding, when it is seen whether there is room."""
HAIR_M = 1e-6
"""So much more is kept [m]."""


@dataclass(frozen=True, eq=False)
class RoundedLines:
    """Cubic spans along straight lines, with rounded corners.

    Attributes:
        spans: Bézier control polygons [m], (m, 4, 2).
        middles: Where on the curve each corner is, its first and last place among them: the
            parameter, as of ``Path``, (k,).
    """

    spans: Floats
    middles: Floats


def rounded_lines(
    places: Floats, world: World, kept: float, widest: float, farthest: float | Floats
) -> RoundedLines:
    """Round the corners of straight lines by arcs inside of them.

    Args:
        places: Corners, with the first and the last place; no two that follow each other are the
            same [m], (k, 2), k >= 2.
        world: What stands.
        kept: What the curve keeps of it [m].
        widest: Radius of an arc at most [m].
        farthest: How far an arc may be from its corner [m]; for all, or for each that lies between
            the first place and the last, (k - 2,).

    Example:
        >>> lines = rounded_lines(np.array([[0., 0.], [5., 0.], [5., 5.]]), World(), 1., 1., 1.)
        >>> len(lines.spans), lines.middles
        (4, array([0., 2., 4.]))
    """
    legs = np.diff(places, axis=0)
    lengths = np.hypot(*legs.T)
    ways = legs / lengths[:, None]
    cross = ways[:-1, 0] * ways[1:, 1] - ways[:-1, 1] * ways[1:, 0]
    turns = np.arctan2(cross, (ways[:-1] * ways[1:]).sum(axis=1))
    half = np.tan(np.abs(turns) / 2.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        away = np.where(half > 0.0, farthest * half / (1.0 / np.cos(turns / 2.0) - 1.0), np.inf)
    room = np.minimum(lengths[:-1], lengths[1:]) / 2.0
    back = np.minimum(np.minimum(widest * half, away), room)
    is_round = (np.abs(turns) > STRAIGHT_RAD) & (np.abs(turns) < SHARPEST_RAD)
    back[~is_round] = 0.0
    for _ in range(HALVINGS):
        tight = ~_has_room(places, ways, turns, back, world, kept)
        if not tight.any():
            break
        back[tight] /= 2.0
    back[~_has_room(places, ways, turns, back, world, kept)] = 0.0
    return _spans(places, ways, turns, back)


def _arcs(places: Floats, ways: Floats, turns: Floats, back: Floats) -> Floats:
    """A cubic for each corner, near to an arc: its control points [m], (k - 2, 4, 2)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = np.where(back > 0.0, back / np.tan(np.abs(turns) / 2.0), 0.0)
    handle = (4.0 / 3.0 * np.tan(np.abs(turns) / 4.0) * radius)[:, None]
    begin, end = places[1:-1] - back[:, None] * ways[:-1], places[1:-1] + back[:, None] * ways[1:]
    return np.stack([begin, begin + handle * ways[:-1], end - handle * ways[1:], end], axis=1)


def _has_room(
    places: Floats, ways: Floats, turns: Floats, back: Floats, world: World, kept: float
) -> Flags:
    """Whether each rounding is clear; one that is none is."""
    found = np.ones(back.size, np.bool_)
    some = np.flatnonzero(back > 0.0)
    if some.size == 0:
        return found
    arcs = _arcs(places, ways, turns, back)[some]
    w = np.linspace(0.0, 1.0, CHORDS + 1)[:, None]
    basis = np.hstack([(1 - w) ** 3, 3 * w * (1 - w) ** 2, 3 * w**2 * (1 - w), w**3])
    points = np.einsum("wk,nkd->nwd", basis, arcs)
    chords = np.concatenate([points[:, :-1], points[:, 1:]], axis=2).reshape(-1, 4)
    clear = clear_segments(world.packed, np.ascontiguousarray(chords), kept + HAIR_M)
    found[some] = clear.reshape(-1, CHORDS).all(axis=1)
    return found


def _spans(places: Floats, ways: Floats, turns: Floats, back: Floats) -> RoundedLines:
    """Lines between roundings, and these in two halves each, so that a joint is at the corner."""
    arcs = _arcs(places, ways, turns, back)
    spans: list[Floats] = []
    middles = [0.0]
    at = places[0]
    for k in range(len(ways)):
        end = places[k + 1] if k == len(ways) - 1 else arcs[k, 0]
        if float(np.hypot(*(end - at))) > HAIR_M:
            spans.append(np.linspace(at, end, 4))
        if k < len(ways) - 1:
            if back[k] > 0.0:
                first, second = _halves(arcs[k])
                spans.append(first)
                middles.append(float(len(spans)))
                spans.append(second)
            else:
                middles.append(float(len(spans)))
            at = arcs[k, 3]
    middles.append(float(len(spans)))
    return RoundedLines(np.array(spans), np.array(middles))


def _halves(cubic: Floats) -> tuple[Floats, Floats]:
    """A cubic, cut in its middle (de Casteljau)."""
    a, b, c = (cubic[:-1] + cubic[1:]) / 2.0
    ab, bc = (a + b) / 2.0, (b + c) / 2.0
    middle = (ab + bc) / 2.0
    return np.array([cubic[0], a, ab, middle]), np.array([middle, bc, c, cubic[3]])
