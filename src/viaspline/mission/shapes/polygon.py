"""A polygon, which may have holes."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, ClassVar, Final, Self

import numpy as np

from viaspline.mission.shapes.cores import cores_of
from viaspline.mission.shapes.rounded_ring import Loop, RoundedRing
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number

THINNEST: Final = 1e-12
"""Area by the square of the circumference, up to which a polygon has none."""

_REASON: Final = re.compile(r"(?P<what>[^\[]*)(\[(?P<x>\S+) (?P<y>\S+)\])?")
"""Why shapely finds a polygon invalid, and where [m]."""

_WORDS: Final = {
    "Self-intersection": "crosses itself",
    "Ring Self-intersection": "touches itself",
    "Hole lies outside shell": "has a hole that reaches outside it",
    "Holes are nested": "has a hole inside a hole",
    "Nested holes": "has a hole inside a hole",
    "Interior is disconnected": "is cut apart by its holes",
    "Duplicate Rings": "has the same ring twice",
}


@dataclass(frozen=True)
class Polygon:
    """What an outer ring goes round, without its holes.

    Attributes:
        outer: Its corners [m], not closed, in either direction.
        holes: Rings inside of it.
    """

    EXAMPLE: ClassVar[str] = "polygon: [[x, y], [x, y], [x, y]]"

    outer: Loop
    holes: tuple[Loop, ...] = ()

    def ring(self) -> RoundedRing:
        """Its corners, grown by nothing."""
        return RoundedRing((self.outer, *self.holes))

    @classmethod
    def faults(cls, placed: Iterable[tuple[Path, Self]]) -> list[UnplacedFault]:
        """Those that have no area, or cross themselves.

        >>> bow_tie = Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
        >>> [fault] = Polygon.faults([(("polygon",), bow_tie)])
        >>> fault.problem
        'the polygon crosses itself at (1, 1)'
        """
        import shapely

        paths, polygons = [], []
        for path, polygon in placed:
            paths.append(path)
            polygons.append(polygon.ring())
        cores = cores_of(polygons).geometries
        # A sound polygon can't have so little area unless its corners are on one line.
        thin = shapely.area(cores) <= THINNEST * shapely.length(cores) ** 2
        unsound = np.flatnonzero(thin | ~shapely.is_valid(cores)).tolist()
        return [_fault(paths[i], cores[i]) for i in unsound]


def _fault(path: Path, polygon: Any) -> UnplacedFault:
    import shapely

    hull = shapely.convex_hull(polygon)
    if hull.area <= THINNEST * hull.length**2:
        problem = "the polygon has no area: its corners lie on one line"
        return UnplacedFault(path, problem, "move a corner off the line, or leave it out")
    return _crossing(path, shapely.is_valid_reason(polygon))


def _crossing(path: Path, reason: str) -> UnplacedFault:
    found = _REASON.match(reason)
    what = found["what"].strip() if found else reason
    place = ""
    if found and found["x"]:
        place = f" at ({number(float(found['x']))}, {number(float(found['y']))})"
    words = _WORDS.get(what, "is not a polygon: " + what.lower())
    remedy = "list the corners in order along the outline, each once"
    return UnplacedFault(path, f"the polygon {words}{place}", remedy)
