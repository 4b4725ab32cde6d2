"""Does the altitude band make sense, and is there a ground where heights count from one?

Tested through ``mission/space/test_spatial_checks``.
"""

from __future__ import annotations

from collections.abc import Iterator

from viaspline.mission.space.spatial_parts import SpatialParts
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number

GROUND_REMEDY = "give world.ground: {flat_m: 0} or {terrain: dem.tif}"


def altitude_faults(space: SpatialParts) -> Iterator[UnplacedFault]:
    """What is wrong with the altitude band by itself."""
    altitude = space.altitude
    if altitude is None:
        return
    path: Path = ("world", "altitude")
    if altitude.is_upside_down:
        assert altitude.min_m is not None
        assert altitude.max_m is not None
        low, high = number(altitude.min_m, 6), number(altitude.max_m, 6)
        problem = f"min_m {low} is not less than max_m {high}"
        yield UnplacedFault(path, problem, "the band is from min_m up to max_m")
    if altitude.above != "home" and not space.has_ground:
        zero = "the ground" if altitude.above == "ground" else "sea level"
        problem = f"heights above {zero} are asked for, but the world has no ground"
        remedy = f"{GROUND_REMEDY}, or above: home"
        yield UnplacedFault((*path, "above"), problem, remedy)
