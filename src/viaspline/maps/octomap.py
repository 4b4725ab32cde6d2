"""OctoMap's binary trees (``.bt``), read into cubes.

Format: https://github.com/OctoMap/octomap/wiki and ``kernels/world/octree``.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Final

import numpy as np

from viaspline.bounded_file import OCTREE_FILE, read_bytes
from viaspline.kernels.arrays import Bytes
from viaspline.maps.map_faults import check_cubes, refusal
from viaspline.maps.reading import Reading, Unknown
from viaspline.maps.voxels import Corner, Voxels

_FIRST: Final = b"# Octomap OcTree binary file"
_HEADER: Final = re.compile(rb"# Octomap OcTree binary file[^\n]*\n((?:[^\n]*\n)*?)data[ \t]*\r?\n")
_KEY: Final = re.compile(rb"^(id|size|res)[ \t]+(\S+)[ \t]*\r?$", re.MULTILINE)
_REMEDY: Final = "save it with octree.writeBinary(name)"


def read_octomap(
    path: str | Path,
    unknown: Unknown = "blocked",
    origin: Corner = (0.0, 0.0, 0.0),
    *,
    source: str | None = None,
) -> Voxels:
    """Read the cubes of the box round all that the tree knows.

    It takes a byte a cube of the tree's resolution, and the file.

    Args:
        path: The file.
        unknown: What to make of cubes in that box that nobody has seen.
        origin: Where the tree's own ``0, 0, 0`` lies [m].
        source: What the voxels' file is called; ``path`` if it isn't given.

    Raises:
        MissionError: The file can't be read, is no such tree or broken, or the box is too large.
    """
    from viaspline.kernels.world.octree import DEPTH, fill_from_octree, octree_extent

    file = Path(path)
    data = read_bytes(file, OCTREE_FILE)
    size, cell, start = _header(file, data)
    bits: Bytes = np.frombuffer(data, np.uint8, offset=start)
    extent = np.zeros(6, np.int64)
    read, nodes = octree_extent(bits, extent) if size else (0, 0)
    _check(file, len(bits), int(read), int(nodes), size)
    first, (nx, ny, nz) = extent[:3], (extent[3:] - extent[:3]).tolist()
    if nx <= 0:
        raise refusal(file, "nothing is known in it", "save a tree that has seen something")
    check_cubes(file, (nx, ny, nz))
    blocked = np.full((nx, ny, nz), unknown == "blocked")
    fill_from_octree(bits, first, blocked)
    blocked.flags.writeable = False
    x, y, z = ((first - (1 << (DEPTH - 1))) * cell + np.array(origin)).tolist()
    name = str(path) if source is None else source
    reading = Reading(file.absolute(), unknown=unknown, origin=origin)
    return Voxels(blocked, cell, (x, y, z), name, reading)


def _header(path: Path, data: bytes) -> tuple[int, float, int]:
    """How many nodes there are, the side of a cube [m], and where the bits begin."""
    if not data.startswith(_FIRST):
        is_full = data.startswith(b"# Octomap OcTree file")
        problem = "is a full OctoMap, not a binary one" if is_full else "isn't a binary OctoMap"
        raise refusal(path, problem, _REMEDY, at=(1, 1))
    header = _HEADER.match(data[:100_000])
    if header is None:
        raise refusal(path, "its header has no end", "a line data stands before the bits")
    keys = {key.decode(): text.decode("ascii", "replace") for key, text in _KEY.findall(header[1])}
    lacking = next((key for key in ("id", "size", "res") if key not in keys), None)
    if lacking is not None:
        raise refusal(path, f"the header lacks {lacking}", _REMEDY, key=lacking)
    return _size(path, keys["size"]), _cell(path, keys["res"]), header.end()


def _size(path: Path, text: str) -> int:
    if not re.fullmatch(r"\d{1,12}", text):
        raise refusal(path, f'found "{text[:20]}"', "it should be a whole number", key="size")
    return int(text)


def _cell(path: Path, text: str) -> float:
    try:
        cell = float(text)
    except ValueError:
        cell = math.nan
    if not 0.0 < cell < math.inf:
        remedy = "it should be a number of metres above 0"
        raise refusal(path, f'found "{text[:20]}"', remedy, key="res")
    return cell


def _check(path: Path, given: int, read: int, nodes: int, size: int) -> None:
    """Refuse bits that aren't one whole tree."""
    if read == -1:
        of_all = f" of {size}" if nodes <= size else f", and its header says {size}"
        problem = f"it ends after {nodes}{of_all} nodes"
        raise refusal(path, problem, "copy the file once more: a part of it is missing")
    if read == -2:
        raise refusal(path, "a cube of the finest size has parts", _REMEDY)
    if nodes != size:
        problem = f"it has {nodes} nodes, but its header says {size}"
        raise refusal(path, problem, _REMEDY, key="size")
    if given - read > 1:  # a last line end may be there
        raise refusal(path, f"{given - read} bytes are left over", _REMEDY)
