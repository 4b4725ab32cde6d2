"""Which side of things a path passes: a robot keeps it, unless the other is clearly better.

Two ways between the same two places pass something on different sides if the loop that they make
together encloses it. Where a new path would do so, with something that was known when the old
one was laid, it is compared with the best path that keeps the old side there.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Obstacle, Side
from viaspline.planning.routing.side_barrier import barriers_of
from viaspline.robot.navigation.schedule import vias_after
from viaspline.world.world import World

MAX_LENGTH_RATIO = 0.95
"""Of the other's length is what a path may have that changes sides,"""

MIN_SAVING_M = 0.5
"""and so much less than it [m]."""


def is_better(length: float, other: float) -> bool:
    """Whether a way of this length [m] is so much shorter than another that it is worth a change.

    >>> is_better(9.4, 10.0), is_better(9.6, 10.0), is_better(0.6, 1.0)
    (True, False, False)
    """
    return length < min(MAX_LENGTH_RATIO * other, other - MIN_SAVING_M)


def changed_side(
    old: Path,
    new: Path,
    at: float,
    last: int,
    known: World,
    width: float,
    rejoins_at: float | None = None,
) -> tuple[Floats, Side] | None:
    """Something that a new path passes on another side than the old one did, and the old side.

    Args:
        old: The path that is being driven.
        new: The one that is to take its place; both are the same up to ``at``.
        at: Where they part, as a distance along either [m].
        last: Index in the route of the last via point that was passed.
        known: What was known when the old one was laid.
        width: Distance that both keep from it [m].
        rejoins_at: Distance along the new one from which it is the old one again; None if never.

    Returns:
        (a place in it [m], side); of several the one nearest to the old path. None if they pass
        everything on the same sides.
    """
    places, indices = known.places()
    if not len(places):
        return None
    until = np.inf if rejoins_at is None else rejoins_at
    for before, after in _legs(old, new, at, last, 0.5 * width, until):
        between = _enclosed(np.concatenate((before, after[::-1])), places)
        if between.size:
            gaps = [np.hypot(*(before - places[k]).T).min() for k in between]
            nearest = int(between[int(np.argmin(gaps))])
            barrier = barriers_of(known, int(indices[nearest]), before[0], before[-1]).right[0]
            return places[nearest], "right" if _crosses(before, barrier) else "left"
    return None


def _enclosed(ring: Floats, places: Floats) -> NDArray[np.intp]:
    """Indices of the places that lie inside of a closed line, which may cross itself."""
    near = (places >= ring.min(axis=0)) & (places <= ring.max(axis=0))
    found = np.flatnonzero(near.all(axis=1))
    if not found.size or np.ptp(ring, axis=0).min() <= 0.0:
        return np.empty(0, np.intp)
    area = World([Obstacle(polygon=[(x, y) for x, y in ring.tolist()])])
    return found[area.distance(places[found]) < 0.0]


def _legs(
    old: Path, new: Path, at: float, last: int, spacing: float, until: float
) -> Iterator[tuple[Floats, Floats]]:
    """Points along either path, from where they part on, for each leg that both have."""
    stops = {via.index: place for via, place in vias_after(old, last)}
    common = [(at, at)]
    common += [
        (stops[via.index], place)
        for via, place in vias_after(new, last)
        if via.index in stops and min(place, stops[via.index]) > at
    ]
    for (old_from, new_from), (old_to, new_to) in pairwise(common):
        if new_from >= until:  # from here on they are the same
            return
        yield _line(old, old_from, old_to, spacing), _line(new, new_from, new_to, spacing)


def _line(path: Path, start: float, end: float, spacing: float) -> Floats:
    count = max(int(np.ceil((end - start) / spacing)), 1)
    return np.asarray(path.at_distance(np.linspace(start, end, count + 1)))[:, :2]


def _crosses(line: Floats, barrier: Floats) -> bool:
    """Whether a polyline crosses a segment x0, y0, x1, y1 an odd number of times."""
    foot, tip = barrier[:2], barrier[2:]

    def left(a: Floats, b: Floats, c: Floats) -> NDArray[np.bool_]:
        ab, ac = b - a, c - a
        return np.asarray(ab[..., 0] * ac[..., 1] - ab[..., 1] * ac[..., 0] > 0.0)

    apart = left(foot, tip, line[:-1]) != left(foot, tip, line[1:])
    meets = left(line[:-1], line[1:], foot) != left(line[:-1], line[1:], tip)
    return bool(np.count_nonzero(apart & meets) % 2)
