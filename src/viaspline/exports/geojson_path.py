"""A path as GeoJSON (RFC 7946): a line, and a point for each via point.

Tested through ``exports/test_other_readers``.
"""

from __future__ import annotations

from typing import Any, ClassVar

from viaspline.exports.path_format import Carried
from viaspline.exports.path_table import PathTable
from viaspline.report.files.json_text import dumps
from viaspline.report.proven_reference import PROVEN_KEY


class GeoJsonPath:
    """A feature collection: the line with speeds and times for each of its points, the via points.

    Heights are those of the mission, though the standard means them above the ellipsoid.
    """

    description: ClassVar[str] = "GeoJSON"
    endings: ClassVar[tuple[str, ...]] = (".geojson",)
    carries: ClassVar[frozenset[Carried]] = frozenset(
        {"speeds", "times", "dwells", "headings", "names"}
    )
    is_geographic: ClassVar[bool] = True
    is_driven: ClassVar[bool] = False
    spacing: ClassVar[float | None] = None

    def write(self, table: PathTable) -> bytes:
        """The file of a path."""
        at = _positions(table)
        proof = table.proof
        line = {
            "name": table.name,
            "clearance_m": proof.clearance,
            "required_clearance_m": proof.required,
            "chord_error_m": proof.chord_error,
            **PROVEN_KEY,
            "distance_m": table.distances,
            "heading_rad": table.headings,
            "speed_mps": table.speeds,
            "time_s": table.times,
            "not_carried": table.lost,
        }
        features = [_feature("LineString", at, line)]
        features += [
            _feature("Point", at[k], {"name": name, "dwell_s": table.dwells[k]})
            for k, name in enumerate(table.names)
            if name is not None
        ]
        return dumps({"type": "FeatureCollection", "features": features}).encode()


def _positions(table: PathTable) -> list[list[float]]:
    """Longitude, latitude and, in space, height of each point."""
    places = table.places[:, ::-1].tolist()
    if not table.has_heights:
        return list(places)
    return [[*place, z] for place, z in zip(places, table.heights.tolist(), strict=True)]


def _feature(kind: str, at: Any, properties: dict[str, Any]) -> dict[str, Any]:
    geometry = {"type": kind, "coordinates": at}
    return {"type": "Feature", "properties": properties, "geometry": geometry}
