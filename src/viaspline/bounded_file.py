"""The one way in for files: regular ones only, each kind up to a size that is stated.

The size is held while reading, not only before: a file may grow, and what lies under ``/proc`` says
that it is empty.
"""

from __future__ import annotations

import codecs
import errno
import os
import stat
from pathlib import Path
from typing import Final, NamedTuple

from viaspline.errors import Fault, MissionError, with_article

_WITHOUT_WAITING: Final = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
"""A pipe is opened at once, whether or not anybody writes to it."""

_SPECIAL: Final = (
    (stat.S_ISDIR, "is a folder"),
    (stat.S_ISFIFO, "is a pipe, not a file"),
    (stat.S_ISSOCK, "is a socket, not a file"),
    (lambda mode: not stat.S_ISREG(mode), "is a device, not a file"),
)


class FileKind(NamedTuple):
    """What is read from files.

    Attributes:
        words: What such a file is called.
        max_bytes: The most that is read of one.
        smaller: What to do about a file that has more.
    """

    words: str
    max_bytes: int
    smaller: str


MISSION_FILE: Final = FileKind(
    "mission file",
    40_000_000,
    "build so large a mission in Python: vs.Mission.model_validate({...})",
)
MAP_FILE: Final = FileKind("map", 40_000_000, "leave out what the robot can't meet, or split it")
SQUARES_FILE: Final = FileKind("map", 2_200_000_000, "cut it, or make its squares larger")
TERRAIN_FILE: Final = FileKind("terrain", 600_000_000, "cut it, or take every second height")
VOXEL_FILE: Final = FileKind("file of voxels", 600_000_000, "cut it, or make its cubes larger")
OCTREE_FILE: Final = FileKind("OctoMap", 100_000_000, "cut it, or make its cubes larger")
MOTION_FILE: Final = FileKind("file with rows id, t, x, y", 40_000_000, "take fewer rows")
TRACK_FILE: Final = FileKind("file with rows x, y, right, left", 4_000_000, "take fewer rows")


def read_bytes(path: str | Path, kind: FileKind) -> bytes:
    """What a file holds.

    Args:
        path: The file.
        kind: What it is taken for.

    Raises:
        MissionError: There is no such file, it is none, it can't be read, or it is too large.

    >>> read_bytes("/dev/zero", MAP_FILE)
    Traceback (most recent call last):
    viaspline.errors.MissionError: /dev/zero: is a device, not a file; give the path of a map ...
    """
    remedy = f"give the path of {with_article(kind.words)} that can be read"
    try:
        file = os.open(path, os.O_RDONLY | _WITHOUT_WAITING)
        try:
            status = os.fstat(file)
            for is_special, problem in _SPECIAL:
                if is_special(status.st_mode):
                    raise _refusal(path, problem, remedy)
            return _content(path, file, status.st_size, kind)
        finally:
            os.close(file)
    except OSError as error:
        raise _refusal(path, _why(error), remedy) from None
    except ValueError as error:  # a name that none can have
        raise _refusal(path, f"can't be read: {error}", remedy) from None


def is_there(path: str | Path) -> bool:
    """Whether there is something of a name, which may be too long or too odd for any.

    >>> is_there("x" * 5000)
    False
    """
    return os.path.exists(path)


def is_folder(path: str | Path) -> bool:
    """Whether there is a folder of a name, which may be too long or too odd for any.

    >>> is_folder("/"), is_folder("x" * 5000)
    (True, False)
    """
    return os.path.isdir(path)


def _content(path: str | Path, file: int, size: int, kind: FileKind) -> bytes:
    """What an open file holds; a byte too much is enough to refuse it."""
    parts: list[bytes] = []
    left = kind.max_bytes + 1
    if size > kind.max_bytes:
        raise _too_large(path, f"has {_megabytes(size)}", kind)
    while left > 0 and (part := os.read(file, min(left, size + 1, 1 << 30))):
        parts.append(part)
        left -= len(part)
        size = max(size, 1 << 20)  # it is no longer what it said that it was
    if left <= 0:
        raise _too_large(path, "goes on", kind)
    return parts[0] if len(parts) == 1 else b"".join(parts)


def read_text(path: str | Path, kind: FileKind) -> str:
    """The text of a file in UTF-8, with or without a byte order mark.

    Args:
        path: The file.
        kind: What it is taken for.

    Raises:
        MissionError: As `read_bytes`, or it isn't UTF-8; then with line and column.
    """
    data = read_bytes(path, kind)
    try:
        return data.removeprefix(codecs.BOM_UTF8).decode("utf-8")
    except UnicodeDecodeError as error:
        line_start = data.rfind(b"\n", 0, error.start) + 1
        line, column = data.count(b"\n", 0, error.start) + 1, error.start - line_start + 1
        problem = f"the byte 0x{data[error.start]:02X} is not UTF-8"
        fault = Fault("", problem, "save the file as UTF-8", str(path), line, column)
        raise MissionError([fault]) from None


def _refusal(path: str | Path, problem: str, remedy: str) -> MissionError:
    return MissionError([Fault("", problem, remedy, str(path))])


def _too_large(path: str | Path, has: str, kind: FileKind) -> MissionError:
    most = f"more than the {_megabytes(kind.max_bytes)} that are read of {with_article(kind.words)}"
    return _refusal(path, f"{has}, {most}", kind.smaller)


def _megabytes(count: int) -> str:
    return f"{count / 1e6:.0f} MB" if count >= 10_000_000 else f"{count / 1e6:.1f} MB"


def _why(error: OSError) -> str:
    """Why a file can't be read.

    >>> _why(OSError(errno.ELOOP, "Too many levels of symbolic links"))
    'is a link that leads back to itself'
    """
    known = {
        errno.ENOENT: "there is no such file",
        errno.EISDIR: "is a folder",
        errno.ELOOP: "is a link that leads back to itself",
        errno.ENXIO: "is a socket, not a file",
    }
    told = known.get(error.errno or 0)
    return told or f"can't be read: {(error.strerror or str(error)).lower()}"
