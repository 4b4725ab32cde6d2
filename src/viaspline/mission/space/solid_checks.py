"""Do the heights of obstacles make sense?

Tested through ``mission/space/test_spatial_checks``.
"""

from __future__ import annotations

from collections.abc import Iterator

from viaspline.errors import with_article
from viaspline.mission.shapes.obstacle import HAVING_HEIGHTS, Obstacle
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number


def height_faults(path: Path, obstacle: Obstacle) -> Iterator[UnplacedFault]:
    """What is wrong with the floor and the roof of an obstacle, and with sides that need them."""
    own = next((key for key in HAVING_HEIGHTS if getattr(obstacle, key) is not None), None)
    if own is None and obstacle.capsule is not None and obstacle.capsule.is_spatial:
        own = "capsule of three numbers"
    if obstacle.height_m is not None:
        low, high = obstacle.height_m
        if own is not None:
            what = "map of voxels" if own == "voxels" else own
            problem = f"{with_article(what)} has heights of its own"
            yield UnplacedFault((*path, "height_m"), problem, "leave it out", at_key=True)
        elif low >= high:
            problem = f"its floor at {number(low, 6)} isn't below its roof at {number(high, 6)}"
            yield UnplacedFault((*path, "height_m"), problem, "height_m is [low, high]")
    elif own is None:
        for key in ("pass_on", "never_pass_on"):
            side = getattr(obstacle, key)
            if side in ("over", "under"):
                end = "roof" if side == "over" else "floor"
                problem = f"it has no {end}: without height_m it reaches over every height"
                yield UnplacedFault((*path, key), problem, "give height_m: [low, high]")
