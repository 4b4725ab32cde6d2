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


@inner
def _next_unmet(ahead: Ints, node: int) -> int:
    """The first node from this one on that is the leaf of a ring of no group yet."""
    while ahead[node] != node:
        ahead[node] = ahead[ahead[node]]
        node = ahead[node]
    return node


@inner
def _meet(
    world: PackedWorld, ring: int, width: float, leaf_of: Ints, ahead: Ints, met: Ints, count: int
) -> int:
    """Put the rings of no group yet that are near to a ring at the end of those that were met.

    Returns:
        How many have been met then.
    """
    box = world.boxes[leaf_of[ring]]
    node = 0
    while node < world.leaf.size:
        if _next_unmet(ahead, node) >= world.skip[node] or (
            box_gap(world.boxes, node, box[0], box[1], box[2], box[3]) >= width
        ):
            node = world.skip[node]
            continue
        other = world.leaf[node]
        if other >= 0 and rings_gap(world, world.slot[ring], world.slot[other], width) < width:
            ahead[node] = node + 1
            met[count] = other
            count += 1
        node += 1
    return count


@kernel
def _labels(world: PackedWorld, width: float) -> Ints:
    """Labels of rounded rings; every grid is by itself.

    A group grows from its smallest index on. A ring that it has met isn't looked at again, nor is a
    node all of whose rings were met: so a crowd costs about what its rings cost, not its pairs.
    """
    labels = np.arange(world.slot.size)
    leaf_of, met = np.empty_like(labels), np.empty_like(labels)
    ahead = np.arange(world.leaf.size + 1)
    for node in range(world.leaf.size):
        i = world.leaf[node]
        if i >= 0:
            leaf_of[i] = node
        if i < 0 or not is_ring(world, i):
            ahead[node] = node + 1
    for i in range(labels.size):
        if ahead[leaf_of[i]] != leaf_of[i]:
            continue  # a grid, or it is of a group
        ahead[leaf_of[i]] += 1
        met[0] = i
        count, looked = 1, 0
        while looked < count:
            labels[met[looked]] = i
            count = _meet(world, met[looked], width, leaf_of, ahead, met, count)
            looked += 1
    return labels


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
