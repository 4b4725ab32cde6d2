import io
import os
import struct
import zlib
from pathlib import Path

import numpy as np
import PIL.Image
import pytest

from viaspline.studio.background.picture_file import (
    MAX_SIDE_PIXELS,
    picture_facts,
    screen_picture,
)
from viaspline.studio.folder import Folder
from viaspline.studio.refused_error import RefusedError


def opened(data: bytes) -> PIL.Image.Image:
    return PIL.Image.open(io.BytesIO(data))


def test_pictures_keep_their_colours_and_lose_what_else_is_in_the_file(tmp_path: Path) -> None:
    made = PIL.Image.new("RGBA", (30, 20), (200, 40, 10, 128))
    made.save(tmp_path / "a.png", pnginfo=None)
    picture = screen_picture(tmp_path / "a.png")
    assert picture.media_type == "image/png"
    assert opened(picture.data).getpixel((3, 3)) == (200, 40, 10, 128)
    grey = PIL.Image.new("L", (30, 20), 77)
    grey.save(tmp_path / "a.jpg", exif=b"Exif\0\0" + b"x" * 50)
    shown = opened(screen_picture(tmp_path / "a.jpg").data)
    assert shown.format == "JPEG"
    assert not shown.getexif()


def test_a_large_picture_is_made_small_enough_for_a_screen(tmp_path: Path) -> None:
    PIL.Image.new("L", (MAX_SIDE_PIXELS + 900, 40)).save(tmp_path / "wide.png")
    assert picture_facts(tmp_path / "wide.png", Folder(tmp_path)).size[0] == MAX_SIDE_PIXELS + 900
    assert opened(screen_picture(tmp_path / "wide.png").data).size[0] == MAX_SIDE_PIXELS


@pytest.mark.parametrize("kind", [np.uint16, np.float32])
def test_deep_grey_is_stretched_to_what_a_screen_shows(tmp_path: Path, kind: type) -> None:
    tifffile = pytest.importorskip("tifffile")
    ramp = np.linspace(1000, 3000, 60 * 40).reshape(40, 60).astype(kind)
    if kind is np.float32:
        ramp[5, 5] = np.nan
    tifffile.imwrite(tmp_path / "deep.tif", ramp)
    shown = np.asarray(opened(screen_picture(tmp_path / "deep.tif").data).convert("L"))
    assert shown[0, 0] < 8
    assert shown[-1, -1] > 247
    assert abs(int(shown[20, 30]) - 128) < 12


def bomb(path: Path, width: int, height: int) -> None:
    """A PNG that says that it is huge."""
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = ((b"IHDR", head), (b"IDAT", zlib.compress(b"\0" * 100)), (b"IEND", b""))
    data = b"\x89PNG\r\n\x1a\n"
    for name, body in chunks:
        check = zlib.crc32(name + body)
        data += struct.pack(">I", len(body)) + name + body + struct.pack(">I", check)
    path.write_bytes(data)


@pytest.mark.parametrize("side", [9_800, 60_000])
def test_a_giant_is_refused_before_it_is_unpacked(tmp_path: Path, side: int) -> None:
    bomb(tmp_path / "giant.png", side, side)
    with pytest.raises(RefusedError, match=r"^giant\.png: has .*pixels.*make it smaller"):
        screen_picture(tmp_path / "giant.png")


def test_what_is_no_picture_is_refused_by_its_name_alone(tmp_path: Path) -> None:
    (tmp_path / "text.png").write_text("no picture")
    (tmp_path / "drawing.png").write_text("<svg xmlns='http://www.w3.org/2000/svg'/>")
    PIL.Image.new("RGB", (300, 200)).save(tmp_path / "whole.png")
    (tmp_path / "cut.png").write_bytes((tmp_path / "whole.png").read_bytes()[:120])
    (tmp_path / "huge.png").touch()
    os.truncate(tmp_path / "huge.png", 400_000_000)  # takes no space
    (tmp_path / "folder.png").mkdir()
    for name in ("text", "drawing", "cut", "huge", "folder", "nothing"):
        with pytest.raises(RefusedError) as refused:
            screen_picture(tmp_path / f"{name}.png")
        assert str(refused.value).startswith(f"{name}.png: ")
        assert str(tmp_path) not in str(refused.value)
