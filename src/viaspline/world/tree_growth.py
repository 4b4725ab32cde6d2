"""The tree of boxes of a world to which obstacles come one after the other.

What came last stands in a small tree of its own beside the large one, and goes into that when there
is too much of it: so one more obstacle costs as much as the small tree, and the large one is sorted
seldom. When it is, depends on how many obstacles there are and not on how many came at once; so the
same obstacles in the same order make the same tree, whatever batches they came in.

Tested through ``world/test_world``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.world.box_tree import box_tree, hilbert_keys
from viaspline.kernels.world.packed import PackedWorld

MAX_LOOSE = 64
"""Obstacles that may stand beside a tree; more beside one that has more than their square."""


class BoxTree(NamedTuple):
    """Nodes in depth-first order: their boxes (t, 4), where to go on, and what is in the leaves."""

    boxes: Floats
    skip: Ints
    leaf: Ints


def tree_over(boxes: Floats) -> BoxTree:
    """The tree over the boxes of obstacles [m], shape (n, 4)."""
    return BoxTree(*box_tree(boxes, np.argsort(hilbert_keys(boxes), kind="stable")))


def settled_of(settled: int, count: int) -> int:
    """How many obstacles are in the large tree when there are ``count``; ``settled`` were before.

    >>> settled_of(100, 164), settled_of(100, 165), settled_of(100, 300)
    (100, 165, 295)
    """
    while (loose := max(MAX_LOOSE, math.isqrt(settled))) < count - settled:
        settled += loose + 1
    return settled


def grown(world: PackedWorld, settled: int, new: Floats) -> tuple[BoxTree, int]:
    """The tree of a world to which obstacles come, and how many of them are in the large tree.

    Args:
        world: What there was.
        settled: How many of its obstacles, its first ones, are in its large tree.
        new: Boxes of what comes to it [m], shape (k, 4).
    """
    count = world.slot.size
    boxes = np.concatenate((leaf_boxes(world), new))
    now = settled_of(settled, len(boxes))
    large = _large(world, settled, count) if now == settled else tree_over(boxes[:now])
    return _side_by_side(large, tree_over(boxes[now:]), now), now


def leaf_boxes(world: PackedWorld) -> Floats:
    """The box of each obstacle [m], shape (n, 4)."""
    leaves = np.flatnonzero(world.leaf >= 0)
    boxes = np.empty((leaves.size, 4))
    boxes[world.leaf[leaves]] = world.boxes[leaves]
    return boxes


def _large(world: PackedWorld, settled: int, count: int) -> BoxTree:
    """The large tree: all of a world's own, or what stands first below its root."""
    if settled in (0, count):
        end = 0 if settled == 0 else world.leaf.size
        return BoxTree(world.boxes[:end], world.skip[:end], world.leaf[:end])
    end = int(world.skip[1])
    return BoxTree(world.boxes[1:end], world.skip[1:end] - 1, world.leaf[1:end])


def _side_by_side(first: BoxTree, second: BoxTree, settled: int) -> BoxTree:
    """Two trees below one root; the leaves of the second count on from the first's."""
    if not (first.leaf.size and second.leaf.size):
        return first if first.leaf.size else second
    root = np.concatenate(
        (np.minimum(first.boxes[0, :2], second.boxes[0, :2]),
         np.maximum(first.boxes[0, 2:], second.boxes[0, 2:]))
    )  # fmt: skip
    after = 1 + first.leaf.size
    return BoxTree(
        boxes=np.concatenate((root[None], first.boxes, second.boxes)),
        skip=np.concatenate(([after + second.leaf.size], first.skip + 1, second.skip + after)),
        leaf=np.concatenate(
            ([-1], first.leaf, np.where(second.leaf >= 0, second.leaf + settled, -1))
        ),
    )
