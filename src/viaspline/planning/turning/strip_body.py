"""What drives along a strip, from what a path has to keep.

Tested through ``kernels/turning/test_swept_sides``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.turning.swept_sides import StripBody
from viaspline.planning.problem.requirements import Requirements
from viaspline.world.outline import outline

OUTLINE_STEP = 0.5  # from place to place on a body's outline, in its outer radii
SLACK, BODY_SLACK = 1e-3, 1e-2  # of what a disc and a body keep, that is kept beyond it


def strip_body(needs: Requirements) -> StripBody:
    """What drives, as strips take it.

    Example:
        >>> corners = (-1.0, -1.0), (3.0, -1.0), (3.0, 1.0), (-1.0, 1.0)
        >>> cart = Requirements(radius=1.0, clearance=0.3, footprint=corners)
        >>> strip_body(cart).outline[:4, 0].round(2).tolist()
        [-1.0, 0.33, 1.67, 3.0]
    """
    if needs.footprint is None:
        return StripBody(needs.required, needs.least, SLACK, np.empty((0, 2)))
    corners, step = outline(needs.footprint), OUTLINE_STEP * needs.outer_radius
    edges = [
        np.linspace(one, other, math.ceil(math.dist(one, other) / step), endpoint=False)
        for one, other in zip(corners, np.roll(corners, -1, axis=0), strict=True)
    ]
    return StripBody(needs.required, needs.least, BODY_SLACK, np.concatenate(edges))
