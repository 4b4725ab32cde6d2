"""The next shortest ways, where a turning circle can't follow the shortest.

Where a swing gets stuck, the gap that its way goes through there is closed, and the shortest way
that is left is tried: always the shortest of all that are known.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Sequence
from itertools import count

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.routing.router import NO_BARRIERS, TautPath, on_the_line
from viaspline.planning.turning.repair import Stuck
from viaspline.planning.turning.turn_path import TurnPath
from viaspline.world.world import World

TRIED = 12  # rows of ways
TOUCHING = 1e-3  # distance at which the segment across a gap ends, of what is required
STEPS = 200  # of such a segment to either side
SAME = 1e-6  # ways whose lengths differ by less are one [m]
Lay = Callable[[Sequence[TautPath]], TurnPath | Stuck]


def turn_path_on_next_shortest(
    legs: Sequence[LegSearch], taut_paths: Sequence[TautPath], lay: Lay
) -> TurnPath | None:
    """The shortest swing that is found along the shortest ways of all legs and their byways.

    Args:
        legs: The legs of the course.
        taut_paths: The shortest way of each.
        lay: Lays a swing along ways, or says where it gets stuck.
    """
    number = count()
    open_ = [(_length(taut_paths), next(number), tuple(taut_paths), (NO_BARRIERS,) * len(legs))]
    seen = [open_[0][0]]
    best: TurnPath | None = None
    for _ in range(TRIED):
        if not open_ or (best is not None and best.length <= open_[0][0]):
            break
        _, _, along, closed = heapq.heappop(open_)
        found = lay(along)
        if isinstance(found, TurnPath):
            best = found if best is None or found.length < best.length else best
            continue
        for leg, place in found.places:
            other = _other_way(legs[leg], along[leg], closed[leg], place)
            if other is None:
                continue
            others = (*along[:leg], other[0], *along[leg + 1 :])
            length = _length(others)
            if all(abs(length - before) > SAME for before in seen):
                seen.append(length)
                barriers = (*closed[:leg], other[1], *closed[leg + 1 :])
                heapq.heappush(open_, (length, next(number), others, barriers))
    return best


def _length(taut_paths: Sequence[TautPath]) -> float:
    return sum(taut_path.length for taut_path in taut_paths)


def _other_way(
    leg: LegSearch, taut_path: TautPath, closed: Floats, by: Floats
) -> tuple[TautPath, Floats] | None:
    """The shortest way of a leg that avoids a gap of another one too, and all that is closed."""
    gap = _gap_across(leg.world, leg.requirements, taut_path, by)
    if gap is None:
        return None
    closed = np.vstack((closed, gap))
    active = on_the_line(leg.world, *leg.ends, leg.requirements.required)
    other, _ = leg.shortest_allowed(active, closed)
    return None if other is None else (other, closed)


def _gap_across(
    world: World, requirements: Requirements, taut_path: TautPath, by: Floats
) -> Floats | None:
    """The segment from what a way goes by to what is opposite [m], (1, 4).

    Where nothing is, it ends as far away as the way is long.
    """
    corners = taut_path.corners[:, [X, Y]]
    steps = np.diff(corners, axis=0)
    along = ((by - corners[:-1]) * steps).sum(axis=1) / (steps**2).sum(axis=1)
    feet = corners[:-1] + np.clip(along, 0.0, 1.0)[:, None] * steps
    foot = feet[np.linalg.norm(feet - by, axis=1).argmin()]
    gap = float(np.linalg.norm(foot - by))
    if gap < TOUCHING * requirements.required:
        return None
    out = (foot - by) / gap
    ends = [
        _touched(world, requirements, foot, side * out, taut_path.length) for side in (-1.0, 1.0)
    ]
    return np.concatenate(ends)[None]


def _touched(
    world: World, requirements: Requirements, place: Floats, out: Floats, farthest: float
) -> Floats:
    """Where a ray from a place touches something."""
    along = 0.0
    for _ in range(STEPS):
        left = float(world.distance(place + along * out))
        if left <= TOUCHING * requirements.required or along >= farthest:
            break
        along = min(along + left, farthest)
    return place + along * out
