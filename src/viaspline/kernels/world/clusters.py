"""Which obstacles stand so close together that nothing passes between them."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.distance import polygon_signed
from viaspline.kernels.world.grid_gap import grid_gap, grids_gap
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.segment import box_gap, obstacle_segment


@inner
def obstacle_gap(world: PackedWorld, i: int, j: int, limit: float) -> float:
    """Distance between the discs or polygons i and j [m]; not above 0 where they overlap."""
    if world.kind[i] == 0 or world.kind[j] == 0:
        disc = i if world.kind[i] == 0 else j
        other = j if disc == i else i
        circle = world.circles[world.slot[disc]]
        if world.kind[other] == 0:
            second = world.circles[world.slot[other]]
            return np.hypot(circle[0] - second[0], circle[1] - second[1]) - circle[2] - second[2]
        return polygon_signed(world, world.slot[other], circle[0], circle[1], np.inf) - circle[2]
    best = limit
    for p, other in ((i, j), (j, i)):
        slot = world.slot[p]
        first = world.block_edges[world.polygon_blocks[slot]]
        last = world.block_edges[world.polygon_blocks[slot + 1]]
        for e in range(first, last):
            edge = world.edges[e]
            gap = obstacle_segment(world, other, edge[0], edge[1], edge[2], edge[3], best)
            best = min(best, gap)
    return best


@inner
def _root(parent: Ints, i: int) -> int:
    while parent[i] != i:
        parent[i] = parent[parent[i]]
        i = parent[i]
    return i


@kernel
def _labels(world: PackedWorld, width: float) -> Ints:
    """Labels of discs and polygons; every grid is by itself."""
    count = world.kind.size
    parent = np.arange(count)
    for leaf in range(world.leaf.size):
        i = world.leaf[leaf]
        if i < 0 or world.kind[i] == 2:
            continue
        box = world.boxes[leaf]
        node = 0
        while node < world.leaf.size:
            if box_gap(world.boxes, node, box[0], box[1], box[2], box[3]) >= width:
                node = world.skip[node]
                continue
            j = world.leaf[node]
            node += 1
            if j <= i or world.kind[j] == 2:
                continue
            first = _root(parent, i)
            second = _root(parent, j)
            if first != second and obstacle_gap(world, i, j, width) < width:
                parent[max(first, second)] = min(first, second)
    for i in range(count):
        parent[i] = _root(parent, i)
    return parent


@inner
def _unite(parent: Ints, i: int, j: int) -> None:
    first = _root(parent, i)
    second = _root(parent, j)
    parent[max(first, second)] = min(first, second)


@kernel
def _join_grids(world: PackedWorld, width: float, parent: Ints) -> None:
    """Join the groups of every grid and of the discs and polygons that are near to it."""
    for i in range(parent.size):
        if world.kind[i] == 2:
            for j in range(parent.size):
                if world.kind[j] != 2 and grid_gap(world, i, j, width) < width:
                    _unite(parent, i, j)


@kernel
def _join_pairs_of_grids(world: PackedWorld, width: float, parent: Ints) -> None:
    """Join the groups of grids that are near to each other."""
    for i in range(parent.size):
        if world.kind[i] == 2:
            for j in range(i):
                if world.kind[j] == 2 and grids_gap(world, i, j, width) < width:
                    _unite(parent, i, j)


@kernel
def _settle(parent: Ints) -> None:
    """Make every entry the root of its tree."""
    for i in range(parent.size):
        parent[i] = _root(parent, i)


def group_labels(world: PackedWorld, width: float) -> Ints:
    """Label of every obstacle's group, (n,): the smallest index of its members.

    Two obstacles are of one group when a gap narrower than ``width`` [m] is between them.
    """
    labels = _labels(world, width)
    grids = world.grid_frames.shape[0]
    if grids and grids < labels.size:  # only who has both waits for it to be compiled
        _join_grids(world, width, labels)
    if grids > 1:
        _join_pairs_of_grids(world, width, labels)
    if grids:
        _settle(labels)
    return labels
