"""Whether there is a way, and how roomy a path is, by shapely's areas: nothing of it is ours."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

import viaspline as vs

Place = tuple[float, float]
MARGIN_M = 5e-4  # by which the oracle grows a world more and less than is required
ARC_SEGMENTS = 64  # of a quarter of a circle


def core_of(obstacle: dict[str, Any]) -> tuple[Any, float]:
    """An obstacle as shapely has it, and by how much that is to be grown [m]."""
    if "circle" in obstacle:
        return shapely.Point(obstacle["circle"]["center"]), obstacle["circle"]["radius"]
    if "capsule" in obstacle:
        line = obstacle["capsule"]
        return shapely.LineString([line["from"], line["to"]]), line["radius"]
    return shapely.Polygon(obstacle["polygon"]), 0.0


def squares_of(cells: NDArray[np.bool_]) -> list[tuple[Any, float]]:
    """Blocked cells of 1 m."""
    y, x = np.nonzero(cells)
    return [(square, 0.0) for square in shapely.box(x, y, x + 1, y + 1)]


def free_area(
    cores: list[tuple[Any, float]], bounds: tuple[float, ...], required: float, *, grown: float
) -> Any:
    """What keeps a distance, with arcs whose radii are ``grown`` times as large."""
    x0, y0, x1, y1 = bounds
    inside = shapely.box(x0 + required, y0 + required, x1 - required, y1 - required)
    blocked = [
        shapely.buffer(core, grown * (r + required), quad_segs=ARC_SEGMENTS) for core, r in cores
    ]
    return shapely.difference(inside, shapely.union_all(blocked))


def is_joined(area: Any, ends: list[Place]) -> bool:
    parts = shapely.get_parts(area)
    a, b = shapely.points(ends)
    return bool((shapely.covers(parts, a) & shapely.covers(parts, b)).any())


def truth(
    cores: list[tuple[Any, float]], bounds: tuple[float, ...], required: float, ends: list[Place]
) -> bool | None:
    """Whether there is a way; None where that can't be told."""
    outside = 1.0 / math.cos(1.5 * math.pi / (4 * ARC_SEGMENTS))  # arcs round the true ones
    if is_joined(free_area(cores, bounds, required + MARGIN_M, grown=outside), ends):
        return True
    if not is_joined(free_area(cores, bounds, required - MARGIN_M, grown=1.0), ends):
        return False
    return None


def roomy_places(
    random: np.random.Generator,
    cores: list[tuple[Any, float]],
    bounds: tuple[float, ...],
    room: float,
) -> list[Place]:
    """Two random places with room, or fewer."""
    at = random.uniform(bounds[:2], bounds[2:], (60, 2))
    x0, y0, x1, y1 = bounds
    found = np.minimum(at - (x0, y0), np.array((x1, y1)) - at).min(axis=1)
    for core, radius in cores:
        found = np.minimum(found, shapely.distance(core, shapely.points(at)) - radius)
    return [(float(x), float(y)) for x, y in at[found >= room][:2]]


def least_room(plan: vs.Plan, cores: list[tuple[Any, float]], bounds: tuple[float, ...]) -> float:
    """Distance of a path from the world, by shapely on chords [m]."""
    spans = np.asarray(plan.path.spans)
    u = np.linspace(0.0, 1.0, 201)[:, None, None]
    b0, b1, b2, b3 = np.moveaxis(spans[:, :, :2], 1, 0)
    points = (1 - u) ** 3 * b0 + 3 * u * (1 - u) ** 2 * b1 + 3 * u * u * (1 - u) * b2 + u**3 * b3
    lines = shapely.linestrings(np.moveaxis(points, 0, 1))
    edge = shapely.distance(shapely.box(*bounds).exterior, lines).min()
    solids, radii = np.array([core for core, _ in cores]), np.array([r for _, r in cores])
    (core, _), gaps = shapely.STRtree(lines).query_nearest(
        solids, all_matches=False, return_distance=True
    )
    return float(min(edge, (gaps - radii[core]).min()))
