"""HOG2's voxels (``.3dmap``): ``voxel nx ny nz``, then the ``x y z`` of a blocked cube a line.

Format: https://movingai.com/benchmarks/voxels.html
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from viaspline.bounded_file import VOXEL_FILE, read_bytes
from viaspline.errors import MissionError
from viaspline.maps.map_faults import check_cubes, refusal
from viaspline.maps.reading import Reading
from viaspline.maps.voxels import Corner, Voxels

_HEADER: Final = re.compile(rb"\s*voxel((?:[ \t]+\d{1,9}){3})[ \t]*\r?(?:\n|$)")
_ROW: Final = re.compile(rb"[ \t]*\d{1,9}(?:[ \t]+\d{1,9}){2}[ \t]*\r?")


def read_hog2_voxels(
    path: str | Path,
    cell: float | None = None,
    origin: Corner = (0.0, 0.0, 0.0),
    *,
    source: str | None = None,
) -> Voxels:
    """Read voxels; outside of them nothing is known, and nothing blocked.

    It takes a byte a voxel, and some six times as much memory as the file.

    Args:
        path: The file.
        cell: Side of a cube [m]; 1 if it isn't given.
        origin: Outer corner of cube (0, 0, 0) [m].
        source: What the voxels' file is called; ``path`` if it isn't given.

    Raises:
        MissionError: The file can't be read, or is no such map; with its line.
    """
    file = Path(path)
    data = read_bytes(file, VOXEL_FILE)
    header = _HEADER.match(data)
    if header is None:
        problem = "the header of the voxels is broken"
        raise refusal(file, problem, "it should be voxel NX NY NZ, all on one line", at=(1, 1))
    nx, ny, nz = map(int, header[1].split())
    shape = nx, ny, nz
    check_cubes(file, shape)
    blocked = np.zeros(shape, np.bool_)
    x, y, z = _cubes(file, data, header.end(), shape).T
    blocked[x, y, z] = True
    blocked.flags.writeable = False
    name = str(path) if source is None else source
    reading = Reading(file.absolute(), resolution=cell, origin=origin)
    return Voxels(blocked, cell or 1.0, origin, name, reading)


def _cubes(path: Path, data: bytes, start: int, shape: tuple[int, int, int]) -> NDArray[np.int64]:
    """Indices of the blocked cubes, shape (n, 3)."""
    text = np.frombuffer(data, np.uint8, offset=start)
    is_digit = (text >= ord("0")) & (text <= ord("9"))
    if not (is_digit | np.isin(text, list(b" \t\r\n"))).all():
        raise _wrong_row(path, data, start, shape)
    first = np.flatnonzero(is_digit[1:] & ~is_digit[:-1]) + 1
    if len(text) and is_digit[0]:
        first = np.concatenate(([0], first))
    before = np.searchsorted(first, np.flatnonzero(text == ord("\n")))
    in_line = np.diff(before, prepend=0, append=len(first))
    if not np.isin(in_line, (0, 3)).all():
        raise _wrong_row(path, data, start, shape)
    numbers = np.fromstring(data[start:], np.int64, sep=" ")
    cubes: NDArray[np.int64] = numbers.reshape(-1, 3)
    if ((cubes < 0) | (cubes >= np.array(shape))).any():
        raise _wrong_row(path, data, start, shape)
    return cubes


def _wrong_row(path: Path, data: bytes, start: int, shape: tuple[int, int, int]) -> MissionError:
    first = data.count(b"\n", 0, start) + 1
    for number, row in enumerate(data[start:].split(b"\n"), start=first):
        shown = row.strip()[:30].decode("ascii", "replace")
        if not shown:
            continue
        if not _ROW.fullmatch(row):
            return refusal(path, f'found "{shown}"', "it should be x y z", at=(number, 1))
        place = tuple(map(int, row.split()))
        if any(index >= most for index, most in zip(place, shape, strict=True)):
            aside = " x ".join(map(str, shape))
            problem = f"cube {shown} is outside of {aside} voxels"
            return refusal(path, problem, "correct it or the header", at=(number, 1))
    return refusal(path, "its rows can't be read", "each should be x y z", at=(first, 1))
