"""The narrowest gap of the widest way between two places.

A world's pieces are convex (``gap_links``). A robot that needs a distance all around its middle
is kept from the goal where a closed loop of pieces surrounds one of the two places and not the
other, from piece to piece through gaps that it doesn't fit through (the nerve theorem: what convex
sets cover has the cycles of their overlaps). A loop separates the two where it crosses a line
between them an odd number of times. So gaps are closed one after the other, the narrowest first:
the one that makes the first odd cycle is the bottleneck. That is exact, and no way is searched.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.certificate import PROOF_SLACK_M
from viaspline.kernels.arrays import Bytes, Floats, Ints
from viaspline.kernels.routing.odd_cycle import first_odd_cycle
from viaspline.planning.problem.requirements import LEAST_KEPT_M, Requirements
from viaspline.planning.routing.gap_graph import GapGraph
from viaspline.planning.routing.gap_links import GapLinks
from viaspline.world.world import World

SHUT_M = 2.0 * LEAST_KEPT_M  # nothing passes a gap that is no wider
LEAST_SIZE_M2 = 1e-300  # of a line squared: one that is less is a place


@dataclass(frozen=True)
class Bottleneck:
    """The narrowest gap of the widest way between two places.

    Attributes:
        width: [m]; 0 where what shuts the way off has no gap.
        at: Its middle [m].
        owners: What it lies between; where it has no gap, the whole loop. Indices as of
            ``World.nearest``, each once.
    """

    width: float
    at: tuple[float, float]
    owners: tuple[int, ...]

    @property
    def is_shut(self) -> bool:
        """Whether it has no gap for anything."""
        return self.width == 0.0


def bottleneck_between(
    world: World, start: Floats, goal: Floats, reach: float
) -> Bottleneck | None:
    """The bottleneck of the ways from start to goal.

    Args:
        world: What is in the way.
        start: [m], at least (2,), with more room than half of ``reach``.
        goal: The same.
        reach: The width from which on a gap is none [m].

    Returns:
        None where some way goes through no gap narrower than ``reach``.
    """
    return _narrowest(GapGraph.of(world, reach), start, goal)


def gaps_for_body(world: World, requirements: Requirements) -> GapGraph:
    """The gaps of a world that are narrower than a convex body: those of all legs alike.

    Args:
        world: What is in the way.
        requirements: The body and what it keeps.
    """
    return GapGraph.of(world, requirements.narrowest_gap - 2.0 * PROOF_SLACK_M)


def body_bottleneck(
    graph: GapGraph, start: Floats, goal: Floats, requirements: Requirements
) -> Bottleneck | None:
    """The bottleneck of the ways of a convex body from start to goal, however it turns.

    A gap is closed for it that is narrower than itself, see ``Requirements.narrowest_gap``, and in
    which it doesn't stand at either end; or that is too narrow for its inner disc.

    Args:
        graph: See ``gaps_for_body``.
        start: [m], at least (2,), with room for that disc.
        goal: The same.
        requirements: The body and what it keeps.

    Returns:
        None where that closes no way.
    """
    links, far = graph.links, requirements.around
    is_away = (_gaps_to(links, start) > far) & (_gaps_to(links, goal) > far)
    is_closed = (links.widths < 2.0 * (requirements.required - PROOF_SLACK_M)) | is_away
    return _narrowest(replace(graph, links=links.some(is_closed)), start, goal)


def _gaps_to(links: GapLinks, place: Floats) -> Floats:
    """How far the lines across gaps are from a place, at least (2,): [m], (k,)."""
    from_place = links.feet[:, :2] - place[:2]
    across = links.feet[:, 2:] - links.feet[:, :2]
    size = np.maximum((across * across).sum(axis=1), LEAST_SIZE_M2)
    part = np.clip(-(from_place * across).sum(axis=1) / size, 0.0, 1.0)
    x, y = (from_place + part[:, None] * across).T
    return np.asarray(np.hypot(x, y))


def _narrowest(graph: GapGraph, start: Floats, goal: Floats) -> Bottleneck | None:
    """The gap that closes the first loop round one of two places, of all that are closed."""
    links, count = graph.links, len(graph.owners)
    odd = _crossings(graph, np.asarray(start[:2]), np.asarray(goal[:2]))
    first, second = (np.ascontiguousarray(ends) for ends in links.pairs.T)
    last = int(first_odd_cycle(first, second, odd, count))
    if last < 0:
        return None
    width, round_it = float(links.widths[last]), links.pairs[last]
    if width <= SHUT_M:
        shut = links.widths <= SHUT_M
        width, round_it = 0.0, _odd_ring(links.some(shut), odd[shut], count, int(first[last]))
    owners = tuple(dict.fromkeys(graph.owners[round_it].tolist()))
    return Bottleneck(width, graph.middle_of(last), owners)


def _crossings(graph: GapGraph, start: Floats, goal: Floats) -> Bytes:
    """Whether links cross the line from start to goal an odd number of times, (k,).

    Each leads from a place in a piece to its foot, to the other foot, to a place there.
    """
    (a, b), feet = graph.links.pairs.T, graph.links.feet
    corners = (graph.places[a], feet[:, :2], feet[:, 2:], graph.places[b])
    along = goal - start
    sides = [along[0] * (p[:, 1] - start[1]) - along[1] * (p[:, 0] - start[0]) for p in corners]
    odd = np.zeros(len(a), np.uint8)
    for p, q, left, right in zip(corners, corners[1:], sides, sides[1:], strict=False):
        met = np.flatnonzero((left >= 0.0) != (right >= 0.0))
        part = left[met] / (left[met] - right[met])
        places = p[met] + part[:, None] * (q[met] - p[met])
        reached = (places - start) @ along
        odd[met[(reached > 0.0) & (reached < along @ along)]] ^= 1
    return odd


def _odd_ring(links: GapLinks, odd: Bytes, count: int, piece: int) -> Ints:
    """The pieces of the shortest odd cycle of links through one of ``count`` pieces, in order."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import breadth_first_order

    a, b = links.pairs.T
    crossed = count * odd.astype(np.int64)  # pieces a second time, where crossings were odd
    rows = np.concatenate((a, a + count))
    columns = np.concatenate((b + crossed, b + count - crossed))
    graph = coo_array((np.ones(len(rows)), (rows, columns)), shape=(2 * count, 2 * count))
    before = breadth_first_order(graph.tocsr(), piece, directed=False)[1]
    ring, node = [], piece + count
    while node != piece:
        ring.append(node % count)
        node = int(before[node])
    return np.array(ring)
