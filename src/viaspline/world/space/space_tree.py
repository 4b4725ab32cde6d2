"""A tree over boxes in space, halved where they lie farthest apart, its nodes in depth-first order.

Tested through ``kernels/space/test_space_distance``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints


def space_tree(boxes: Floats) -> tuple[Floats, Ints, Ints]:
    """The tree over boxes; all of its nodes on one level are made at once.

    Args:
        boxes: x, y, z low and high [m], (n, 6); heights may be infinite.

    Returns:
        (boxes (2 n - 1, 6), skip, leaf), as in PackedSpace.

    >>> space_tree(np.array([[0, 0, 0, 1, 1, 1], [5, 0, 0, 6, 1, 1.0]]))[1:]
    (array([3, 2, 3]), array([-1,  0,  1]))
    """
    count = len(boxes)
    if count == 1:
        return boxes.copy(), np.ones(1, np.int64), np.zeros(1, np.int64)
    nodes = np.empty((max(2 * count - 1, 0), 6))
    skip = np.empty(len(nodes), np.int64)
    leaf = np.full(len(nodes), -1, np.int64)
    middles = _middles(boxes)
    order = np.arange(count)
    starts, places = (np.zeros(min(count, 1), np.int64) for _ in range(2))
    while starts.size:
        ends = np.append(starts[1:], order.size)
        sizes = ends - starts
        sorted_boxes = boxes[order]
        nodes[places, :3] = np.minimum.reduceat(sorted_boxes[:, :3], starts)
        nodes[places, 3:] = np.maximum.reduceat(sorted_boxes[:, 3:], starts)
        skip[places] = places + 2 * sizes - 1
        leaf[places[sizes == 1]] = order[starts[sizes == 1]]
        # what is a leaf is done: its box leaves the order
        inner = sizes > 1
        order = order[np.repeat(inner, sizes)]
        places, sizes = places[inner], sizes[inner]
        if not sizes.size:
            break
        starts = np.cumsum(sizes) - sizes
        order = _sorted_along(middles, order, starts, sizes)
        left = sizes // 2
        starts = np.column_stack((starts, starts + left)).ravel()
        places = np.column_stack((places + 1, places + 2 * left)).ravel()
    return nodes, skip, leaf


def _middles(boxes: Floats) -> Floats:
    """The middle of each box; along an axis without an end the end that there is, or 0."""
    low, high = boxes[:, :3], boxes[:, 3:]
    one = np.where(np.isfinite(low), low, np.where(np.isfinite(high), high, 0.0))
    return 0.5 * one + 0.5 * np.where(np.isfinite(high), high, one)


def _sorted_along(middles: Floats, order: Ints, starts: Ints, sizes: Ints) -> Ints:
    """The boxes of each run sorted along the axis on which their middles lie farthest apart."""
    placed = middles[order]
    spread = np.maximum.reduceat(placed, starts) - np.minimum.reduceat(placed, starts)
    axis = np.repeat(spread.argmax(axis=1), sizes)
    run = np.repeat(np.arange(sizes.size), sizes)
    return order[np.lexsort((placed[np.arange(order.size), axis], run))]
