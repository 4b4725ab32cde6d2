"""What a polygonal body comes too close to, span by span: for planning."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance import footprint_walk as kernels
from viaspline.kernels.world.packed import PackedWorld


def body_conflicts(
    packed: PackedWorld,
    spans: Floats,
    footprint: Floats,
    required: float,
    *,
    arrival: float = math.nan,
) -> NDArray[np.int64]:
    """What the body comes nearer to than is required on each span, its heading along the tangent.

    Args:
        packed: The world's packed form.
        spans: Bézier control polygons [m], (m, 4, d), each from where the one before ends.
        footprint: As from ``viaspline.world.outline`` [m], (k, 2): not checked here.
        required: Distance to be kept [m]; a tenth of a micrometre more is asked for.
        arrival: Heading before the first span [rad], from which the body turns on the spot; not
            given: it starts as the span does.

    Returns:
        Shape (m,): -1 where a span is proven clear, the turn on the spot before it included;
        elsewhere the index of what is too close, as in ``World.nearest``. That all are -1 proves
        the whole motion.

    Example:
        >>> from viaspline.mission.shapes.obstacle import Obstacle
        >>> from viaspline.world.world import World
        >>> world = World([Obstacle(circle={"center": (5, 3), "radius": 1})])
        >>> spans = np.array([[(0, 0), (1, 0), (2, 0), (3, 0)], [(3, 0), (5, 0), (7, 0), (9, 0)]])
        >>> body = np.array([(-0.5, -1.5), (0.5, -1.5), (0.5, 1.5), (-0.5, 1.5)])
        >>> body_conflicts(world.packed, spans.astype(float), body, 0.6)
        array([-1,  0])
    """
    writable = spans if spans.flags.writeable else spans.copy()  # numba compiles for one kind
    found: NDArray[np.int64] = kernels.body_conflicts(
        packed, writable, footprint, float(arrival), float(required)
    )
    return found
