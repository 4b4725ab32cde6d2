"""Moving obstacles as they stand at an instant: what rays and distances of still worlds take."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.world.box_tree import ring_boxes
from viaspline.kernels.world.packed import PackedWorld
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.tree_growth import tree_over


def shapes_at(moving: MovingObstacles, time: float) -> PackedWorld:
    """The shapes of moving obstacles where they are at an instant, packed.

    Only places are reckoned anew: what was packed once is moved and turned. Obstacles keep their
    indices; one that isn't there has its place in the arrays and no leaf in the tree.

    Args:
        moving: Obstacles, none of them a map of squares.
        time: By the clock of their motion [s].

    Example:
        >>> from viaspline.kernels.sensing.raycast import cast
        >>> from viaspline.mission.shapes.obstacle import Obstacle
        >>> cart = Obstacle(
        ...     circle={"center": (0, 0), "radius": 1},
        ...     motion={"from": (0, 0), "velocity_mps": (2, 0)},
        ... )
        >>> cast(shapes_at(MovingObstacles([cart]), 3.0), 0.0, 0.0, 0.0, 1.0, beams=1, reach=9.0)
        array([5.])
    """
    shapes, frames = moving.packed.shapes, moving.frames(time)
    present = np.flatnonzero(~np.isnan(frames[:, 0]))
    edges = _placed(shapes, np.nan_to_num(frames))
    heads = shapes.heads.copy()
    heads[:, :2] = edges[shapes.ring_edges[:-1], :2]
    grown = heads[:, 2:3] * np.array([-1.0, -1.0, 1.0, 1.0])
    tree = tree_over((ring_boxes(edges, shapes.ring_edges) + grown)[present])
    leaf: Ints = np.full(tree.leaf.size, -1, np.int64)
    leaf[tree.leaf >= 0] = present[tree.leaf[tree.leaf >= 0]]
    return shapes._replace(
        heads=heads,
        edges=edges,
        block_boxes=ring_boxes(edges, shapes.block_edges),
        boxes=tree.boxes,
        skip=tree.skip,
        leaf=leaf,
    )


def _placed(shapes: PackedWorld, frames: Floats) -> Floats:
    """The edges of rings, each moved and turned with its frame, (e, 4)."""
    x, y, heading = np.repeat(frames, np.diff(shapes.ring_edges), axis=0).T
    c, s = np.cos(heading), np.sin(heading)
    x0, y0, x1, y1 = shapes.edges.T
    return np.ascontiguousarray(
        np.column_stack(
            (x + c * x0 - s * y0, y + s * x0 + c * y0, x + c * x1 - s * y1, y + s * x1 + c * y1)
        )
    )
