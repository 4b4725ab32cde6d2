"""Areas in GeoJSON (RFC 7946): polygons that may have holes.

Coordinates are metres in the mission's own frame. The standard wants longitudes and latitudes; what
says of itself that it has those, or can hardly have anything else (the whole file is smaller than
10 cm), is refused rather than taken for metres. A third coordinate plays no part.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

from viaspline.bounded_file import MAP_FILE, read_text
from viaspline.errors import MissionError, with_article
from viaspline.kernels.arrays import Floats
from viaspline.maps.area import (
    FARTHEST_M,
    Area,
    areas_of,
    distinct,
    filled,
    warn_of_nothing,
    with_area,
)
from viaspline.maps.map_faults import refusal

_PROJECT: Final = "project it to metres (e.g. UTM), and take the site's corner for the origin"
_ONLY: Final = "give Polygon or MultiPolygon, e.g. widen it by how far it is to be kept clear of"
_DEGREES: Final = ("CRS84", "4326")
_LEAST_SIZE_M: Final = 0.1  # metres are larger than this all together, degrees of a site seldom


def read_geojson(path: str | Path) -> tuple[Area, ...]:
    """Read the polygons of a file; a property ``Name`` or ``name`` becomes their name.

    Args:
        path: The file.

    Raises:
        MissionError: The file can't be read, is no GeoJSON, has degrees instead of metres, or
            something in it is no polygon; it is named by its place in the file.

    Warns:
        MissionWarning: For a polygon that has no area.
    """
    file = Path(path)
    root = _parsed(file, read_text(file, MAP_FILE))
    _check_metres(file, root)
    shapes = list(_shapes(file, root, "", None))
    if not shapes:
        raise refusal(file, "the file has no polygon", _ONLY)
    _check_size(file, [ring for shape in shapes for ring in shape.rings])
    return distinct(area for shape in shapes for area in _areas(file, shape))


class _Shape(NamedTuple):
    """A polygon as it stands in the file: its outer ring and its holes."""

    rings: list[Floats]
    key: str
    name: str | None


def _parsed(path: Path, text: str) -> dict[str, Any]:
    try:
        root = json.loads(text)
    except json.JSONDecodeError as error:
        at = error.lineno, error.colno
        raise refusal(path, f"is not JSON: {error.msg}", "give GeoJSON", at=at) from None
    except (ValueError, RecursionError) as error:
        raise refusal(path, f"is not JSON: {error}", "give GeoJSON") from None
    if not isinstance(root, dict) or "type" not in root:
        raise refusal(path, "is not GeoJSON", "it should be an object with a type", at=(1, 1))
    return root


def _check_metres(path: Path, root: dict[str, Any]) -> None:
    crs = json.dumps(root.get("crs"))
    if any(name in crs for name in _DEGREES):
        problem = "the file says that it has longitudes and latitudes"
        raise refusal(path, problem, _PROJECT, key="crs")


def _check_size(path: Path, rings: list[Floats]) -> None:
    corners = np.concatenate(rings)
    size = np.ptp(corners, axis=0)
    if (size < _LEAST_SIZE_M).all() and (np.abs(corners) <= (180, 90)).all():
        problem = f"all of it lies within {max(size):.2g} m: these are degrees, not metres"
        raise refusal(path, problem, _PROJECT)


def _shapes(path: Path, item: Any, key: str, name: str | None) -> Iterator[_Shape]:
    """The polygons of an object of GeoJSON and of all that it holds."""
    kind = item.get("type") if isinstance(item, dict) else None
    if kind == "FeatureCollection":
        yield from _each(path, item, "features", key, name)
    elif kind == "GeometryCollection":
        yield from _each(path, item, "geometries", key, name)
    elif kind == "Feature":
        if item.get("geometry") is not None:
            inner = _join(key, "geometry")
            yield from _shapes(path, item["geometry"], inner, _name(item) or name)
    elif kind == "Polygon":
        yield _polygon(path, item.get("coordinates"), _join(key, "coordinates"), name)
    elif kind == "MultiPolygon":
        for i, rings in enumerate(_list(path, item, "coordinates", key)):
            yield _polygon(path, rings, f"{_join(key, 'coordinates')}[{i}]", name)
    else:
        words = with_article(kind) if isinstance(kind, str) else "an object without a type"
        raise refusal(path, f"found {words}, which isn't an area", _ONLY, key=key)


def _each(path: Path, item: Any, member: str, key: str, name: str | None) -> Iterator[_Shape]:
    for i, inner in enumerate(_list(path, item, member, key)):
        yield from _shapes(path, inner, f"{_join(key, member)}[{i}]", name)


def _list(path: Path, item: Any, member: str, key: str) -> list[Any]:
    found = item.get(member)
    if not isinstance(found, list):
        raise refusal(path, f"lacks its {member}", "it should be a list", key=_join(key, member))
    return found


def _join(key: str, member: str) -> str:
    return f"{key}.{member}" if key else member


def _name(feature: dict[str, Any]) -> str | None:
    properties = feature.get("properties")
    if not isinstance(properties, dict):
        return None
    names = (properties.get(key) for key in ("Name", "name"))
    return next((name for name in names if isinstance(name, str) and name), None)


def _polygon(path: Path, rings: Any, key: str, name: str | None) -> _Shape:
    if not isinstance(rings, list) or not rings:
        raise _no_ring(path, key)
    return _Shape([_ring(path, ring, f"{key}[{i}]") for i, ring in enumerate(rings)], key, name)


def _areas(path: Path, shape: _Shape) -> Iterator[Area]:
    """A polygon without crossings: as it is, or what its rings go round."""
    import shapely

    outer, *holes = shape.rings
    ground: Any = shapely.Polygon(outer, holes)
    if not shapely.is_valid(ground):
        ground = shapely.difference(
            shapely.union_all(filled([outer], "nonzero")),
            shapely.union_all([part for hole in holes for part in filled([hole], "nonzero")]),
        )
    parts = with_area(shapely.get_parts(ground))
    if not parts:
        warn_of_nothing(path, f"{shape.key}: the polygon")
    yield from areas_of(parts, shape.name)


def _ring(path: Path, ring: Any, key: str) -> Floats:
    try:
        corners = np.array([(float(x), float(y)) for x, y, *_ in ring])
    except (TypeError, ValueError):
        raise _no_ring(path, key) from None
    if len(corners) < 3:
        raise _no_ring(path, key)
    if not (np.abs(corners) <= FARTHEST_M).all() or not math.isfinite(corners.sum()):
        problem = "a corner is too far away"
        raise refusal(path, problem, f"it should be within {FARTHEST_M:g} m", key=key)
    return corners


def _no_ring(path: Path, key: str) -> MissionError:
    remedy = "it should be [[x, y], [x, y], [x, y], ...], the first corner once more at the end"
    return refusal(path, "isn't a ring of corners", remedy, key=key)
