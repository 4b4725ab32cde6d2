"""A path as KML 2.2: a line, and a placemark for each via point.

Tested through ``exports/test_other_readers``.
"""

from __future__ import annotations

from typing import ClassVar
from xml.etree.ElementTree import Element, SubElement

from viaspline.exports.path_format import Carried
from viaspline.exports.path_table import DIGITS_DEG, DIGITS_M, PathTable
from viaspline.exports.xml_text import xml_file, xml_words

NAMESPACE = "http://www.opengis.net/kml/2.2"


class KmlPath:
    """A document for Google Earth and what reads its files; what isn't in it is its description.

    Heights are above sea level where the mission has a ground, else above the ground; without
    heights the line lies on the ground.
    """

    description: ClassVar[str] = "KML"
    endings: ClassVar[tuple[str, ...]] = (".kml",)
    carries: ClassVar[frozenset[Carried]] = frozenset({"names", "dwells"})
    is_geographic: ClassVar[bool] = True
    is_cut_at_180: ClassVar[bool] = False
    is_driven: ClassVar[bool] = False
    spacing: ClassVar[float | None] = None

    def write(self, table: PathTable) -> bytes:
        """The file of a path."""
        root = Element("kml", xmlns=NAMESPACE)
        document = SubElement(root, "Document")
        SubElement(document, "name").text = xml_words(table.name)
        line = SubElement(document, "Placemark")
        SubElement(line, "name").text = xml_words(table.name)
        SubElement(line, "description").text = xml_words("\n".join(table.remarks()))
        shape = SubElement(line, "LineString")
        SubElement(shape, "tessellate").text = "0" if table.has_heights else "1"
        SubElement(shape, "altitudeMode").text = _altitude_mode(table)
        SubElement(shape, "coordinates").text = " ".join(
            _position(table, k) for k in range(len(table.points))
        )
        for k, name in enumerate(table.names):
            if name is None:
                continue
            mark = SubElement(document, "Placemark")
            SubElement(mark, "name").text = xml_words(name)
            if table.dwells[k] > 0.0:
                SubElement(mark, "description").text = f"dwell {table.dwells[k]:g} s"
            point = SubElement(mark, "Point")
            SubElement(point, "altitudeMode").text = _altitude_mode(table)
            SubElement(point, "coordinates").text = _position(table, k)
        return xml_file(root)


def _altitude_mode(table: PathTable) -> str:
    if not table.has_heights:
        return "clampToGround"
    return "relativeToGround" if table.mission.world.ground is None else "absolute"


def _position(table: PathTable, k: int) -> str:
    latitude, longitude = table.places[k].tolist()
    height = f",{table.heights[k]:.{DIGITS_M}f}" if table.has_heights else ""
    return f"{longitude:.{DIGITS_DEG}f},{latitude:.{DIGITS_DEG}f}{height}"
