"""Which obstacles stand so close together that nothing passes between them.

Tested through ``kernels/world/test_distance``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.grid_gap import grid_gap, grids_gap
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.plane import box_gap
from viaspline.kernels.world.ring_distance import rings_gap
from viaspline.kernels.world.shape import is_ring


@inner
def _root(parent: Ints, i: int) -> int:
    while parent[i] != i:
        parent[i] = parent[parent[i]]
        i = parent[i]
    return i


@kernel
def _labels(world: PackedWorld, width: float) -> Ints:
    """Labels of rounded rings; every grid is by itself."""
    count = world.slot.size
    parent = np.arange(count)
    for leaf in range(world.leaf.size):
        i = world.leaf[leaf]
        if i < 0 or not is_ring(world, i):
            continue
        box = world.boxes[leaf]
        node = 0
        while node < world.leaf.size:
            if box_gap(world.boxes, node, box[0], box[1], box[2], box[3]) >= width:
                node = world.skip[node]
                continue
            j = world.leaf[node]
            node += 1
            if j <= i or not is_ring(world, j):
                continue
            first = _root(parent, i)
            second = _root(parent, j)
            if first != second and rings_gap(world, world.slot[i], world.slot[j], width) < width:
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
    """Join the groups of every grid and of the rounded rings that are near to it."""
    for i in range(parent.size):
        if not is_ring(world, i):
            for j in range(parent.size):
                if is_ring(world, j) and grid_gap(world, i, j, width) < width:
                    _unite(parent, i, j)


@kernel
def _join_pairs_of_grids(world: PackedWorld, width: float, parent: Ints) -> None:
    """Join the groups of grids that are near to each other."""
    for i in range(parent.size):
        if not is_ring(world, i):
            for j in range(i):
                if not is_ring(world, j) and grids_gap(world, i, j, width) < width:
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
