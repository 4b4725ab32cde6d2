"""Packing closed loops of vertices into oriented edges and blocks of edges.

Tested through ``kernels/world/test_distance``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel

EDGES_PER_BLOCK = 16  # consecutive edges that share a box


@inner
def _twice_area(vertices: Floats, first: int, last: int) -> float:
    area = 0.0
    x0 = vertices[first, 0]
    y0 = vertices[first, 1]
    for k in range(first, last):
        following = k + 1 if k + 1 < last else first
        area += (vertices[k, 0] - x0) * (vertices[following, 1] - y0)
        area -= (vertices[following, 0] - x0) * (vertices[k, 1] - y0)
    return area


@kernel
def pack_rings(vertices: Floats, loop_starts: Ints, ring_loops: Ints) -> tuple[Floats, Ints, Ints]:
    """Turn rings into edges that run anticlockwise outside and clockwise round holes.

    Args:
        vertices: All loops' vertices [m], not closed, (v, 2); a loop may be one vertex, or two.
        loop_starts: Loop l is ``vertices[loop_starts[l]:loop_starts[l + 1]]``.
        ring_loops: Ring r has the loops ``ring_loops[r]:ring_loops[r + 1]``, the first of them its
            outer one, the others its holes.

    Returns:
        (edges (v, 4), ring_blocks, block_edges), as in PackedWorld.
    """
    total = vertices.shape[0]
    loops = loop_starts.size - 1
    edges = np.empty((total, 4))
    ring_blocks = np.zeros(ring_loops.size, np.int64)
    block_edges = np.zeros(total // EDGES_PER_BLOCK + loops + 1, np.int64)
    block = 0
    for ring in range(ring_loops.size - 1):
        for loop in range(ring_loops[ring], ring_loops[ring + 1]):
            first = loop_starts[loop]
            last = loop_starts[loop + 1]
            count = last - first
            forwards = (_twice_area(vertices, first, last) > 0.0) == (loop == ring_loops[ring])
            for k in range(count):
                start = first + (k if forwards else count - 1 - k)
                end = first + ((k + 1) % count if forwards else (2 * count - 2 - k) % count)
                edges[first + k, 0] = vertices[start, 0]
                edges[first + k, 1] = vertices[start, 1]
                edges[first + k, 2] = vertices[end, 0]
                edges[first + k, 3] = vertices[end, 1]
            for k in range(0, count, EDGES_PER_BLOCK):
                block += 1
                block_edges[block] = first + min(k + EDGES_PER_BLOCK, count)
        ring_blocks[ring + 1] = block
    return edges, ring_blocks, block_edges[: block + 1].copy()
