"""From obstacles as people write them to the arrays that kernels take."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from viaspline.errors import GeometryError
from viaspline.kernels.index import box_tree, hilbert_keys, ring_boxes
from viaspline.kernels.packed import Floats, Ints, PackedWorld
from viaspline.kernels.polygons import pack_polygons
from viaspline.mission.parts import Obstacle

Rings = Sequence[Sequence[tuple[float, float]]]


def pack(
    obstacles: Sequence[Obstacle], bounds: Sequence[float] | None, fences: Rings
) -> PackedWorld:
    """Pack obstacles, and what the robot stays inside of."""
    count = len(obstacles)
    kind = np.zeros(count, np.int64)
    slot = np.zeros(count, np.int64)
    circles: list[tuple[float, float, float]] = []
    polygons: list[Rings] = []
    for i, obstacle in enumerate(obstacles):
        circle = obstacle.circle
        if circle is not None:
            slot[i] = len(circles)
            circles.append((*circle.center, circle.radius))
        elif obstacle.polygon is not None:
            kind[i] = 1
            slot[i] = len(polygons)
            polygons.append((obstacle.polygon, *obstacle.holes))
        else:
            raise GeometryError(f"obstacle {i} has no shape: give it a circle or a polygon")
    discs = np.array(circles, np.float64).reshape(-1, 3)
    edges, polygon_blocks, block_edges = _edges(polygons)
    fence_edges, fence_starts = _fences(fences)
    block_boxes = ring_boxes(edges, block_edges)
    boxes = np.empty((count, 4))
    boxes[kind == 0, :2] = discs[:, :2] - discs[:, 2:]
    boxes[kind == 0, 2:] = discs[:, :2] + discs[:, 2:]
    if polygons:
        boxes[kind == 1] = ring_boxes(edges, block_edges[polygon_blocks])
    tree = box_tree(boxes, np.argsort(hilbert_keys(boxes), kind="stable"))
    return PackedWorld(
        kind, slot, discs, polygon_blocks, block_edges, block_boxes, edges,
        np.empty((0, 5)), np.empty((0, 3), np.int64), np.empty(0, np.int16), np.empty(0, np.int16),
        np.array([] if bounds is None else bounds, np.float64).reshape(-1, 4),
        fence_starts, fence_edges, *tree,
    )  # fmt: skip


def _fences(rings: Rings) -> tuple[Floats, Ints]:
    """Edges of fences, which run clockwise, and where each fence starts among them."""
    edges, polygon_blocks, block_edges = _edges([(ring,) for ring in rings])
    starts = block_edges[polygon_blocks]
    for first, last in pairwise(starts.tolist()):
        edges[first:last] = edges[first:last][::-1, [2, 3, 0, 1]]
    return edges, starts


def _distinct(ring: Sequence[tuple[float, float]]) -> Sequence[tuple[float, float]]:
    """A ring without vertices that repeat the one before."""
    if len(set(ring)) == len(ring):
        return ring
    return [
        vertex for vertex, before in zip(ring, (ring[-1], *ring), strict=False) if vertex != before
    ]


def _edges(polygons: Sequence[Rings]) -> tuple[Floats, Ints, Ints]:
    vertices: list[tuple[float, float]] = []
    ring_starts = [0]
    polygon_rings = [0]
    for rings in polygons:
        for ring in rings:
            vertices.extend(_distinct(ring))
            ring_starts.append(len(vertices))
        polygon_rings.append(len(ring_starts) - 1)
    packed: tuple[Floats, Ints, Ints] = pack_polygons(
        np.array(vertices, np.float64).reshape(-1, 2),
        np.array(ring_starts, np.int64),
        np.array(polygon_rings, np.int64),
    )
    return packed


def join(first: PackedWorld, second: PackedWorld) -> PackedWorld:
    """The obstacles of both worlds inside the bounds of the first, without sorting anything again.

    The second's obstacles come after the first's; a new root stands above both trees.
    """
    if not second.leaf.size:
        return first
    if not first.leaf.size:
        return second._replace(
            bounds=first.bounds, fence_edges=first.fence_edges, fences=first.fences
        )
    obstacles = first.kind.size
    left = first.leaf.size
    root = np.empty((1, 4))
    root[0, :2] = np.minimum(first.boxes[0, :2], second.boxes[0, :2])
    root[0, 2:] = np.maximum(first.boxes[0, 2:], second.boxes[0, 2:])
    leaf = np.where(second.leaf >= 0, second.leaf + obstacles, -1)
    moved = np.where(
        second.kind == 0, second.slot + len(first.circles),
        second.slot + first.polygon_blocks.size - 1,
    )  # fmt: skip
    return PackedWorld(
        kind=np.concatenate((first.kind, second.kind)),
        slot=np.concatenate((first.slot, moved)),
        circles=np.concatenate((first.circles, second.circles)),
        polygon_blocks=_chain(first.polygon_blocks, second.polygon_blocks),
        block_edges=_chain(first.block_edges, second.block_edges),
        block_boxes=np.concatenate((first.block_boxes, second.block_boxes)),
        edges=np.concatenate((first.edges, second.edges)),
        grid_frames=first.grid_frames,
        grid_shapes=first.grid_shapes,
        to_right=first.to_right,
        to_left=first.to_left,
        bounds=first.bounds,
        fence_edges=first.fence_edges,
        fences=first.fences,
        boxes=np.concatenate((root, first.boxes, second.boxes)),
        skip=np.concatenate(
            ([1 + left + second.leaf.size], first.skip + 1, second.skip + 1 + left)
        ),
        leaf=np.concatenate(([-1], first.leaf, leaf)),
    )


def _chain(first: Ints, second: Ints) -> Ints:
    return np.concatenate((first, second[1:] + first[-1]))
