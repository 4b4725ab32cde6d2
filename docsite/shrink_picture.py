"""Make a picture as small as a page needs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image
from scipy.spatial import cKDTree

WIDTH_PX = 1000
WIDEST_PX = 1800  # of a picture that is much wider than tall: its texts are small beside it
MUCH_WIDER = 1.8
COLOURS = 255


def shrink_picture(source: Path, target: Path, width: int | None = None) -> None:
    """Write a picture with fewer pixels across; a still PNG with at most 255 colours.

    Args:
        source: The picture.
        target: The file to be written.
        width: At most so many pixels across; usually a thousand, and more where it is much wider
            than tall.

    Raises:
        OSError: If the source is no picture or the target can't be written.
    """
    with Image.open(source) as picture:
        if picture.format != "PNG" or getattr(picture, "n_frames", 1) > 1:
            target.write_bytes(source.read_bytes())
            return
        still = picture.convert("RGB")
    usual = WIDTH_PX if still.width < MUCH_WIDER * still.height else WIDEST_PX
    across = min(still.width, width or usual)
    if still.width > across:
        height = round(still.height * across / still.width)
        still = still.resize((across, height), Image.Resampling.LANCZOS)
    few_colours(still).save(target, optimize=True)


def few_colours(picture: Image.Image) -> Image.Image:
    """A picture in colours of a palette.

    That of a median cut gives small marks the colour of others: a yellow square becomes tan. One
    that covers all colours evenly tints the grey of large areas. So half of it are the colours that
    most pixels have, as they are, and half cover those that are rare.

    Args:
        picture: In RGB.
    """
    pixels = np.asarray(picture).reshape(-1, 3)
    colours, places, counts = np.unique(pixels, axis=0, return_inverse=True, return_counts=True)
    common = colours[np.argsort(-counts, kind="stable")[: COLOURS // 2]]
    rare = picture.quantize(COLOURS // 2, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    listed = np.asarray(rare.getpalette(), np.uint8).reshape(-1, 3)
    palette = np.unique(np.concatenate([common, listed]), axis=0)
    nearest = cKDTree(palette.astype(float)).query(colours.astype(float))[1].astype(np.uint8)
    shape = picture.height, picture.width
    few = Image.fromarray(nearest[places.ravel()].reshape(shape), "P")
    few.putpalette(palette.tobytes())
    return few
