"""The streams that a process was started with, made fit to be written to.

One that was closed leads nowhere, and one that can't write a character writes the nearest that it
can, rather than fail.
"""

from __future__ import annotations

import codecs
import os
import sys
from contextlib import suppress
from typing import Final, TextIO

PLAIN: Final = "viaspline.plain"
"""The name of the error handler that writes something similar."""

_SIMILAR: Final = {
    "…": "...", "·": "-", "²": "2", "³": "3", "°": "deg", "→": "->", "×": "x", "µ": "u",
    "–": "-", "—": "-", "≤": "<=", "≥": ">=", "±": "+-",
}  # fmt: skip


def similar(error: UnicodeError) -> tuple[str, int]:
    """What stands for characters that a stream can't write, and where to go on.

    >>> codecs.register_error(PLAIN, similar)
    >>> "1 m/s² …".encode("ascii", PLAIN)
    b'1 m/s2 ...'
    """
    if not isinstance(error, UnicodeEncodeError):
        raise error
    found = error.object[error.start : error.end]
    return "".join(_SIMILAR.get(character, "?") for character in found), error.end


def make_fit() -> None:
    """Open what was closed, and let every stream write whatever it is given."""
    codecs.register_error(PLAIN, similar)
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free: this one
    sys.stdout = _fit(sys.stdout, 1)
    sys.stderr = _fit(sys.stderr, 2)


def _fit(stream: TextIO | None, number: int) -> TextIO:
    if stream is None:
        return open(number, "w", encoding="utf-8", closefd=False)
    with suppress(AttributeError, ValueError):
        stream.reconfigure(errors=PLAIN)  # type: ignore[attr-defined]
    return stream


def nobody_listens(stream: TextIO) -> bool:
    """Whether the reader of a stream is gone; the rest then goes nowhere.

    Only another write tells: what failed to be written is kept by no stream.
    """
    try:
        stream.write("\n")
        stream.flush()
    except OSError:
        discard(stream)
        return True
    return False


def discard(stream: TextIO) -> None:
    """Send the rest of a stream nowhere, as nobody takes it any more."""
    with suppress(OSError, ValueError), open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), stream.fileno())
