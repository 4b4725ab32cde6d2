"""Pictures of maps: greymaps by hand, PNG and BMP with Pillow.

Tested through ``maps/test_map_server``.
"""

from __future__ import annotations

import warnings
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from viaspline.bounded_file import SQUARES_FILE, read_bytes
from viaspline.maps.map_faults import check_size, refusal
from viaspline.maps.pgm import is_pgm, read_pgm
from viaspline.maps.picture import Picture, Pixels

if TYPE_CHECKING:
    from PIL.Image import Image

_KINDS: Final = ("PNG", "BMP")
_REMEDY: Final = "save it as PGM or PNG"

_MODES: Final = {
    "1": "L", "L": "L", "I;16": "I;16", "I": "I",
    "P": "RGB", "RGB": "RGB", "RGBA": "RGBA", "LA": "RGBA",
}  # fmt: skip
"""What Pillow gives, and what is made of it."""

_DEEP: Final = ("I;16", "I")
"""16 bits of grey."""


def read_picture(path: Path) -> Picture:
    """A picture of any kind that is understood.

    It takes one byte a pixel for 8 bits of grey, two for 16 (of plain text too), four for several
    channels, and as much as its file while that is unpacked.

    Raises:
        MissionError: There is no such file, it is no picture, it is broken or too large.
    """
    data = read_bytes(path, SQUARES_FILE)
    return read_pgm(path, data) if is_pgm(data) else _with_pillow(path, data)


def _with_pillow(path: Path, data: bytes) -> Picture:
    from PIL import Image, UnidentifiedImageError

    try:
        with warnings.catch_warnings():
            # Its limit is for strangers' files on a server; only what is twice as large is refused.
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            image: Image.Image = Image.open(BytesIO(data), formats=_KINDS)
        check_size(path, *image.size)
        image.load()
    except UnidentifiedImageError:
        problem = "is not a picture of a kind that is understood"
        raise refusal(path, problem, "give a PGM (P5 or P2), PNG or BMP") from None
    except Image.DecompressionBombError:
        problem = "the picture has more pixels than a PNG or BMP may have here"
        raise refusal(path, problem, "save it as PGM") from None
    except (OSError, SyntaxError, ValueError) as error:
        raise refusal(path, f"the picture is broken: {error}", _REMEDY) from None
    return _picture(path, image)


def _picture(path: Path, image: Image) -> Picture:
    mode = _MODES.get(image.mode)
    if "transparency" in image.info:
        mode = None if mode in _DEEP else "RGBA"
    if mode is None:
        problem = f"the picture has pixels of an unknown kind, '{image.mode}'"
        raise refusal(path, problem, "save it with grey or RGB colours")

    def rows(first: int, last: int) -> Pixels:
        band = image.crop((0, first, image.width, last))
        pixels = np.asarray(band if band.mode == mode else band.convert(mode))
        return pixels.reshape(last - first, image.width, -1)

    white = 0xFFFF if mode in _DEEP else 0xFF
    return Picture(image.width, image.height, white, mode == "RGBA", rows)
