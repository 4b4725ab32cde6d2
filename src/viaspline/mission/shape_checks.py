"""Has every obstacle one shape, and do shapes, fences and speed zones cover an area?

Tested through ``mission/test_model``.
"""

from __future__ import annotations

from viaspline.mission.partial_mission import PartialMission
from viaspline.mission.shapes.obstacle import KINDS, SHAPES, SOLID_KINDS, Obstacle
from viaspline.mission.shapes.polygon import Polygon
from viaspline.mission.space.solid_checks import height_faults
from viaspline.mission.unplaced_faults import Path, UnplacedFault


def shape_faults(partial: PartialMission) -> list[UnplacedFault]:
    """Obstacles without a shape or with two, and what is wrong with those that there are."""
    obstacles = partial.known + partial.unseen
    faults = [fault for path, obstacle in obstacles for fault in _one_shape(path, obstacle)]
    rings = partial.fences + partial.zones
    faults += Polygon.faults((path, Polygon(ring)) for path, ring in rings)
    for key, kind in KINDS.items():
        faults += kind.faults(
            ((*path, key), shape)
            for path, obstacle in obstacles
            for name, shape in obstacle.shapes()
            if name == key
        )
    for key, kind in SOLID_KINDS.items():
        faults += kind.faults(
            ((*path, key), getattr(obstacle, key))
            for path, obstacle in obstacles
            if getattr(obstacle, key) is not None
        )
    return faults


def _one_shape(path: Path, obstacle: Obstacle) -> list[UnplacedFault]:
    faults = []
    given = [name for name in SHAPES if getattr(obstacle, name) is not None]
    if not given:
        examples = ", ".join(kind.EXAMPLE for kind in KINDS.values())
        faults.append(
            UnplacedFault(path, "the obstacle has no shape", f"give {examples} or map: FILE")
        )
    if len(given) > 1:
        problem = f"the obstacle has two shapes, {given[0]} and {given[1]}"
        faults.append(UnplacedFault(path, problem, "keep one, or make it two obstacles"))
    if obstacle.holes and obstacle.polygon is None:
        problem = "there are holes, but no polygon that has them"
        faults.append(UnplacedFault((*path, "holes"), problem, "give polygon, or leave out holes"))
    if obstacle.is_spatial:
        faults += height_faults(path, obstacle)
    return faults
