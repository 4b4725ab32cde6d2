"""The text of a mission file of any kind.

Tested through ``formats/test_mission_yaml``.
"""

from __future__ import annotations

import codecs
from pathlib import Path
from typing import Final

from viaspline.formats.file_faults import refusal
from viaspline.formats.items import Place

MAX_FILE_BYTES: Final = 40_000_000
"""The largest mission file: half a million obstacles, minutes of reading."""

_WHOLE_FILE: Final = Place("")


def read_text(path: str | Path) -> str:
    """The text of a file in UTF-8, with or without a byte order mark.

    Raises:
        MissionError: There is no such file, it can't be read, or it isn't UTF-8.
    """
    source = str(path)
    remedy = "give the path of a mission file that can be read"
    try:
        size = Path(path).stat().st_size
        if size > MAX_FILE_BYTES:
            most = f"{MAX_FILE_BYTES / 1e6:.0f} MB"
            problem = f"has {size / 1e6:.0f} MB, more than the {most} that are read"
            remedy = "build so large a mission in Python: vs.Mission.model_validate({...})"
            raise refusal(source, _WHOLE_FILE, problem, remedy)
        data = Path(path).read_bytes()
    except FileNotFoundError:
        raise refusal(source, _WHOLE_FILE, "there is no such file", remedy) from None
    except IsADirectoryError:
        raise refusal(source, _WHOLE_FILE, "is a folder", remedy) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise refusal(source, _WHOLE_FILE, f"can't be read: {reason.lower()}", remedy) from None
    try:
        return data.removeprefix(codecs.BOM_UTF8).decode("utf-8")
    except UnicodeDecodeError as error:
        line_start = data.rfind(b"\n", 0, error.start) + 1
        place = Place("", data.count(b"\n", 0, error.start) + 1, error.start - line_start + 1)
        problem = f"the byte 0x{data[error.start]:02X} is not UTF-8"
        raise refusal(source, place, problem, "save the file as UTF-8") from None
