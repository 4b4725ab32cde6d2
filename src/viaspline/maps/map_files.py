"""Map files as bytes and texts, or why they can't be read.

Tested through ``maps/test_map_server``.
"""

from __future__ import annotations

import codecs
from pathlib import Path

from viaspline.maps.map_faults import refusal


def read_bytes(path: Path) -> bytes:
    """What a file holds.

    Raises:
        MissionError: There is no such file, or it can't be read.
    """
    remedy = "give the path of a map that can be read"
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise refusal(path, "there is no such file", remedy) from None
    except IsADirectoryError:
        raise refusal(path, "is a folder", remedy) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise refusal(path, f"can't be read: {reason.lower()}", remedy) from None


def read_text(path: Path) -> str:
    """The text of a file in UTF-8, with or without a byte order mark.

    Raises:
        MissionError: There is no such file, it can't be read, or it isn't UTF-8.
    """
    data = read_bytes(path)
    try:
        return data.removeprefix(codecs.BOM_UTF8).decode("utf-8")
    except UnicodeDecodeError as error:
        line_start = data.rfind(b"\n", 0, error.start) + 1
        at = data.count(b"\n", 0, error.start) + 1, error.start - line_start + 1
        problem = f"the byte 0x{data[error.start]:02X} is not UTF-8"
        raise refusal(path, problem, "save the file as UTF-8", at=at) from None
