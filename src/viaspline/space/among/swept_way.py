"""What something that moves sweeps on a straight way, as an obstacle that stands.

Tested through ``space/among/test_plan_past_moving``.
"""

from __future__ import annotations

import math
from typing import Final

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.capsule import Capsule
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.space.among.moving_solid import HIGH_M, MovingSolid

LEAST_M: Final = 0.02


def capsule_round(one: MovingSolid, first: Floats, last: Floats, off: float, name: str) -> Obstacle:
    """A capsule that holds a body on its way; one of every height if the body is.

    Args:
        one: What moves.
        first: Where its middle is at first [m], (3,).
        last: Where it is at last [m], (3,).
        off: How far from there it may be [m].
        name: What to call the way.
    """
    radius, half, margin = one.body
    is_flat = half > 0.5 * HIGH_M
    ends = [place.tolist()[: 2 if is_flat else 3] for place in (first, last)]
    wide = (radius if is_flat else math.hypot(radius, half)) + off + margin
    capsule = {"from": ends[0], "to": ends[1], "radius": max(wide, LEAST_M)}
    return Obstacle(name=name, capsule=Capsule.model_validate(capsule))
