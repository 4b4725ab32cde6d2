"""Terrain as GeoTIFF, in metres: OGC 19-008r4, read with tifffile."""

from __future__ import annotations

import math
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from viaspline.bounded_file import TERRAIN_FILE, read_bytes
from viaspline.errors import MissionError
from viaspline.kernels.arrays import Floats
from viaspline.maps.map_faults import check_heights, check_nodes, refusal
from viaspline.maps.reading import Reading
from viaspline.maps.terrain import Terrain
from viaspline.maps.tifffile_words import tifffile_words

if TYPE_CHECKING:
    from tifffile import TiffPage

_PIXEL_SCALE: Final = 33550
_TIEPOINTS: Final = 33922
_TRANSFORMATION: Final = 34264
_GEO_KEYS: Final = 34735
_GDAL_NODATA: Final = 42113

_NEEDED: Final = frozenset(
    {
        256, 257, 258, 259, 273, 277, 278, 279, 284, 317, 322, 323, 324, 325, 339,
        _PIXEL_SCALE, _TIEPOINTS, _TRANSFORMATION, _GEO_KEYS, _GDAL_NODATA,
    }
)  # fmt: skip
"""The tags without which heights are others, or lie elsewhere."""

_MODEL_TYPE: Final = 1024
_RASTER_TYPE: Final = 1025
_LINEAR_UNITS: Final = 3076
_VERTICAL_UNITS: Final = 4099
_PROJECTED, _GEOGRAPHIC, _GEOCENTRIC = 1, 2, 3
_POINTS: Final = 2
_METRE: Final = 9001
_BY_USER: Final = (0, 32767)
"""Values of a key that say nothing that can be looked up."""

_PROJECT: Final = (
    "project it to metres, e.g. gdalwarp -t_srs EPSG:32632, or its corners with pyproj"
)


def read_geotiff(path: str | Path, *, source: str | None = None) -> Terrain:
    """Read the heights of the first picture of a file.

    Coordinates and heights are metres: whatever says of itself that it has degrees or feet is
    refused, and any other projection is taken as it is. It takes as much memory as the file, and
    some 16 bytes a height.

    Args:
        path: The file.
        source: What the terrain's file is called; ``path`` if it isn't given.

    Raises:
        MissionError: The file can't be read, is no terrain in metres, or is compressed in a way
            that takes another package.
    """
    file = Path(path)
    with tifffile_words() as words:
        page = _first_page(file, read_bytes(file, TERRAIN_FILE))
        unread = words.unread(_NEEDED)
        if unread is not None:
            problem = f"isn't a GeoTIFF, or is a broken one: {unread}"
            raise refusal(file, problem, "save the terrain again")
        return _terrain(file, page, str(path) if source is None else source)


def _terrain(file: Path, page: TiffPage, name: str) -> Terrain:
    if len(page.shape) != 2:
        problem = f"the picture has shape {page.shape}"
        raise refusal(file, problem, "give a terrain of one band: rows and columns of heights")
    rows, columns = page.shape
    if not (isinstance(rows, int) and isinstance(columns, int)):
        problem = f"its size is {columns} x {rows}"
        raise refusal(file, problem, "save the terrain again")
    check_nodes(file, columns, rows)
    keys = _geo_keys(page)
    _check_metres(file, keys)
    cell, x, y = _frame(file, page, keys.get(_RASTER_TYPE) == _POINTS)
    heights = _heights(file, page)
    origin = x, y - (rows - 1) * cell
    return Terrain(heights[::-1], cell, origin, name, Reading(file.absolute()))


def _first_page(path: Path, data: bytes) -> TiffPage:
    try:
        from tifffile import TiffFile, TiffPage
    except ImportError:
        remedy = "pip install 'viaspline[terrain]', or give an .asc file"
        problem = "GeoTIFF is read with tifffile, which isn't installed"
        raise refusal(path, problem, remedy) from None
    try:
        page = TiffFile(BytesIO(data)).pages[0]
    except Exception as error:  # of a broken file it raises whatever it stumbles on
        problem = f"isn't a GeoTIFF, or is a broken one: {error}"
        raise refusal(path, problem, "save the terrain again") from None
    assert isinstance(page, TiffPage)
    return page


def _geo_keys(page: TiffPage) -> dict[int, int]:
    """The keys that hold a number of their own."""
    values = [value for value in _tag(page, _GEO_KEYS) if isinstance(value, int)]
    rows = zip(values[4::4], values[5::4], values[7::4], strict=False)
    return {key: value for key, where, value in rows if where == 0}


def _tag(page: TiffPage, code: int) -> tuple[Any, ...]:
    """The values of a tag; nothing if it isn't there."""
    tag = page.tags.get(code)
    if tag is None:
        return ()
    return tag.value if isinstance(tag.value, tuple) else (tag.value,)


def _check_metres(path: Path, keys: dict[int, int]) -> None:
    model = keys.get(_MODEL_TYPE, _PROJECTED)
    if model in (_GEOGRAPHIC, _GEOCENTRIC):
        what = "longitudes and latitudes" if model == _GEOGRAPHIC else "places about earth's middle"
        raise refusal(path, f"the file says that it has {what}", _PROJECT)
    for key, what in ((_LINEAR_UNITS, "coordinates"), (_VERTICAL_UNITS, "heights")):
        unit = keys.get(key, _METRE)
        if unit != _METRE and unit not in _BY_USER:
            problem = f"the file says that its {what} are in unit {unit} of EPSG, not in metres"
            raise refusal(path, problem, _PROJECT)


def _frame(path: Path, page: TiffPage, at_points: bool) -> tuple[float, float, float]:
    """From height to height, and x and y of the first, in the north-west [m].

    Args:
        path: The file.
        page: Its picture.
        at_points: Whether places are those of heights, rather than of the corners of pixels.
    """
    matrix = _tag(page, _TRANSFORMATION)
    scale, tie = _tag(page, _PIXEL_SCALE), _tag(page, _TIEPOINTS)
    if not all(isinstance(one, int | float) for one in (*matrix, *scale, *tie)):
        raise refusal(path, "it doesn't say in numbers where it lies", "save the terrain again")
    if len(matrix) == 16:
        right, skew_x, x, skew_y, down, y = (matrix[i] for i in (0, 1, 3, 4, 5, 7))
        if skew_x or skew_y:
            raise refusal(path, "its rows don't run from west to east", "sample it anew, north up")
        down = -down
    elif len(scale) >= 2 and len(tie) >= 6:
        right, down = scale[0], scale[1]
        x, y = tie[3] - tie[0] * right, tie[4] + tie[1] * down
    else:
        problem = "the picture doesn't say where it lies"
        raise refusal(path, problem, "give a GeoTIFF with a pixel scale and a tie point")
    numbers = (float(right), float(down), float(x), float(y))
    if not all(map(math.isfinite, numbers)) or not (right > 0 and down > 0):
        raise refusal(path, "its pixel scale makes no plane", "sample it anew, north up")
    if not math.isclose(right, down, rel_tol=1e-6):
        problem = f"its cells are {right:g} x {down:g} m, which isn't square"
        raise refusal(path, problem, "sample it anew, e.g. gdalwarp -tr 1 1")
    shift = 0.0 if at_points else 0.5 * numbers[0]
    return numbers[0], numbers[2] + shift, numbers[3] - shift


def _heights(path: Path, page: TiffPage) -> Floats:
    """Rows from the north; NaN where the file has none."""
    if page.dtype is None or page.dtype.kind not in "iuf":
        raise refusal(path, f"its pixels are {page.dtype}", "give heights as whole or real numbers")
    try:
        with np.errstate(invalid="ignore"):  # spoiled numbers become NaN
            heights = np.asarray(page.asarray(), np.float64)
    except Exception as error:  # of a broken file it raises whatever it stumbles on
        raise _unreadable(path, page, str(error)) from None
    heights = heights.reshape(page.shape)
    known = ~_is_nodata(path, page, heights)
    if np.isinf(heights[known]).any():
        raise refusal(path, "a height is infinite", "say its nodata value, or correct it")
    heights = np.where(known, heights, np.nan)
    check_heights(path, heights)
    return heights


def _unreadable(path: Path, page: TiffPage, why: str) -> MissionError:
    if "imagecodecs" in why:
        kind = getattr(page.compression, "name", str(page.compression))
        problem = f"is compressed with {kind}, for which tifffile needs imagecodecs"
        remedy = "pip install imagecodecs, or gdal_translate -co COMPRESS=DEFLATE -co PREDICTOR=1"
        return refusal(path, problem, remedy)
    return refusal(path, f"is broken: {why}", "save the terrain again")


def _is_nodata(path: Path, page: TiffPage, heights: Floats) -> Any:
    text = "".join(map(str, _tag(page, _GDAL_NODATA))).strip("\x00 ")
    if not text:
        return np.isnan(heights)
    try:
        nodata = float(text)
    except ValueError:
        problem = f'its nodata value is "{text[:20]}"'
        raise refusal(path, problem, "it should be a number") from None
    if page.dtype is not None and page.dtype.kind == "f":
        with np.errstate(over="ignore"):
            nodata = float(page.dtype.type(nodata))  # rounded as the heights are
    return np.isnan(heights) | (heights == nodata)
