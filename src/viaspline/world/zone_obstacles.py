"""Speed zones as obstacles: what stands where a path isn't to lead through them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.world_spec import SpeedZone

ARC_PARTS = 64
"""Straight parts of a quarter of a circle: they lie inside of it by 8e-5 of its radius."""

DRAWN_IN = 0.99
"""Of what would just keep the sharpest corner out of reach."""


def zone_obstacles(zones: Sequence[SpeedZone], required: float) -> tuple[Obstacle, ...]:
    """Obstacles that keep a robot's reference point outside of zones, hardly farther off.

    A zone is drawn in by as much as still keeps its corners out of reach. One that is narrower than
    that stands as it is.

    Args:
        zones: The zones.
        required: What the robot keeps from obstacles, from its reference point on [m].

    Example:
        >>> ring = [(0, 0), (9, 0), (9, 4), (0, 4)]
        >>> [lane] = zone_obstacles([SpeedZone(polygon=ring, max_speed_mps=1, name="lane")], 1.0)
        >>> lane.name, round(min(y for _, y in lane.polygon), 3)
        ("speed zone 'lane'", 0.7)
    """
    return tuple(
        Obstacle(name=_name(zone), polygon=ring)
        for zone in zones
        for ring in _drawn_in(zone.corners, required)
    )


def _name(zone: SpeedZone) -> str:
    return "a speed zone" if zone.name is None else f"speed zone '{zone.name}'"


def _drawn_in(corners: Floats, required: float) -> list[list[tuple[float, float]]]:
    """The rings from which a robot keeps out of an area."""
    import shapely

    area = shapely.orient_polygons(shapely.Polygon(corners))
    by = DRAWN_IN * required * math.sin(0.5 * _sharpest(shapely.get_coordinates(area)[:-1]))
    inner = area.buffer(-by, join_style="mitre")
    parts = [part for part in shapely.get_parts(inner) if part.area > 0.0]
    out_of_reach = inner.buffer(required, quad_segs=ARC_PARTS)
    if not out_of_reach.contains(area):
        parts = [area]
    return [[(x, y) for x, y in part.exterior.coords[:-1]] for part in parts]


def _sharpest(ring: Floats) -> float:
    """The least angle inside of a ring that runs anticlockwise [rad], at most a right one."""
    ahead = np.roll(ring, -1, axis=0) - ring
    headings = np.arctan2(ahead[:, 1], ahead[:, 0])
    turns = np.remainder(headings - np.roll(headings, 1) + math.pi, math.tau) - math.pi
    return min(math.pi - float(turns.max()), 0.5 * math.pi)
