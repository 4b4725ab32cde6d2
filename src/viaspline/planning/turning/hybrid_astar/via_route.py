"""A whole via sequence through tight space, by the search among poses.

Tested through ``planning/methods/test_hybrid_astar_search``.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from itertools import pairwise

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.turning.hybrid_astar.pose_search import SEARCH_EFFORTS, Effort
from viaspline.planning.turning.hybrid_astar.pose_sequence import find_row
from viaspline.planning.turning.hybrid_astar.search_outcome import (
    Chain,
    Goal,
    NotFound,
    Pose,
    Reason,
)
from viaspline.world.world import World

MAX_FREE_STARTS = 8  # headings that are tried where the first one is free


def via_route_chains(
    sequence: ViaSequence,
    world: World,
    requirements: Requirements,
    rho: float,
    ramp: float,
    spots: Collection[int],
    efforts: Sequence[Effort] = SEARCH_EFFORTS,
    barriers: Sequence[Floats] = (),
) -> list[Chain] | NotFound:
    """A chain for every leg of a via sequence, or why there is none.

    Args:
        sequence: Its via points and the headings at its ends.
        world: What to keep clear of.
        requirements: The body and what it keeps.
        rho: The least radius [m].
        ramp: Length on which the curvature rises from 0 to 1 / rho [m].
        spots: Via points at which the robot may turn on the spot.
        efforts: How finely and how long is looked, one after the other.
        barriers: For each leg, segments that it must not cross [m], each (b, 4); none at all if
            it is empty.
    """
    count = len(sequence.vias)
    stops = [0, *(k for k in sorted(spots) if 0 < k < count - (not sequence.closed))]
    stops.append(count if sequence.closed else count - 1)
    chains: list[Chain] = []
    for first, last in pairwise(stops):
        found = _part(
            sequence, world, requirements, rho, ramp, first, last, efforts, barriers[first:last]
        )
        if isinstance(found, NotFound):
            return NotFound(found.reason, first + found.goal, found.expanded)
        chains += found
    return chains


def _part(
    sequence: ViaSequence,
    world: World,
    requirements: Requirements,
    rho: float,
    ramp: float,
    first: int,
    last: int,
    efforts: Sequence[Effort],
    barriers: Sequence[Floats],
) -> list[Chain] | NotFound:
    """The chains from one stop to the next."""
    count = len(sequence.vias)
    places = [sequence.vias[k % count].at[:2] for k in range(first, last + 1)]
    is_loop = sequence.closed and first == 0 and last == count
    end = sequence.end_tangent if last == count - 1 and not sequence.closed else None
    failed: NotFound | None = None
    has_seen_all = True
    for heading in _starts(sequence, places, first):
        goals = [Goal(float(x), float(y)) for x, y in places[1:]]
        if is_loop:
            goals[-1] = Goal(goals[-1].x, goals[-1].y, (heading,))
        elif end is not None:
            goals[-1] = Goal(goals[-1].x, goals[-1].y, (math.atan2(end[1], end[0]),))
        start = Pose(float(places[0][0]), float(places[0][1]), heading)
        found = find_row(world, requirements, rho, ramp, start, goals, efforts, barriers)
        if not isinstance(found, NotFound):
            return list(found)
        has_seen_all &= found.reason.is_proof
        if failed is None or found.goal > failed.goal:
            failed = found
    assert failed is not None  # there is always one start
    if has_seen_all or failed.reason.is_of_goal:
        return failed
    return NotFound(Reason.BUDGET, failed.goal, failed.expanded)  # another start may serve


def _starts(sequence: ViaSequence, places: list[Floats], first: int) -> list[float]:
    """The headings to begin with: the one that is given, else first the one to the next place."""
    if first == 0 and sequence.start_tangent is not None:
        return [math.atan2(sequence.start_tangent[1], sequence.start_tangent[0])]
    ahead = places[1] - places[0]
    straight = math.atan2(ahead[1], ahead[0])
    turns = sorted(np.arange(MAX_FREE_STARTS) - MAX_FREE_STARTS // 2, key=abs)
    return [straight + float(k) * math.tau / MAX_FREE_STARTS for k in turns]
