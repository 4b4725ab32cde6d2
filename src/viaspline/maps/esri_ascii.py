"""Terrain as ESRI's ASCII grid (``.asc``): a header of keys and numbers, then rows from the north.

Format: https://en.wikipedia.org/wiki/Esri_grid#ASCII_format
"""

from __future__ import annotations

import math
import re
import warnings
from pathlib import Path
from typing import Final

import numpy as np

from viaspline.bounded_file import TERRAIN_FILE, read_bytes
from viaspline.errors import MissionError
from viaspline.kernels.arrays import Floats
from viaspline.maps.map_faults import check_heights, check_nodes, refusal
from viaspline.maps.prj_file import unit_beside
from viaspline.maps.reading import Reading
from viaspline.maps.terrain import Terrain

_LINE: Final = re.compile(rb"[ \t]*([A-Za-z_]+)[ \t]+(\S+)[ \t]*\r?(?:\n|$)")
_KEYS: Final = (
    "ncols", "nrows", "xllcorner", "xllcenter", "yllcorner", "yllcenter",
    "cellsize", "dx", "dy", "nodata_value",
)  # fmt: skip
FINEST_M: Final = 0.01
"""What has finer cells, and lies where degrees do, is in degrees: an arc second is 0.00028."""
_REMEDY: Final = "it should begin with ncols, nrows, xllcorner, yllcorner and cellsize, a line each"


def read_esri_ascii(path: str | Path, *, source: str | None = None) -> Terrain:
    """Read heights: each number is that of the middle of a cell.

    It takes as much memory as the file, and 8 bytes a height.

    Args:
        path: The file.
        source: What the terrain's file is called; ``path`` if it isn't given.

    Raises:
        MissionError: The file can't be read or is no such grid, with line and column; or its cells
            aren't square.
    """
    file = Path(path)
    data = read_bytes(file, TERRAIN_FILE)
    header, start = _header(file, data)
    columns, rows = _count(file, header, "ncols"), _count(file, header, "nrows")
    check_nodes(file, columns, rows)
    cell = _cell(file, header)
    origin = _middle(file, header, "x", cell), _middle(file, header, "y", cell)
    _check_metres(file, cell, origin)
    heights = _heights(file, data, start, columns * rows).reshape(rows, columns)
    if "nodata_value" in header:
        heights[heights == _number(file, header, "nodata_value")] = np.nan
    check_heights(file, heights)
    name = str(path) if source is None else source
    return Terrain(heights[::-1], cell, origin, name, Reading(file.absolute()))


def _header(path: Path, data: bytes) -> tuple[dict[str, tuple[str, int]], int]:
    """What stands at each key, with its line, and where the heights begin."""
    found: dict[str, tuple[str, int]] = {}
    start, line = 0, 1
    while (match := _LINE.match(data, start)) is not None:
        key = match[1].decode().lower()
        if key == "nan":
            break
        if key not in _KEYS:
            problem = f"the key {match[1].decode()} isn't one of an ASCII grid"
            raise refusal(path, problem, f"the keys are {', '.join(_KEYS)}", at=(line, 1))
        found[key] = (match[2].decode("ascii", "replace"), line)
        start, line = match.end(), line + 1
    if not found:
        raise refusal(path, "the header of the terrain is broken", _REMEDY, at=(1, 1))
    return found, start


def _number(path: Path, header: dict[str, tuple[str, int]], key: str) -> float:
    if key not in header:
        raise refusal(path, f"the header lacks {key}", _REMEDY, key=key)
    text, line = header[key]
    try:
        number = float(text)
    except ValueError:
        number = math.inf
    if math.isinf(number) or (math.isnan(number) and key != "nodata_value"):
        raise refusal(path, f'found "{text[:20]}"', "it should be a number", key=key, at=(line, 1))
    return number


def _count(path: Path, header: dict[str, tuple[str, int]], key: str) -> int:
    number = _number(path, header, key)
    if number != int(number) or number < 0:
        at = (header[key][1], 1)
        raise refusal(path, f"{key} is {number:g}", "it should be a whole number", key=key, at=at)
    return int(number)


def _cell(path: Path, header: dict[str, tuple[str, int]]) -> float:
    key = "cellsize" if "cellsize" in header or "dx" not in header else "dx"
    cell = _number(path, header, key)
    if not cell > 0.0:
        at = (header[key][1], 1)
        remedy = "it should be a number of metres above 0"
        raise refusal(path, f"{key} is {cell:g}", remedy, key=key, at=at)
    if key == "dx" and not math.isclose(cell, _number(path, header, "dy"), rel_tol=1e-6):
        at = (header["dy"][1], 1)
        problem, remedy = "dx and dy differ, so cells aren't square", "sample it anew with dx = dy"
        raise refusal(path, problem, remedy, key="dy", at=at)
    return cell


def _check_metres(path: Path, cell: float, origin: tuple[float, float]) -> None:
    """Refuse a grid that isn't in metres, as far as that can be known: it says no unit itself."""
    remedy = "project it to metres, e.g. gdalwarp -t_srs EPSG:32632"
    if (unit := unit_beside(path)) is not None:
        raise refusal(path, f"its .prj file says that it is in {unit}", remedy)
    on_globe = abs(origin[0]) <= 360.0 and abs(origin[1]) <= 90.0
    if cell < FINEST_M and on_globe:
        problem = f"its cells are {cell:g} m wide, so it seems to be in degrees"
        raise refusal(path, problem, f"{remedy}, or hand in vs.Terrain(heights, {cell:g})")


def _middle(path: Path, header: dict[str, tuple[str, int]], axis: str, cell: float) -> float:
    """Where the middle of the lower left cell is along an axis."""
    if f"{axis}llcenter" in header:
        return _number(path, header, f"{axis}llcenter")
    return _number(path, header, f"{axis}llcorner") + 0.5 * cell


def _heights(path: Path, data: bytes, start: int, count: int) -> Floats:
    with warnings.catch_warnings():
        # What stops at something that is no number is an error for new versions of numpy only.
        warnings.simplefilter("error", DeprecationWarning)
        try:
            heights = np.fromstring(data[start:], np.float64, sep=" ")
        except (ValueError, DeprecationWarning):
            heights = np.empty(0)
    if len(heights) != count or np.isinf(heights).any():
        raise _wrong(path, data, start, heights, count)
    return heights


def _wrong(path: Path, data: bytes, start: int, heights: Floats, count: int) -> MissionError:
    """What is wrong with the heights: a word among them, an infinite one, or their number."""
    tokens = re.compile(rb"\S+").finditer(data, start)
    for token in tokens:
        try:
            is_height = not math.isinf(float(token[0]))
        except ValueError:
            is_height = False
        if not is_height:
            line = data.count(b"\n", 0, token.start()) + 1
            column = token.start() - data.rfind(b"\n", 0, token.start())
            shown = token[0][:20].decode("ascii", "replace")
            return refusal(path, f'found "{shown}"', "it should be a height", at=(line, column))
    problem = f"the terrain has {len(heights)} heights, but its header says {count}"
    return refusal(path, problem, "correct ncols and nrows")
