"""Text files that are there as a whole or not at all."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

from viaspline.errors import OutputError


def write_whole(path: str | Path, text: str) -> None:
    """Write a text: beside its place, and then move it there.

    Args:
        path: The file; an old one is replaced.
        text: What it is to hold.

    Raises:
        OutputError: The file can't be written.
    """
    try:
        with _replacing(Path(path)) as temporary:
            temporary.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise OutputError(path, (error.strerror or str(error)).lower()) from error


@contextlib.contextmanager
def _replacing(target: Path) -> Iterator[Path]:
    """A file beside the target that takes its place if all goes well, and goes away if not."""
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        # A temporary file is for its owner only; a mission is an ordinary file.
        mask = os.umask(0)
        os.umask(mask)
        temporary.chmod(0o666 & ~mask)
        temporary.replace(target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
