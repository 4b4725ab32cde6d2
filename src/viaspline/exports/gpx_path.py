"""A path as GPX 1.1: a route of all its points, and a way point for each via point.

Tested through ``exports/test_other_readers``.
"""

from __future__ import annotations

from typing import ClassVar
from xml.etree.ElementTree import Element, SubElement

from viaspline.exports.path_format import Carried
from viaspline.exports.path_table import DIGITS_DEG, DIGITS_M, PathTable
from viaspline.exports.xml_text import xml_file, xml_words

NAMESPACE = "http://www.topografix.com/GPX/1/1"


class GpxPath:
    """A file for chart plotters and hand-held receivers; what isn't in it is its description."""

    description: ClassVar[str] = "GPX"
    endings: ClassVar[tuple[str, ...]] = (".gpx",)
    carries: ClassVar[frozenset[Carried]] = frozenset({"names", "dwells"})
    is_geographic: ClassVar[bool] = True
    is_cut_at_180: ClassVar[bool] = False
    is_driven: ClassVar[bool] = False
    spacing: ClassVar[float | None] = None

    def write(self, table: PathTable) -> bytes:
        """The file of a path."""
        root = Element("gpx", xmlns=NAMESPACE, version="1.1", creator="viaspline")
        about = SubElement(root, "metadata")
        SubElement(about, "name").text = xml_words(table.name)
        SubElement(about, "desc").text = xml_words("\n".join(table.remarks()))
        for k, name in enumerate(table.names):
            if name is not None:
                mark = _point(root, "wpt", table, k)
                SubElement(mark, "name").text = xml_words(name)
                if table.dwells[k] > 0.0:
                    SubElement(mark, "desc").text = f"dwell {table.dwells[k]:g} s"
        route = SubElement(root, "rte")
        SubElement(route, "name").text = xml_words(table.name)
        for k, name in enumerate(table.names):
            point = _point(route, "rtept", table, k)
            if name is not None:
                SubElement(point, "name").text = xml_words(name)
        return xml_file(root)


def _point(parent: Element, tag: str, table: PathTable, k: int) -> Element:
    latitude, longitude = (f"{degrees:.{DIGITS_DEG}f}" for degrees in table.places[k].tolist())
    point = SubElement(parent, tag, lat=latitude, lon=longitude)
    if table.has_heights:
        SubElement(point, "ele").text = f"{table.heights[k]:.{DIGITS_M}f}"
    return point
