"""The cores of many rounded rings at once: a million of them in seconds."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.rounded_ring import Loop, RoundedRing

Geometries: TypeAlias = np.ndarray[Any, np.dtype[np.object_]]


class Cores(NamedTuple):
    """Many rounded rings, taken apart.

    Attributes:
        geometries: Their cores as geometries of shapely, valid or not, shape (n,).
        radii: By how much each is grown [m], shape (n,).
    """

    geometries: Geometries
    radii: Floats


def cores_of(rings: Iterable[RoundedRing]) -> Cores:
    """The cores and radii of rounded rings, which are looked at once.

    Of a disc nothing is kept but its middle: a million small objects would be looked through by
    the garbage collector again and again.

    >>> cores = cores_of([RoundedRing([[(1, 2)]], 3), RoundedRing([[(1, 2), (4, 2)]], 3)])
    >>> [geometry.geom_type for geometry in cores.geometries], cores.radii
    (['Point', 'LineString'], array([3., 3.]))
    """
    import shapely

    radii: list[float] = []
    middles: list[tuple[float, float]] = []
    lines: list[Loop] = []
    areas: list[Sequence[Loop]] = []
    places: tuple[list[int], list[int], list[int]] = ([], [], [])
    for i, ring in enumerate(rings):
        radii.append(ring.radius)
        outer = ring.loops[0]
        if len(outer) == 1:
            places[0].append(i)
            middles.append(outer[0])
        elif len(outer) == 2:
            places[1].append(i)
            lines.append(outer)
        else:
            places[2].append(i)
            areas.append(ring.loops)
    geometries: Geometries = np.empty(len(radii), object)
    if middles:
        geometries[places[0]] = shapely.points(middles)
    if lines:
        geometries[places[1]] = shapely.linestrings(lines)
    if areas:
        geometries[places[2]] = _polygons(areas)
    return Cores(geometries, np.array(radii, np.float64))


def _polygons(shapes: Sequence[Sequence[Loop]]) -> Geometries:
    import shapely

    shells = _closed([loops[0] for loops in shapes])
    owners = [i for i, loops in enumerate(shapes) for _ in loops[1:]]
    made = np.array(shapely.polygons(shells), dtype=object)
    if owners:
        holes = _closed([hole for loops in shapes for hole in loops[1:]])
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


def _closed(loops: Sequence[Loop]) -> Geometries:
    import shapely

    # The first corner once more, always: three corners make a closed ring of four.
    counts = np.fromiter((len(loop) + 1 for loop in loops), dtype=np.intp, count=len(loops))
    corners = np.array([corner for loop in loops for corner in (*loop, loop[0])], dtype=float)
    owners = np.repeat(np.arange(len(loops)), counts)
    return np.asarray(shapely.linearrings(corners, indices=owners), dtype=object)
