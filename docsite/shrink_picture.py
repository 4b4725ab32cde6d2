"""Make a picture as small as a page needs."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

WIDTH_PX = 1000
COLOURS = 255


def shrink_picture(source: Path, target: Path) -> None:
    """Write a picture with at most a thousand pixels across; a still PNG with at most 255 colours.

    Raises:
        OSError: If the source is no picture or the target can't be written.
    """
    with Image.open(source) as picture:
        if picture.format != "PNG" or getattr(picture, "n_frames", 1) > 1:
            target.write_bytes(source.read_bytes())
            return
        still = picture.convert("RGB")
    if still.width > WIDTH_PX:
        height = round(still.height * WIDTH_PX / still.width)
        still = still.resize((WIDTH_PX, height), Image.Resampling.LANCZOS)
    still.quantize(COLOURS, dither=Image.Dither.NONE).save(target, optimize=True)
