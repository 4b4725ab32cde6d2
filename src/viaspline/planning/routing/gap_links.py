"""The convex pieces of what is in a world, and the gaps between them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats, Ints
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.world.world import BOUNDS, World

Shapes = NDArray[Any]
"""Geometries of shapely."""


@dataclass(frozen=True)
class ConvexPieces:
    """Convex cores, each grown by a radius.

    Attributes:
        cores: Points, lines and convex polygons [m], (n,).
        radii: [m], (n,).
        owners: What each is a piece of, an index as of ``World.nearest``, (n,).
        places: A place in each core [m], (n, 2).
    """

    cores: Shapes
    radii: Floats
    owners: Ints
    places: Floats

    @classmethod
    def of(cls, world: World) -> ConvexPieces:
        """Everything in a world but its maps: the edges of what isn't convex, and of what it is in.

        Nothing crosses the edge of an obstacle, so that its inside may be left out.
        """
        solids = [(one.ring, index) for index, one in enumerate(world.obstacles) if one.ring]
        # a scan makes hundreds of discs, and shapely makes many points as fast as one
        centres = np.array([ring.loops[0][0] for ring, _ in solids if ring.is_disc], np.float64)
        points: Shapes = np.asarray(shapely.points(centres.reshape(-1, 2)))
        discs = iter(points)
        found: list[tuple[Any, float, int]] = []
        for ring, index in solids:
            cores = [next(discs)] if ring.is_disc else _convex_cores(ring)
            found += [(core, ring.radius, index) for core in cores]
        if world.bounds is not None:
            x0, y0, x1, y1 = world.bounds
            found += [(e, 0.0, BOUNDS) for e in _edges([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])]
        areas = [*((ring,) for ring in world.fences), *([world.corridor] if world.corridor else [])]
        for number, rings in enumerate(areas, start=1):
            found += [(edge, 0.0, BOUNDS - number) for ring in rings for edge in _edges(ring)]
        shapes = np.array([core for core, _, _ in found], object)
        return cls(
            shapes,
            np.array([radius for _, radius, _ in found], np.float64),
            np.array([owner for _, _, owner in found], np.int64),
            _first_corners(shapes),
        )


@dataclass(frozen=True)
class GapLinks:
    """Pairs of pieces that are near to each other, and the gap between the two of each.

    Attributes:
        pairs: Their numbers, (k, 2).
        widths: Of the gaps [m], (k,); not above 0 where the two touch.
        feet: Nearest places of their cores [m]: x, y of the first, x, y of the second, (k, 4).
    """

    pairs: Ints
    widths: Floats
    feet: Floats

    @classmethod
    def joined(cls, rows: Sequence[GapLinks]) -> GapLinks:
        """All of some."""
        return cls(
            np.concatenate([links.pairs for links in rows]),
            np.concatenate([links.widths for links in rows]),
            np.concatenate([links.feet for links in rows]),
        )

    def some(self, which: NDArray[Any]) -> GapLinks:
        """Those of some numbers, in that order, or those that are marked."""
        return GapLinks(self.pairs[which], self.widths[which], self.feet[which])

    def renumbered(self, first: Ints, second: Ints) -> GapLinks:
        """These with other numbers for the first piece of each pair, and for the second."""
        pairs = np.column_stack((first[self.pairs[:, 0]], second[self.pairs[:, 1]]))
        return GapLinks(pairs, self.widths, self.feet)


def places_near(places: Floats, pieces: ConvexPieces, reach: float) -> Ints:
    """Which of some places (n, 2) [m] may be nearer than ``reach`` to a piece, (k,)."""
    tree = shapely.STRtree(_boxes(pieces, reach))
    return np.unique(tree.query(shapely.points(places))[0])


def links_among(pieces: ConvexPieces, reach: float, least: float = -math.inf) -> GapLinks:
    """The gaps of ``least`` and more, and less than ``reach`` [m], between some pieces."""
    boxes = _boxes(pieces, 0.5 * reach)
    pairs = shapely.STRtree(boxes).query(boxes).T
    return _measured(pieces, pieces, pairs[pairs[:, 0] < pairs[:, 1]], reach, least)


def links_between(first: ConvexPieces, second: ConvexPieces, reach: float) -> GapLinks:
    """The gaps of less than ``reach`` [m] from pieces to others, each numbered by themselves."""
    boxes = _boxes(first, reach), _boxes(second, 0.0)
    return _measured(first, second, shapely.STRtree(boxes[0]).query(boxes[1])[::-1].T, reach)


def _measured(
    first: ConvexPieces, second: ConvexPieces, pairs: Ints, reach: float, least: float = -math.inf
) -> GapLinks:
    a, b = pairs.T
    cores = first.cores[a], second.cores[b]
    widths = shapely.distance(*cores) - first.radii[a] - second.radii[b]
    near = (widths < reach) & (widths >= least)
    lines = shapely.shortest_line(cores[0][near], cores[1][near])
    return GapLinks(pairs[near], widths[near], _coordinates(lines).reshape(-1, 4))


def _boxes(pieces: ConvexPieces, more: float) -> Shapes:
    x0, y0, x1, y1 = shapely.bounds(pieces.cores).reshape(-1, 4).T
    by = pieces.radii + more
    return np.asarray(shapely.box(x0 - by, y0 - by, x1 + by, y1 + by))


def _convex_cores(ring: RoundedRing) -> list[Any]:
    if len(ring.loops) == 1 and _is_convex(ring.vertices):
        return [ring.core()]
    return [edge for loop in ring.loops for edge in _edges(loop)]


def _is_convex(corners: Floats) -> bool:
    """Whether a ring that doesn't cross itself, (k, 2), only turns to one side."""
    if len(corners) <= 3:
        return True
    x, y = np.diff(np.vstack((corners, corners[:2])), axis=0).T
    turns = x[:-1] * y[1:] - y[:-1] * x[1:]
    return bool((turns >= 0.0).all() or (turns <= 0.0).all())


def _edges(loop: Sequence[tuple[float, float]]) -> list[Any]:
    corners = np.asarray(loop, np.float64)
    ends = np.stack((corners, np.roll(corners, -1, axis=0)), axis=1)
    return list(np.asarray(shapely.linestrings(ends)))


def _first_corners(cores: Shapes) -> Floats:
    corners, core = shapely.get_coordinates(cores, return_index=True)
    found: Floats = corners[np.unique(core, return_index=True)[1]]
    return found


def _coordinates(shapes: Shapes) -> Floats:
    found: Floats = shapely.get_coordinates(shapes)
    return found
