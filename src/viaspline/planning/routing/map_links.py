"""The cells of a map as convex pieces, and the gaps between them.

All places of a map that matter lie on its *half lattice*, whose nodes are the corners and middles
of cells and of their sides: those of a blocked cell that are nearest to a node are nodes, and so is
the middle of a gap. A gap is where what is nearest to a node is as far on opposite sides of it;
others are passed over, as two narrower ones stand for each (a Gabriel graph).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.maps.grid import Grid
from viaspline.planning.routing.gap_links import ConvexPieces, GapLinks, places_near

NODES_ASIDE = 2048  # of the parts of a map that are looked at one by one
NEIGHBOURS = ((0, 1), (1, -1), (1, 0), (1, 1))  # each pair of touching cells once: row, column
HALF_DIAGONAL = math.sqrt(0.5)  # of a cell of side 1
CORNERS = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])  # of a cell


@dataclass(frozen=True)
class MapPieces:
    """The blocked cells of a map that have a side in common with a free one, as convex pieces.

    Attributes:
        grid: The map.
        owner: Its index in the world.
    """

    grid: Grid
    owner: int

    @cached_property
    def cells(self) -> Ints:
        """Row and column of each, (n, 2)."""
        return rim_cells(self.grid.blocked)

    @cached_property
    def middles(self) -> Floats:
        """[m], (n, 2)."""
        return _placed(self.grid, self.cells[:, ::-1] + 0.5)

    def pieces(self, which: Ints) -> ConvexPieces:
        """Some of them as pieces like others."""
        corners = self.cells[which][:, None, ::-1] + CORNERS
        return ConvexPieces(
            np.asarray(shapely.polygons(_placed(self.grid, corners)), object),
            np.zeros(len(which)),
            np.full(len(which), self.owner),
            self.middles[which],
        )

    def near(self, pieces: ConvexPieces, reach: float) -> Ints:
        """Which of them may be nearer than ``reach`` [m] to other pieces, (k,)."""
        return places_near(self.middles, pieces, reach + HALF_DIAGONAL * self.grid.resolution)

    def links(self, reach: float) -> GapLinks:
        """The gaps of less than ``reach`` [m] between them."""
        numbers = np.full(self.grid.blocked.shape, -1)
        numbers[tuple(self.cells.T)] = np.arange(len(self.cells))
        side = self.grid.resolution
        links = GapLinks.joined([_touching(numbers), _apart(numbers, reach / side)])
        feet = _placed(self.grid, links.feet.reshape(-1, 2, 2)).reshape(-1, 4)
        return GapLinks(links.pairs, links.widths * side, feet)


def rim_cells(blocked: Flags) -> Ints:
    """Row and column of the blocked cells that have a side in common with a free one, (n, 2)."""
    inside = np.pad(blocked, 1)
    beside = inside[:-2, 1:-1] & inside[2:, 1:-1] & inside[1:-1, :-2] & inside[1:-1, 2:]
    return np.argwhere(blocked & ~beside)


def _placed(grid: Grid, places: NDArray[Any]) -> Floats:
    """Places in cells (..., 2) as [m]."""
    x, y, yaw = grid.origin
    c, s = math.cos(yaw), math.sin(yaw)
    placed: Floats = grid.resolution * places @ np.array([[c, s], [-s, c]]) + (x, y)
    return placed


def _touching(numbers: Ints) -> GapLinks:
    """Links between cells that touch, in cells."""
    height, width = numbers.shape
    pairs, feet = [], []
    for down, right in NEIGHBOURS:
        left = max(0, -right)
        row, column = slice(0, height - down), slice(left, width - max(0, right))
        here = numbers[row, column]
        there = numbers[down:, left + right : left + right + here.shape[1]]
        at = np.argwhere((here >= 0) & (there >= 0))
        pairs.append(np.column_stack((here[tuple(at.T)], there[tuple(at.T)])))
        feet.append(at[:, ::-1] + (left + 0.5, 0.5) + 0.5 * np.array((right, down)))
    both = np.concatenate(pairs)
    return GapLinks(both, np.zeros(len(both)), np.tile(np.concatenate(feet), 2))


def _apart(numbers: Ints, reach: float) -> GapLinks:
    """Links between cells that don't touch, in cells."""
    none = GapLinks(np.empty((0, 2), np.int64), np.empty(0), np.empty((0, 4)))
    if reach <= 1.0:
        return none
    blocked = np.pad(numbers >= 0, 1)
    row, column = (np.arange(2 * n + 1) for n in numbers.shape)
    nodes = np.zeros((len(row), len(column)), np.bool_)
    for low in (0, 1):  # the cell below or left of a node, and the one above or right of it
        for left in (0, 1):
            nodes |= blocked[np.ix_((row + low + 1) // 2, (column + left + 1) // 2)]
    found = [_gaps_in(nodes, part, reach) for part in _parts(nodes.shape, math.ceil(reach) + 1)]
    first, second, widths = (np.concatenate(rows) for rows in zip(*found, strict=True))
    owner = partial(_cell_at, numbers)
    return GapLinks(
        np.column_stack((owner(first), owner(second))),
        widths,
        0.5 * np.hstack((first[:, ::-1], second[:, ::-1])),
    )


def _parts(shape: tuple[int, int], margin: int) -> Iterator[tuple[slice, slice, slice, slice]]:
    """Parts of a lattice: rows and columns with a margin, and in these those of the part itself."""
    ranges = [
        [(max(0, k - margin), k, min(k + NODES_ASIDE, n)) for k in range(0, n, NODES_ASIDE)]
        for n in shape
    ]
    for r0, r1, r2 in ranges[0]:
        for c0, c1, c2 in ranges[1]:
            yield (
                slice(r0, r2 + margin), slice(c0, c2 + margin),
                slice(r1 - r0, r2 - r0), slice(c1 - c0, c2 - c0),
            )  # fmt: skip


def _gaps_in(
    nodes: Flags, part: tuple[slice, slice, slice, slice], reach: float
) -> tuple[Ints, Ints, Floats]:
    """Nodes at both ends of gaps (k, 2), row and column, and the widths in cells (k,)."""
    from scipy.ndimage import distance_transform_edt

    blocked = nodes[part[:2]]
    nothing = np.empty((0, 2), np.int64)
    if not blocked.any() or blocked.all():
        return nothing, nothing, np.empty(0)
    away, feet = distance_transform_edt(~blocked, return_indices=True)
    inner = part[2:]
    at = np.argwhere((away[inner] > 0.0) & (away[inner] < reach))
    at += np.array((inner[0].start, inner[1].start))
    first = feet[:, at[:, 0], at[:, 1]].T.astype(np.int64)
    second = 2 * at - first
    height, width = blocked.shape
    is_in = ((second >= 0) & (second < (height, width))).all(axis=1)
    at, first, second = at[is_in], first[is_in], second[is_in]
    is_gap = blocked[tuple(second.T)]
    corner = part[0].start, part[1].start
    return first[is_gap] + corner, second[is_gap] + corner, away[tuple(at[is_gap].T)]


def _cell_at(numbers: Ints, nodes: Ints) -> Ints:
    """The numbers of cells that some nodes (n, 2) are of."""
    padded = np.pad(numbers, 1, constant_values=-1)
    around = [
        padded[(nodes[:, 0] + low + 1) // 2, (nodes[:, 1] + left + 1) // 2]
        for low in (0, 1)
        for left in (0, 1)
    ]
    found: Ints = np.max(around, axis=0)
    return found
