"""A path as a ``QGC WPL 110`` text, the format of ArduPilot's ground stations.

Tested through ``exports/test_other_readers``.
"""

from __future__ import annotations

from typing import ClassVar

from viaspline.exports.path_format import Carried
from viaspline.exports.path_items import path_itinerary
from viaspline.exports.path_table import PathTable
from viaspline.formats.qgc_wpl import wpl_text


class WaypointsOfPath:
    """The points of a path as way points. Fences have files of their own there, and are left out.

    The format has no place for remarks.
    """

    description: ClassVar[str] = "way points as QGC WPL 110"
    endings: ClassVar[tuple[str, ...]] = (".waypoints", ".txt")
    carries: ClassVar[frozenset[Carried]] = frozenset({"speeds", "dwells"})
    is_geographic: ClassVar[bool] = True
    is_cut_at_180: ClassVar[bool] = False
    is_driven: ClassVar[bool] = True
    spacing: ClassVar[float | None] = None

    def write(self, table: PathTable) -> bytes:
        """The file of a path."""
        return wpl_text(path_itinerary(table, ())).encode()
