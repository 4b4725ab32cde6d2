"""Pictures of the ground from files: opened with care, and made small enough for a screen."""

from __future__ import annotations

import io
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from viaspline.bounded_file import FileKind, read_bytes
from viaspline.errors import MissionError
from viaspline.studio.background.picture_place import PicturePlace, place_of
from viaspline.studio.refused_error import RefusedError

if TYPE_CHECKING:
    from PIL.Image import Image

    from viaspline.studio.folder import Folder

PICTURE_FILE: Final = FileKind("picture", 300_000_000, "make it smaller")
MAX_PIXELS: Final = 89_000_000
MAX_SIDE_PIXELS: Final = 3072
"""Of what the page is given: more than a screen shows."""

_KINDS: Final = ("PNG", "JPEG", "TIFF")
_DEEP: Final = ("I", "F", "I;16", "I;16B")
_SMALLER: Final = "make it smaller, e.g. gdal_translate -outsize 25% 25%"


@dataclass(frozen=True)
class PictureFacts:
    """What is known of a picture that isn't unpacked.

    Attributes:
        size: Its pixels in a row, and its rows.
        place: Where it says that it lies, if it does.
    """

    size: tuple[int, int]
    place: PicturePlace | None


@dataclass(frozen=True)
class ScreenPicture:
    """A picture for the page.

    Attributes:
        data: The file.
        media_type: Its kind.
    """

    data: bytes
    media_type: str


def picture_facts(path: Path, folder: Folder) -> PictureFacts:
    """The size of a picture, and where it says that it lies.

    Args:
        path: The file, within the folder.
        folder: No world file is read from outside of it.

    Raises:
        RefusedError: It is no picture, broken, too large, or lies nowhere.
    """
    with _opened(path) as image:
        return PictureFacts(image.size, place_of(path, image, folder))


def screen_picture(path: Path) -> ScreenPicture:
    """A picture as the page shows it: nothing of the file but its colours.

    Raises:
        RefusedError: It is no picture, broken, or too large.
    """
    with _opened(path) as image:
        side = (MAX_SIDE_PIXELS, MAX_SIDE_PIXELS)
        if image.format == "JPEG":
            image.draft(None, side)  # unpacks only as much as is needed
        shown = _in_colours(image)
        if max(shown.size) > MAX_SIDE_PIXELS:
            shown.thumbnail(side)
        buffer = io.BytesIO()
        if image.format == "PNG" or shown.mode == "RGBA":
            shown.save(buffer, "PNG", compress_level=1)
            return ScreenPicture(buffer.getvalue(), "image/png")
        shown.save(buffer, "JPEG", quality=88)
        return ScreenPicture(buffer.getvalue(), "image/jpeg")


@contextmanager
def _opened(path: Path) -> Iterator[Image]:
    import PIL.Image

    try:
        data = read_bytes(path, PICTURE_FILE)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", PIL.Image.DecompressionBombWarning)  # it is asked below
            image = PIL.Image.open(io.BytesIO(data), formats=_KINDS)
        _check_size(path, *image.size)
        yield image
    except MissionError as error:
        fault = error.faults[0]
        raise RefusedError(f"{path.name}: {fault.problem}; {fault.remedy}") from None
    except PIL.UnidentifiedImageError:
        raise RefusedError(f"{path.name}: isn't a PNG, JPEG or TIFF that can be read") from None
    except PIL.Image.DecompressionBombError:
        raise RefusedError(f"{path.name}: has too many pixels; {_SMALLER}") from None
    except (OSError, SyntaxError, ValueError, KeyError, EOFError) as error:
        raise RefusedError(f"{path.name}: the picture is broken: {error}") from None


def _check_size(path: Path, width: int, height: int) -> None:
    if width * height > MAX_PIXELS:
        most = f"more than the {MAX_PIXELS // 1_000_000} million that are read"
        raise RefusedError(f"{path.name}: has {width} x {height} pixels, {most}; {_SMALLER}")


def _in_colours(image: Image) -> Image:
    """Eight bits of red, green, blue, and opacity where there is one."""
    if image.mode in _DEEP:
        return _stretched(image).convert("RGB")
    has_alpha = image.mode in ("RGBA", "LA", "PA") or "transparency" in image.info
    return image.convert("RGBA" if has_alpha else "RGB")


def _stretched(image: Image) -> Image:
    """Deep grey from its darkest to its lightest, without the outermost hundredths."""
    import PIL.Image

    values = np.asarray(image, np.float32)
    known = values[np.isfinite(values)]
    low, high = np.percentile(known, (1, 99)) if known.size else (0.0, 0.0)
    share = (np.nan_to_num(values, nan=low) - low) / max(high - low, 1e-12)
    return PIL.Image.fromarray(np.round(255 * np.clip(share, 0.0, 1.0)).astype(np.uint8))
