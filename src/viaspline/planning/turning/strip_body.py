"""What drives along a strip, from what a path has to keep.

Tested through ``kernels/turning/test_swept_sides``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.turning.settled_strip import MOST_PLACES, STEP
from viaspline.kernels.turning.swept_sides import StripBody
from viaspline.planning.problem.requirements import Requirements
from viaspline.world.outline import outline

OUTLINE_STEP = 0.5  # from place to place on a body's outline, in its outer radii
SURELY = 2.0  # of what places see: with so much kept they come to rest where they didn't
SLACK, BODY_SLACK = 1e-3, 1e-2  # of what a disc and a body keep, that is kept beyond it


def strip_bodies(needs: Requirements, length: float) -> tuple[StripBody, ...]:
    """What drives along a run, as strips take it, in the order in which it is to be tried.

    A strip has so many places at most. Along a long run those are far apart for a small robot, and
    corners that it just passes lie between two of them, unseen. Where a little more is kept they
    are seen, and the path is hardly longer for it. Where there is no room for that, what has to be
    kept is.

    Args:
        needs: What is to be kept.
        length: Of the run [m].

    Example:
        >>> corners = (-1.0, -1.0), (3.0, -1.0), (3.0, 1.0), (-1.0, 1.0)
        >>> cart = Requirements(radius=1.0, clearance=0.3, footprint=corners)
        >>> strip_bodies(cart, 100.0)[0].outline[:4, 0].round(2).tolist()
        [-1.0, 0.33, 1.67, 3.0]
        >>> rover = Requirements(radius=0.2, clearance=0.0)
        >>> [round(body.required, 3) for body in strip_bodies(rover, 1000.0)]
        [0.417, 0.833, 0.2]
    """
    seen = length / (MOST_PLACES * STEP)
    kept = (max(needs.required, seen), max(needs.required, SURELY * seen), needs.required)
    return tuple(_strip_body(needs, one - needs.required) for one in dict.fromkeys(kept))


def _strip_body(needs: Requirements, beside: float) -> StripBody:
    """It, with so much more kept beside it than is to be [m]."""
    required, kept = needs.required + beside, needs.least + beside
    if needs.footprint is None:
        return StripBody(required, kept, SLACK, np.empty((0, 2)))
    corners, step = outline(needs.footprint), OUTLINE_STEP * needs.outer_radius
    edges = [
        np.linspace(one, other, math.ceil(math.dist(one, other) / step), endpoint=False)
        for one, other in zip(corners, np.roll(corners, -1, axis=0), strict=True)
    ]
    return StripBody(required, kept, BODY_SLACK, np.concatenate(edges))
