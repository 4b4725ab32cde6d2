"""Areas to keep clear of, as files draw them: rings in, sound polygons out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal, TypeAlias

import numpy as np

from viaspline.caller_warning import warn_caller
from viaspline.kernels.arrays import Floats

if TYPE_CHECKING:
    from shapely import Polygon

Ring: TypeAlias = tuple[tuple[float, float], ...]
Rule: TypeAlias = Literal["nonzero", "evenodd"]

FARTHEST_M: Final = 1e9
"""The farthest coordinate [m], as everywhere in a mission."""

_LEAST_WIDTH_M: Final = 1e-4  # width [m] below which an area is what rounding made of a line


@dataclass(frozen=True)
class Area:
    """A polygon without crossings that may have holes.

    Attributes:
        outline: Its outer ring [m], each corner once.
        holes: Free areas inside of it.
        name: What the file calls it.
    """

    outline: Ring
    holes: tuple[Ring, ...] = ()
    name: str | None = None


def areas_of(polygons: Iterable[Polygon], name: str | None) -> Iterator[Area]:
    """Polygons of shapely as areas; all have the same name."""
    for polygon in polygons:
        holes = tuple(_corners(ring) for ring in polygon.interiors)
        yield Area(_corners(polygon.exterior), holes, name)


def _corners(ring: Any) -> Ring:
    return tuple((x, y) for x, y in ring.coords[:-1])


def distinct(areas: Iterable[Area]) -> tuple[Area, ...]:
    """The areas in their order, those that cover the same ground as one before left out."""
    import shapely

    seen: dict[bytes, Area] = {}
    for area in areas:
        ground = shapely.normalize(shapely.Polygon(area.outline, area.holes))
        seen.setdefault(shapely.to_wkb(ground), area)
    return tuple(seen.values())


def filled(rings: Sequence[Floats], rule: Rule) -> list[Polygon]:
    """What a painter fills who follows some rings, as SVG defines it.

    Rings may cross themselves and each other, touch and repeat. What is no wider than a tenth of a
    millimetre is left out: with rounded coordinates, a ring often crosses itself where it closes.

    Args:
        rings: Corners, (n, 2) each; the first need not be repeated.
        rule: ``nonzero`` fills what the rings go round, on balance, in one of the two directions;
            ``evenodd`` what they go round an odd number of times.

    Returns:
        Valid polygons that don't overlap.

    >>> bow_tie = np.array([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> sorted(part.area for part in filled([bow_tie], "nonzero"))
    [1.0, 1.0]
    """
    import shapely

    rings = [ring for ring in rings if len(np.unique(ring, axis=0)) > 2]
    if len(rings) == 1 and shapely.is_valid(whole := shapely.Polygon(rings[0])):
        return with_area([whole])
    outlines = shapely.union_all([shapely.LineString([*ring, ring[0]]) for ring in rings])
    faces = shapely.get_parts(shapely.polygonize([outlines]))
    inner = shapely.get_coordinates(shapely.point_on_surface(faces))
    turns = np.array([[_turns(ring, point) for ring in rings] for point in inner], dtype=int)
    total = turns.reshape(len(faces), len(rings)).sum(axis=1)
    inside = total != 0 if rule == "nonzero" else total % 2 == 1
    return with_area(shapely.get_parts(shapely.union_all(faces[inside])))


def _turns(ring: Floats, point: Floats) -> int:
    """How often a ring goes round a point anticlockwise."""
    (x0, y0), (x1, y1) = (ring - point).T, (np.roll(ring, -1, axis=0) - point).T
    to_left = np.sign(x0 * y1 - x1 * y0)
    up, down = (y0 <= 0) & (y1 > 0), (y0 > 0) & (y1 <= 0)
    return int((up & (to_left > 0)).sum() - (down & (to_left < 0)).sum())


def with_area(polygons: Iterable[Polygon]) -> list[Polygon]:
    """The polygons that are wider than a tenth of a millimetre."""
    return [part for part in polygons if 2 * part.area > _LEAST_WIDTH_M * part.length]


def warn_of_nothing(path: Path, what: str) -> None:
    """Say that something has no area and is left out."""
    message = f"{path}: {what} has no area (can't be represented in a mission)"
    warn_caller(message)
