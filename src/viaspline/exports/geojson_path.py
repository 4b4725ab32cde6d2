"""A path as GeoJSON (RFC 7946): a line, and a point for each via point.

Tested through ``exports/test_other_readers``.
"""

from __future__ import annotations

from typing import Any, ClassVar

from viaspline.exports.date_line import sides_of_180
from viaspline.exports.path_format import Carried
from viaspline.exports.path_table import PathTable
from viaspline.kernels.arrays import Floats, Ints
from viaspline.report.files.json_text import dumps
from viaspline.report.proven_reference import PROVEN_KEY


class GeoJsonPath:
    """A feature collection: the line with speeds and times for each of its points, the via points.

    A line across the meridian of 180° is cut there, and the lists of what goes along with it, too.

    Heights are those of the mission, though the standard means them above the ellipsoid.
    """

    description: ClassVar[str] = "GeoJSON"
    endings: ClassVar[tuple[str, ...]] = (".geojson",)
    carries: ClassVar[frozenset[Carried]] = frozenset(
        {"speeds", "times", "dwells", "headings", "names"}
    )
    is_geographic: ClassVar[bool] = True
    is_cut_at_180: ClassVar[bool] = True
    is_driven: ClassVar[bool] = False
    spacing: ClassVar[float | None] = None

    def write(self, table: PathTable) -> bytes:
        """The file of a path."""
        at = _positions(table)
        parts = sides_of_180(table.places[:, 1])
        proof = table.proof
        line = {
            "name": table.name,
            "clearance_m": proof.clearance,
            "required_clearance_m": proof.required,
            "chord_error_m": proof.chord_error,
            **PROVEN_KEY,
            "distance_m": _of_parts(table.distances, parts),
            "heading_rad": _of_parts(table.headings, parts),
            "speed_mps": _of_parts(table.speeds, parts),
            "time_s": _of_parts(table.times, parts),
            "not_carried": table.lost,
        }
        lines = [
            [[longitude, *at[k][1:]] for k, longitude in zip(*part, strict=True)]
            for part in ((which.tolist(), there.tolist()) for which, there in parts)
        ]
        if len(parts) == 1:
            features = [_feature("LineString", lines[0], line)]
        else:
            features = [_feature("MultiLineString", lines, line)]
        features += [
            _feature("Point", at[k], {"name": name, "dwell_s": table.dwells[k]})
            for k, name in enumerate(table.names)
            if name is not None
        ]
        return dumps({"type": "FeatureCollection", "features": features}).encode()


def _of_parts(values: Floats, parts: list[tuple[Ints, Floats]]) -> Any:
    """What goes along with the corners, as their places stand: a list for each part if several."""
    return values if len(parts) == 1 else [values[which].tolist() for which, _ in parts]


def _positions(table: PathTable) -> list[list[float]]:
    """Longitude, latitude and, in space, height of each point."""
    places = table.places[:, ::-1].tolist()
    if not table.has_heights:
        return list(places)
    return [[*place, z] for place, z in zip(places, table.heights.tolist(), strict=True)]


def _feature(kind: str, at: Any, properties: dict[str, Any]) -> dict[str, Any]:
    geometry = {"type": kind, "coordinates": at}
    return {"type": "Feature", "properties": properties, "geometry": geometry}
