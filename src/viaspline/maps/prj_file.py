"""What a ``.prj`` file beside a grid says of its coordinates: metres, or something else.

Formats: ESRI's well-known text (GEOGCS, PROJCS, and UNIT["name",metres] last), and its older lines
of words (``Projection GEOGRAPHIC``, ``Units METERS``).

Tested through ``maps/test_esri_ascii``.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Final

from viaspline.bounded_file import MAP_FILE, is_there, read_bytes

_GEOGRAPHIC: Final = re.compile(r"\s*(?:GEOGCS|GEOGCRS|GEODCRS)\s*\[", re.IGNORECASE)
_UNIT: Final = re.compile(
    r'UNIT\s*\[\s*"([^"]*)"\s*,\s*(\d*\.?\d+(?:[eE][-+]?\d+)?)\b', re.IGNORECASE
)
_LINE: Final = re.compile(r"^\s*(projection|units)\s+(\S+)", re.IGNORECASE | re.MULTILINE)
_METRES: Final = ("m", "metre", "metres", "meter", "meters")


def unit_beside(path: Path) -> str | None:
    """The unit in which a grid is, by the file beside it; None: metres, or nobody says.

    Args:
        path: The grid's file.

    Raises:
        MissionError: There is such a file, and it can't be read.
    """
    beside = path.with_suffix(".prj")
    if not is_there(beside):
        return None
    text = read_bytes(beside, MAP_FILE).decode("utf-8", "replace")
    said = {key.lower(): word for key, word in _LINE.findall(text)}
    if _GEOGRAPHIC.match(text) or said.get("projection", "").upper() == "GEOGRAPHIC":
        return "degrees"
    units = [(name, float(metres)) for name, metres in _UNIT.findall(text)]
    if units:
        name, metres = units[-1]
        return None if math.isclose(metres, 1.0, rel_tol=1e-9) else name
    unit = said.get("units")
    return None if unit is None or unit.lower() in _METRES else unit.lower()
