"""Writing results: whole files or none, and a folder that is known to work before the long work."""

from __future__ import annotations

import os
import secrets
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from viaspline.errors import OutputError
from viaspline.report.terminal.interrupts import undone_at_the_end


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A temporary file beside ``path`` that takes its place when the block ends well.

    When the block fails or is interrupted the temporary file is removed and ``path`` is as it was.

    Raises:
        OutputError: When it can't be written.
    """
    temporary = path.with_name(f".{path.stem}.{secrets.token_hex(4)}.tmp{path.suffix}")
    try:
        with undone_at_the_end(temporary.unlink):
            yield temporary
            os.replace(temporary, path)
    except OSError as error:
        raise OutputError(path, f"can't be written ({_why(error)}); {_remedy(error)}") from error
    finally:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)


def write(path: Path, content: bytes | str) -> None:
    """Write a whole file, or leave what was there."""
    data = content.encode() if isinstance(content, str) else content
    with replacing(path) as temporary:
        temporary.write_bytes(data)


class ResultFolder:
    """A folder for results that was tried before the work began.

    Args:
        path: The folder; it is made with its parents.
        names: The files that are going to be written into it.

    Raises:
        OutputError: When it can't be made or written, naming the remedy.
    """

    def __init__(self, path: Path, names: Iterable[str] = ()) -> None:
        self.path = path
        self.names = tuple(names)
        self._made: list[Path] = []
        try:
            self._make()
            with tempfile.TemporaryFile(dir=path):
                pass
        except OSError as error:
            self.forget_if_empty()
            problem = f"this folder can't be written ({_why(error)}); {_remedy(error)}"
            raise OutputError(path, problem) from error
        except OutputError:
            self.forget_if_empty()
            raise
        for name in names:
            if (path / name).is_dir():
                raise OutputError(path / name, "is a folder where a file has to go; move it away")

    def _make(self) -> None:
        for part in (*reversed(self.path.parents), self.path):
            if part.is_dir():
                continue
            if part.exists() or part.is_symlink():
                raise OutputError(
                    part, "is a file, not a folder; give another folder for the output"
                )
            with suppress(FileExistsError):
                part.mkdir()
                self._made.append(part)

    def forget_if_empty(self) -> None:
        """Remove the folders that were made here, as far as nothing is in them."""
        with suppress(OSError):
            while self._made:
                self._made[-1].rmdir()
                self._made.pop()

    def holds_earlier_results(self) -> bool:
        """Whether files of the same names are already there."""
        return any((self.path / name).exists() for name in self.names)

    def write(self, name: str, content: bytes | str) -> Path:
        """Write one file; returns its path."""
        write(self.path / name, content)
        return self.path / name


def _why(error: OSError) -> str:
    return (error.strerror or str(error)).lower()


def _remedy(error: OSError) -> str:
    if isinstance(error, PermissionError) or error.errno == 30:  # read-only file system
        return "allow writing there or give another folder"
    if error.errno in (28, 122):  # no space left, quota exceeded
        return "free some space or give another folder"
    return "give another folder"
