"""Portable greymaps: P5 and P2, 8 and 16 bits.

Pillow (13.0) reads them too, but not as maps need them. Where the header's maximum is neither 255
nor 65535 it scales every pixel to one of the two in Python: a million pixels take 0.43 s, here less
than 1 ms, and a threshold is asked of 166/255 instead of 65/100. A pixel above the maximum becomes
white, and pixels beyond the last row are passed over, without a word; of a file that ends too soon
it doesn't say after how many pixels. A million pixels in plain text take 0.32 s, here 0.14 s.

Format: https://netpbm.sourceforge.net/doc/pgm.html

Tested through ``maps/test_map_server``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from viaspline.errors import MissionError
from viaspline.maps.map_faults import check_size, refusal
from viaspline.maps.picture import Picture, Pixels

_BLANK: Final = rb"(?:\s|#[^\n\r]*[\n\r])+"
_HEADER: Final = re.compile(rb"P[25]" + (_BLANK + rb"(\d{1,9})") * 3 + rb"(?:#[^\n\r]*)?\s")
_COMMENT: Final = re.compile(rb"#[^\n\r]*")
_PIECE_BYTES: Final = 1 << 20  # bytes of text that are turned into numbers at once
_AGAIN: Final = "save the picture again, as PGM or PNG"


class _Header(NamedTuple):
    width: int
    height: int
    white: int
    end: int


def is_pgm(data: bytes) -> bool:
    """Whether a file begins like a greymap."""
    return data[:2] in (b"P5", b"P2")


def read_pgm(path: Path, data: bytes) -> Picture:
    r"""A greymap.

    Args:
        path: The file, for faults.
        data: What it holds.

    Raises:
        MissionError: The header makes no sense, or other pixels follow than it says.

    >>> picture = read_pgm(Path("a.pgm"), b"P2 # plain\n3 1 255\n0 128 255\n")
    >>> picture.width, picture.rows(0, 1)[:, :, 0].tolist()
    (3, [[0, 128, 255]])
    """
    header = _header(path, data)
    pixels = _plain(path, data, header) if data[:2] == b"P2" else _raw(path, data, header)
    if header.white not in (0xFF, 0xFFFF) and (largest := int(pixels.max())) > header.white:
        problem = f"a pixel has the value {largest}, more than the header's maximum {header.white}"
        raise refusal(path, problem, _AGAIN)
    pixels = pixels.reshape(header.height, header.width, 1)
    return Picture(
        header.width, header.height, header.white, False, lambda first, last: pixels[first:last]
    )


def _header(path: Path, data: bytes) -> _Header:
    found = _HEADER.match(data)
    if found is None:
        problem = "the header of the greymap is broken"
        raise refusal(path, problem, "it should be P5, width, height and maximum, then the pixels")
    width, height, white = (int(number) for number in found.groups())
    check_size(path, width, height)
    if not 1 <= white <= 0xFFFF:
        problem = f"the header's maximum is {white}"
        raise refusal(path, problem, "it should be between 1 and 65535")
    return _Header(width, height, white, found.end())


def _raw(path: Path, data: bytes, header: _Header) -> Pixels:
    kind = np.dtype(np.uint8 if header.white < 256 else ">u2")
    needed = header.width * header.height * kind.itemsize
    _check_count(
        path, header, (len(data) - header.end) / kind.itemsize, data[header.end + needed :]
    )
    pixels: Pixels = np.frombuffer(data, kind, header.width * header.height, header.end)
    return pixels


def _plain(path: Path, data: bytes, header: _Header) -> Pixels:
    pixels = np.empty(header.width * header.height, np.uint16)
    count = 0
    for numbers in _numbers(path, data, header.end):
        pixels[count : count + len(numbers)] = numbers[: len(pixels) - count]
        count += len(numbers)
    _check_count(path, header, count, b"" if count <= len(pixels) else b"more")
    return pixels


def _numbers(path: Path, data: bytes, start: int) -> Iterator[list[int]]:
    """The numbers of a plain greymap, a piece of the text at a time."""
    while start < len(data):
        cut = data.find(b"\n", start + _PIECE_BYTES)
        end = len(data) if cut < 0 else cut + 1
        try:
            numbers = [int(word) for word in _COMMENT.sub(b"", data[start:end]).split()]
        except ValueError:
            raise refusal(path, "a pixel is not a number", _AGAIN) from None
        if numbers and not 0 <= min(numbers) <= max(numbers) <= 0xFFFF:
            raise refusal(path, "a pixel is not between 0 and 65535", _AGAIN)
        yield numbers
        start = end


def _check_count(path: Path, header: _Header, found: float, rest: bytes) -> None:
    """Refuse other numbers of pixels than the header says; blanks may follow."""
    needed = header.width * header.height
    size = f"{header.width} x {header.height}"
    if found < needed:
        raise _miscounted(path, f"ends after {int(found)} of the {needed} pixels of {size}")
    if rest.strip():
        raise _miscounted(path, f"has more than the {needed} pixels of {size}")


def _miscounted(path: Path, problem: str) -> MissionError:
    return refusal(path, f"the picture {problem} that its header says", _AGAIN)
