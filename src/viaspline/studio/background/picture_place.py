"""What a picture says of where it lies: the tags of a GeoTIFF, or a world file beside it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from viaspline.bounded_file import FileKind, read_text
from viaspline.errors import MissionError
from viaspline.studio.background.earth_grids import grid_of
from viaspline.studio.refused_error import RefusedError

if TYPE_CHECKING:
    from PIL.Image import Image

    from viaspline.studio.folder import Folder

WORLD_FILE: Final = FileKind("world file", 10_000, "it has six lines of a number each")

Matrix: TypeAlias = tuple[float, float, float, float, float, float]

_PIXEL_SCALE, _TIEPOINTS, _TRANSFORMATION, _GEO_KEYS = 33550, 33922, 34264, 34735
_MODEL_TYPE, _RASTER_TYPE, _GEOGRAPHIC_CODE, _PROJECTED_CODE = 1024, 1025, 2048, 3072
_GEOGRAPHIC: Final = 2
_POINTS: Final = 2
_WGS_84: Final = 4326


@dataclass(frozen=True)
class PicturePlace:
    """Where a picture lies in a grid.

    Attributes:
        matrix: a, b, c, d, e, f: x is a + b column + c row, y is d + e column + f row, counted in
            pixels from the top left corner of the picture.
        grid: The grid's name, where the file says it; else None.
        source: The file that says so.
    """

    matrix: Matrix
    grid: str | None
    source: str


def place_of(path: Path, image: Image, folder: Folder) -> PicturePlace | None:
    """What a picture's tags or its world file say; None if nothing does.

    Args:
        path: The picture.
        image: As Pillow has opened it.
        folder: No world file is read from outside of it.

    Raises:
        RefusedError: What there is makes no sense.
    """
    return _tagged(path, image) or _in_world_file(path, folder)


def _in_world_file(path: Path, folder: Folder) -> PicturePlace | None:
    for name in world_file_names(path.name):
        beside = path.with_name(name)
        if not beside.is_file():
            continue
        file = folder.inside(folder.name_of(beside))
        try:
            text = read_text(file, WORLD_FILE)
        except MissionError as error:
            raise RefusedError(f"{name}: {error.faults[0].problem}") from None
        return PicturePlace(matrix_of(text, name), None, name)
    return None


def world_file_names(picture: str) -> Iterator[str]:
    """What the world file of a picture may be called.

    >>> list(world_file_names("site.jpg"))[:3]
    ['site.jgw', 'site.jpgw', 'site.wld']
    """
    stem, _, ending = picture.rpartition(".")
    endings = (f"{ending[0]}{ending[-1]}w", f"{ending}w", "wld")
    yield from (f"{stem}.{each}" for each in endings)
    yield from (f"{stem}.{each.swapcase()}" for each in endings)
    yield f"{picture}.wld"


def matrix_of(text: str, name: str) -> Matrix:
    r"""The six numbers of a world file, counted from the corner of the first pixel.

    Args:
        text: What it holds: it counts from the middle of the first pixel.
        name: What it is called.

    Raises:
        RefusedError: It holds something else.

    >>> matrix_of("2\n0\n0\n-2\n101\n299\n", "site.pgw")
    (100.0, 2.0, 0.0, 300.0, 0.0, -2.0)
    """
    words = text.replace(",", ".").split()
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if len(numbers) != 6 or not all(map(math.isfinite, numbers)):
        raise RefusedError(f"{name}: isn't a world file; it has six lines of a number each")
    a, d, b, e, c, f = numbers
    return _checked((c - (a + b) / 2, a, b, f - (d + e) / 2, d, e), name)


def _tagged(path: Path, image: Image) -> PicturePlace | None:
    """Where the tags of a GeoTIFF say that it lies."""
    tags: Any = getattr(image, "tag_v2", None)
    if tags is None:
        return None
    whole, scale, tie = (_numbers(tags, tag) for tag in (_TRANSFORMATION, _PIXEL_SCALE, _TIEPOINTS))
    keys = _geo_keys(tags)
    if len(whole) == 16:
        a, b, c, d, e, f = whole[3], whole[0], whole[1], whole[7], whole[4], whole[5]
    elif len(scale) >= 2 and len(tie) >= 6:
        b, c, e, f = scale[0], 0.0, 0.0, -scale[1]
        a, d = tie[3] - tie[0] * b, tie[4] - tie[1] * f
    else:
        return None
    if keys.get(_RASTER_TYPE) == _POINTS:  # the place of the middle of a pixel
        a, d = a - (b + c) / 2, d - (e + f) / 2
    return PicturePlace(_checked((a, b, c, d, e, f), path.name), _grid(keys), path.name)


def _numbers(tags: Any, tag: int) -> Sequence[float]:
    value = tags.get(tag, ())
    return [float(number) for number in (value if isinstance(value, tuple) else (value,))]


def _geo_keys(tags: Any) -> dict[int, int]:
    """The keys that hold a number of their own."""
    values = [int(value) for value in _numbers(tags, _GEO_KEYS)]
    rows = zip(values[4::4], values[5::4], values[7::4], strict=False)
    return {key: value for key, where, value in rows if where == 0}


def _grid(keys: dict[int, int]) -> str | None:
    if keys.get(_MODEL_TYPE) == _GEOGRAPHIC:
        return grid_of(keys.get(_GEOGRAPHIC_CODE, _WGS_84))
    code = keys.get(_PROJECTED_CODE)
    return None if code is None else grid_of(code)


def _checked(matrix: Matrix, name: str) -> Matrix:
    _, b, c, _, e, f = matrix
    if not all(map(math.isfinite, matrix)) or b * f == c * e:
        raise RefusedError(f"{name}: its pixels have no width or no height")
    return matrix
