"""A path as JSON: all that the others have, and the exact curve beside it.

Tested through ``exports/test_other_readers``.
"""

from __future__ import annotations

from typing import ClassVar

from viaspline.exports.path_format import Carried
from viaspline.exports.path_table import PathTable
from viaspline.report.files.json_text import dumps
from viaspline.report.proven_reference import PROVEN_KEY


class JsonPath:
    """A mapping with ``proof``, ``points`` (columns of equal length), ``spans`` and the rest."""

    description: ClassVar[str] = "JSON"
    endings: ClassVar[tuple[str, ...]] = (".json",)
    carries: ClassVar[frozenset[Carried]] = frozenset(
        {"speeds", "times", "dwells", "headings", "names", "curve"}
    )
    is_geographic: ClassVar[bool] = False
    is_cut_at_180: ClassVar[bool] = False
    is_driven: ClassVar[bool] = False
    spacing: ClassVar[float | None] = None

    def write(self, table: PathTable) -> bytes:
        """The file of a path."""
        proof = table.proof
        places = {} if table.geodetic is None else {"latitude_longitude": table.geodetic}
        data = {
            "name": table.name,
            "frame": "ENU: x east, y north, z up; headings anticlockwise from x",
            "origin": table.origin,
            "proof": {
                "clearance_m": proof.clearance,
                "required_clearance_m": proof.required,
                "tightest_at": proof.at,
                "nearest": proof.nearest,
                "chord_error_m": proof.chord_error,
                **PROVEN_KEY,
            },
            "not_carried": table.lost,
            "points": {
                "at": table.points,
                **places,
                "distance_m": table.distances,
                "heading_rad": table.headings,
                "speed_mps": table.speeds,
                "time_s": table.times,
                "dwell_s": table.dwells,
                "via": table.names,
            },
            "spans": table.spans,
        }
        return dumps(data).encode()
