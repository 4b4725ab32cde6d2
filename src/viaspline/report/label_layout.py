"""Where labels go: the places that cost least together, none over another.

Each label has some places to choose from, each with a cost, and a cost of being left out. The
labels choose one after the other, then each may move to a cheaper place, if those that stand in
its way find other ones and all costs together become less. The same labels always get the same
places.

Source: the local search of Christensen, Marks and Shieber, "An empirical study of algorithms for
point-feature label placement", ACM Transactions on Graphics 14(3), 1995, without its chance.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats

MAX_ROUNDS: Final = 6
"""In which every label may move once."""

MAX_TRIED: Final = 10
"""Cheaper places that a label tries in a round, others making room for it."""

MAX_TRIED_IN_ALL: Final = 150
"""Such places of all labels together: where they crowd, a better choice isn't worth the time."""

MAX_MOVED: Final = 3
"""Labels that make room for one."""

LEAST_GAIN: Final = 1e-9
"""Of costs: less is nothing."""

LEFT_OUT: Final = -1
"""The place of a label that has none."""


@dataclass(frozen=True)
class LabelPlaces:
    """What one label has to choose from.

    Attributes:
        boxes: x_min, y_min, x_max, y_max of its places [pixels], shape (k, 4).
        costs: Of these places, shape (k,).
        leaders: Points of the line that leads from each place to what it names [pixels], shape
            (k, l, 2); not a number where there is none.
        left_out: What it costs to leave the label out.
    """

    boxes: Floats
    costs: Floats
    leaders: Floats
    left_out: float


def least_cost_places(labels: Sequence[LabelPlaces], taken: Floats) -> list[int]:
    """Choose a place for every label; those that come first choose first.

    Args:
        labels: What they have to choose from.
        taken: Boxes that all have to keep off [pixels], shape (n, 4).

    Returns:
        The number of each one's place, ``LEFT_OUT`` for one that has none.

    Example:
        >>> boxes = np.array([[0.0, 0, 9, 3], [0, 4, 9, 7]])
        >>> one = LabelPlaces(boxes, np.array([1.0, 2.0]), np.full((2, 1, 2), np.nan), 50.0)
        >>> least_cost_places([one, one, one], np.zeros((0, 4)))
        [0, 1, -1]
    """
    free = [_kept_off(one, taken) for one in labels]
    chosen = [LEFT_OUT] * len(labels)
    for i in range(len(labels)):
        chosen[i] = _cheapest(labels, chosen, i, free[i])
    left = MAX_TRIED_IN_ALL
    for _ in range(MAX_ROUNDS):
        before = list(chosen)
        for i in range(len(labels)):
            left -= _improve(labels, chosen, free, i, min(left, MAX_TRIED))
        if chosen == before or left <= 0:
            break
    return chosen


def cost_of(labels: Sequence[LabelPlaces], chosen: Sequence[int]) -> float:
    """What a choice costs in all."""
    return sum(_cost(one, place) for one, place in zip(labels, chosen, strict=True))


def overlaps(boxes: Floats, others: Floats) -> Flags:
    """Which of some boxes (k, 4) lie over which others (n, 4): shape (k, n)."""
    one, other = boxes[:, None], others[None]
    apart = (one[..., :2] >= other[..., 2:]) | (one[..., 2:] <= other[..., :2])
    over: Flags = np.logical_not(apart.any(axis=2))
    return over


def _cost(one: LabelPlaces, place: int) -> float:
    return one.left_out if place == LEFT_OUT else float(one.costs[place])


def _kept_off(one: LabelPlaces, taken: Floats) -> Flags:
    """Which of a label's places are off what is taken, and worth their cost: shape (k,)."""
    met = (overlaps(one.boxes, taken) | _crossed(one.leaders, taken)).any(axis=1)
    kept: Flags = np.logical_not(met) & (one.costs < one.left_out)
    return kept


def _crossed(leaders: Floats, boxes: Floats) -> Flags:
    """Which leaders (k, l, 2) run through which boxes (n, 4): shape (k, n)."""
    x, y = leaders[:, None, :, 0], leaders[:, None, :, 1]
    x0, y0, x1, y1 = boxes.T[:, None, :, None]
    through: Flags = ((x > x0) & (x < x1) & (y > y0) & (y < y1)).any(axis=2)
    return through


def _conflicts(labels: Sequence[LabelPlaces], chosen: Sequence[int], i: int) -> Flags:
    """Which places of a label are in the way of which other ones as they are, shape (k, n)."""
    one = labels[i]
    met = np.zeros((len(one.boxes), len(labels)), bool)
    reach = np.concatenate((one.boxes[:, :2].min(axis=0), one.boxes[:, 2:].max(axis=0)))
    there = [
        j for j, place in enumerate(chosen)
        if place != LEFT_OUT and j != i and _is_near(labels[j], place, reach)
    ]  # fmt: skip
    if not there:
        return met
    boxes = np.array([labels[j].boxes[chosen[j]] for j in there])
    leaders = np.array([labels[j].leaders[chosen[j]] for j in there])
    met[:, there] = (
        overlaps(one.boxes, boxes) | _crossed(one.leaders, boxes) | _crossed(leaders, one.boxes).T
    )
    return met


def _is_near(one: LabelPlaces, place: int, reach: Floats) -> bool:
    """Whether a label, as it is placed, comes near to a box (4,)."""
    box, leader = one.boxes[place], one.leaders[place]
    low, high = np.fmin(box[:2], leader.min(axis=0)), np.fmax(box[2:], leader.max(axis=0))
    return bool((low < reach[2:]).all() and (high > reach[:2]).all())


def _cheapest(labels: Sequence[LabelPlaces], chosen: Sequence[int], i: int, free: Flags) -> int:
    """The cheapest place of a label that is in nobody's way."""
    open_to_it = free & ~_conflicts(labels, chosen, i).any(axis=1)
    if not open_to_it.any():
        return LEFT_OUT
    return int(np.argmin(np.where(open_to_it, labels[i].costs, np.inf)))


def _improve(
    labels: Sequence[LabelPlaces], chosen: list[int], free: Sequence[Flags], i: int, most: int
) -> int:
    """Move a label to where all costs together are less, if there is such a place.

    Returns:
        How many places were tried, at most ``most``.
    """
    now, costs = _cost(labels[i], chosen[i]), labels[i].costs
    cheaper = np.flatnonzero(free[i] & (costs < now - LEAST_GAIN))
    if not cheaper.size or most <= 0:
        return 0
    conflicts = _conflicts(labels, chosen, i)
    cheaper = cheaper[conflicts[cheaper].sum(axis=1) <= MAX_MOVED]
    inviting = cheaper[np.argsort(costs[cheaper], kind="stable")][:most].tolist()
    for tries, place in enumerate(inviting, 1):
        ousted = np.flatnonzero(conflicts[place]).tolist()
        tried = list(chosen)
        tried[i] = place
        for j in ousted:
            tried[j] = LEFT_OUT
        for j in ousted:
            tried[j] = _cheapest(labels, tried, j, free[j])
        if cost_of(labels, tried) < cost_of(labels, chosen) - LEAST_GAIN:
            chosen[:] = tried
            return tries
    return len(inviting)
