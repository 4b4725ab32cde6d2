"""Building a packed world: boxes of obstacles, and a tree of boxes in depth-first order.

Tested through ``kernels/world/test_distance``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel

CHILDREN_PER_NODE = 4


@kernel
def hilbert_keys(boxes: Floats) -> Ints:
    """Place of every box's centre on a Hilbert curve over all of them, (n,) of int64."""
    count = boxes.shape[0]
    keys = np.empty(count, np.int64)
    low_x = np.inf
    low_y = np.inf
    high = 0.0
    for i in range(count):
        low_x = min(low_x, boxes[i, 0] + boxes[i, 2])
        low_y = min(low_y, boxes[i, 1] + boxes[i, 3])
    for i in range(count):
        high = max(high, boxes[i, 0] + boxes[i, 2] - low_x)
        high = max(high, boxes[i, 1] + boxes[i, 3] - low_y)
    scale = 65535.0 / high if high > 0.0 else 0.0
    for i in range(count):
        x = np.int64((boxes[i, 0] + boxes[i, 2] - low_x) * scale)
        y = np.int64((boxes[i, 1] + boxes[i, 3] - low_y) * scale)
        key = np.int64(0)
        side = np.int64(32768)
        while side > 0:
            right = np.int64(1) if x & side else np.int64(0)
            upper = np.int64(1) if y & side else np.int64(0)
            key += side * side * ((3 * right) ^ upper)
            if upper == 0:
                if right == 1:
                    x = 65535 - x
                    y = 65535 - y
                x, y = y, x
            side //= 2
        keys[i] = key
    return keys


@kernel
def box_tree(boxes: Floats, order: Ints) -> tuple[Floats, Ints, Ints]:
    """A tree over boxes (n, 4) taken in ``order`` (n,), its nodes in depth-first order.

    Returns:
        (boxes (t, 4), skip (t,), leaf (t,)), as in PackedWorld.
    """
    count = order.size
    nodes = np.empty((2 * count + 1, 4))
    skip = np.empty(2 * count + 1, np.int64)
    leaf = np.full(2 * count + 1, -1, np.int64)
    pending = np.empty((64 * CHILDREN_PER_NODE, 2), np.int64)
    size = 0
    depth = 0
    if count > 0:
        pending[0, 0] = 0
        pending[0, 1] = count
        depth = 1
    while depth > 0:
        depth -= 1
        first = pending[depth, 0]
        last = pending[depth, 1]
        if last - first == 1:
            leaf[size] = order[first]
            skip[size] = size + 1
        else:
            skip[size] = last - first  # the number of leaves below, for now
            parts = min(CHILDREN_PER_NODE, last - first)
            for part in range(parts - 1, -1, -1):
                pending[depth, 0] = first + part * (last - first) // parts
                pending[depth, 1] = first + (part + 1) * (last - first) // parts
                depth += 1
        size += 1
    _close(nodes, skip, leaf, boxes, size)
    return nodes[:size].copy(), skip[:size].copy(), leaf[:size].copy()


@inner
def _close(nodes: Floats, skip: Ints, leaf: Ints, boxes: Floats, size: int) -> None:
    """Give every node its box and its skip, from the last one back."""
    for node in range(size - 1, -1, -1):
        if leaf[node] >= 0:
            for side in range(4):  # a row at once takes numba two more seconds to compile
                nodes[node, side] = boxes[leaf[node], side]
            continue
        leaves = skip[node]
        nodes[node, 0] = np.inf
        nodes[node, 1] = np.inf
        nodes[node, 2] = -np.inf
        nodes[node, 3] = -np.inf
        child = node + 1
        while leaves > 0:
            leaves -= _leaves(skip, leaf, child)
            nodes[node, 0] = min(nodes[node, 0], nodes[child, 0])
            nodes[node, 1] = min(nodes[node, 1], nodes[child, 1])
            nodes[node, 2] = max(nodes[node, 2], nodes[child, 2])
            nodes[node, 3] = max(nodes[node, 3], nodes[child, 3])
            child = skip[child]
        skip[node] = child


@inner
def _leaves(skip: Ints, leaf: Ints, node: int) -> int:
    count = 0
    for k in range(node, skip[node]):
        if leaf[k] >= 0:
            count += 1
    return count


def ring_boxes(edges: Floats, starts: Ints) -> Floats:
    """Box of every run ``starts[k]:starts[k + 1]`` of edges (e, 4), shape (k, 4)."""
    boxes = np.empty((starts.size - 1, 4))
    boxes[:, :2] = np.inf
    boxes[:, 2:] = -np.inf
    filled = np.flatnonzero(starts[1:] > starts[:-1])
    if filled.size:
        first = starts[filled]
        for axis in range(2):
            one, other = edges[:, axis], edges[:, 2 + axis]
            boxes[filled, axis] = np.minimum.reduceat(np.minimum(one, other), first)
            boxes[filled, 2 + axis] = np.maximum.reduceat(np.maximum(one, other), first)
    return boxes
