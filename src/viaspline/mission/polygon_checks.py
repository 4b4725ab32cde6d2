"""Are the polygons polygons? Asked for all of them at once, however many there are.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from viaspline.mission.fields import Corners
from viaspline.mission.partial_mission import PartialMission
from viaspline.mission.shapes.obstacle import SHAPES, Obstacle
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number

Geometries: TypeAlias = np.ndarray[Any, np.dtype[np.object_]]

_REASON = re.compile(r"(?P<what>[^\[]*)(\[(?P<x>\S+) (?P<y>\S+)\])?")

_WORDS = {
    "Self-intersection": "crosses itself",
    "Ring Self-intersection": "touches itself",
    "Hole lies outside shell": "has a hole that reaches outside it",
    "Holes are nested": "has a hole inside a hole",
    "Nested holes": "has a hole inside a hole",
    "Interior is disconnected": "is cut apart by its holes",
    "Duplicate Rings": "has the same ring twice",
}


def polygons_of(shapes: Sequence[tuple[Corners, Sequence[Corners]]]) -> Geometries:
    """Outer rings with their holes as shapely polygons, valid or not."""
    import shapely

    if not shapes:
        return np.empty(0, dtype=object)
    shells = _rings([outer for outer, _ in shapes])
    owners = [i for i, (_, holes) in enumerate(shapes) for _ in holes]
    if not owners:
        return np.asarray(shapely.polygons(shells), dtype=object)
    holes = _rings([hole for _, inner in shapes for hole in inner])
    made = np.array(shapely.polygons(shells), dtype=object)
    pierced = np.unique(owners)
    index = np.searchsorted(pierced, owners)
    made[pierced] = shapely.polygons(shells[pierced], holes=_grouped(holes, index))
    return made


def _grouped(holes: Geometries, index: np.ndarray[Any, np.dtype[np.intp]]) -> Geometries:
    """The holes of each polygon as one padded row."""
    counts = np.bincount(index)
    rows = np.full((len(counts), counts.max()), None, dtype=object)
    column = np.arange(len(index)) - np.repeat(np.cumsum(counts) - counts, counts)
    rows[index, column] = holes
    return rows


def _rings(rings: Sequence[Corners]) -> Geometries:
    import shapely

    # The first corner once more, always: three corners make a closed ring of four.
    counts = np.fromiter((len(ring) + 1 for ring in rings), dtype=np.intp, count=len(rings))
    corners = np.array([corner for ring in rings for corner in (*ring, ring[0])], dtype=float)
    owners = np.repeat(np.arange(len(rings)), counts)
    return np.asarray(shapely.linearrings(corners, indices=owners), dtype=object)


def shape_faults(partial: PartialMission) -> list[UnplacedFault]:
    """Obstacles without a shape or with two, polygons that cross themselves or have no area."""
    obstacles = partial.known + partial.unseen
    faults = [fault for path, obstacle in obstacles for fault in _one_shape(path, obstacle)]
    paths: list[Path] = [path for path, _ in partial.fences]
    shapes: list[tuple[Corners, Sequence[Corners]]] = [(ring, ()) for _, ring in partial.fences]
    for path, obstacle in obstacles:
        if obstacle.polygon is not None:
            paths.append((*path, "polygon"))
            shapes.append((obstacle.polygon, obstacle.holes))
    return faults + polygon_faults(paths, shapes)


def _one_shape(path: Path, obstacle: Obstacle) -> list[UnplacedFault]:
    faults = []
    given = [name for name in SHAPES if getattr(obstacle, name) is not None]
    if not given:
        faults.append(
            UnplacedFault(
                path,
                "the obstacle has no shape",
                "give circle: {center: [x, y], radius: 5}, polygon: [[x, y], [x, y], [x, y]] or "
                "map: FILE",
            )
        )
    if len(given) > 1:
        problem = f"the obstacle has two shapes, a {given[0]} and a {given[1]}"
        faults.append(UnplacedFault(path, problem, "keep one, or make it two obstacles"))
    if obstacle.holes and obstacle.polygon is None:
        problem = "there are holes, but no polygon that has them"
        faults.append(UnplacedFault((*path, "holes"), problem, "give polygon, or leave out holes"))
    return faults


def polygon_faults(
    paths: Sequence[Path], shapes: Sequence[tuple[Corners, Sequence[Corners]]]
) -> list[UnplacedFault]:
    """Polygons that cross themselves or have no area, each at its path."""
    if not shapes:
        return []
    import shapely

    polygons = polygons_of(shapes)
    # A sound polygon can't have so little area unless its corners are on one line.
    thin = shapely.area(polygons) <= 1e-12 * shapely.length(polygons) ** 2
    faults = []
    for i in np.flatnonzero(thin | ~shapely.is_valid(polygons)).tolist():
        hull = shapely.convex_hull(polygons[i])
        if hull.area <= 1e-12 * hull.length**2:
            problem = "the polygon has no area: its corners lie on one line"
            faults.append(
                UnplacedFault(paths[i], problem, "move a corner off the line, or leave it out")
            )
        else:
            faults.append(_crossing(paths[i], shapely.is_valid_reason(polygons[i])))
    return faults


def _crossing(path: Path, reason: str) -> UnplacedFault:
    found = _REASON.match(reason)
    what = found["what"].strip() if found else reason
    place = ""
    if found and found["x"]:
        place = f" at ({number(float(found['x']))}, {number(float(found['y']))})"
    words = _WORDS.get(what, "is not a polygon: " + what.lower())
    remedy = "list the corners in order along the outline, each once"
    return UnplacedFault(path, f"the polygon {words}{place}", remedy)
