"""Packing rings of vertices into oriented edges and blocks of edges."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel

BLOCK = 16  # consecutive edges that share a box


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
def pack_polygons(
    vertices: Floats, ring_starts: Ints, polygon_rings: Ints
) -> tuple[Floats, Ints, Ints]:
    """Turn polygons into edges that run anticlockwise outside and clockwise round holes.

    Args:
        vertices: All rings' vertices [m], not closed, (v, 2).
        ring_starts: Ring r is ``vertices[ring_starts[r]:ring_starts[r + 1]]``.
        polygon_rings: Polygon p has the rings ``polygon_rings[p]:polygon_rings[p + 1]``, the first
            of them its outer one.

    Returns:
        (edges (v, 4), polygon_blocks, block_edges), as in PackedWorld.
    """
    total = vertices.shape[0]
    rings = ring_starts.size - 1
    edges = np.empty((total, 4))
    polygon_blocks = np.zeros(polygon_rings.size, np.int64)
    block_edges = np.zeros(total // BLOCK + rings + 1, np.int64)
    block = 0
    for p in range(polygon_rings.size - 1):
        for r in range(polygon_rings[p], polygon_rings[p + 1]):
            first = ring_starts[r]
            last = ring_starts[r + 1]
            count = last - first
            forwards = (_twice_area(vertices, first, last) > 0.0) == (r == polygon_rings[p])
            for k in range(count):
                start = first + (k if forwards else count - 1 - k)
                end = first + ((k + 1) % count if forwards else (2 * count - 2 - k) % count)
                edges[first + k, 0] = vertices[start, 0]
                edges[first + k, 1] = vertices[start, 1]
                edges[first + k, 2] = vertices[end, 0]
                edges[first + k, 3] = vertices[end, 1]
            for k in range(0, count, BLOCK):
                block += 1
                block_edges[block] = first + min(k + BLOCK, count)
        polygon_blocks[p + 1] = block
    return edges, polygon_blocks, block_edges[: block + 1].copy()
