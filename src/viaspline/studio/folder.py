"""The one folder that the studio reads and writes, and the mission files and maps in it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from viaspline.errors import OutputError
from viaspline.formats.format_registry import formats
from viaspline.report.files.result_files import write
from viaspline.studio.refused_error import RefusedError
from viaspline.studio.save_document import SAVED_SUFFIXES

MISSION_SUFFIXES: Final = tuple(
    dict.fromkeys(ending for each in formats() for ending in each.endings)
)
MAP_SUFFIXES: Final = (".map", ".svg", ".geojson")
PICTURE_SUFFIXES: Final = (".png", ".jpg", ".jpeg", ".tif", ".tiff")
MAX_FOLDER_LEVELS: Final = 3
MAX_FILES_LISTED: Final = 500
SKIPPED_FOLDERS: Final = ("node_modules", "__pycache__", "viaspline-out")


class Folder:
    """A folder out of which no path leads: not by ``..``, not by being absolute, not by a link.

    Args:
        root: The folder.
    """

    def __init__(self, root: Path) -> None:
        self.root = root.resolve()

    def inside(self, name: str, base: Path | None = None) -> Path:
        """The path of a file by its name, relative to a folder within (by default the whole).

        Raises:
            RefusedError: It lies elsewhere.
        """
        if not name or "\0" in name:
            raise RefusedError("give the name of a file")
        try:
            path = ((base or self.root) / name).resolve()
            path.exists()
        except (OSError, RuntimeError) as error:  # too long, or a link that leads back to itself
            why = (getattr(error, "strerror", None) or "it is a link that leads nowhere").lower()
            raise RefusedError(f"'{name:.40}' isn't a file name: {why}") from None
        if path == self.root or not path.is_relative_to(self.root):
            raise RefusedError(f"'{name}' lies outside of the studio's folder '{self.root.name}'")
        return path

    def _holds(self, path: Path) -> bool:
        """Whether a path, followed through its links, ends within."""
        try:
            return path.resolve().is_relative_to(self.root)
        except (OSError, RuntimeError):  # a link that leads back to itself
            return False

    def to_open(self, name: str) -> Path:
        """The path of a mission file that is there.

        Raises:
            RefusedError: It lies elsewhere, or isn't a file.
        """
        path = self._named(name)
        if not path.is_file():
            raise RefusedError(f"there is no file '{name}' in the folder '{self.root.name}'")
        return path

    def to_save(self, name: str) -> Path:
        """The path that a mission is saved under.

        Raises:
            RefusedError: It lies elsewhere, its folder isn't there, or its ending means no mission.
        """
        path = self._named(name)
        if path.suffix.lower() not in SAVED_SUFFIXES:
            problem = f"missions are saved as {', '.join(SAVED_SUFFIXES)}"
            raise RefusedError(f"{problem}: call it '{Path(name).stem}.yaml'")
        if not path.parent.is_dir():
            raise RefusedError(f"there is no folder '{Path(name).parent}' to save it in")
        if path.exists() and not path.is_file():
            raise RefusedError(f"'{name}' is a {'folder' if path.is_dir() else 'pipe or a device'}")
        return path

    def _named(self, name: str) -> Path:
        if Path(name).is_absolute() or name.startswith("~"):
            raise RefusedError(f"give the name of a file within the folder '{self.root.name}'")
        return self.inside(name)

    def name_of(self, path: Path) -> str:
        """What a file within is called by the page."""
        return path.relative_to(self.root).as_posix()

    def told(self, text: str) -> str:
        """A text for the page: files are named from the folder, not from the root of the disk."""
        return text.replace(f"{self.root.as_posix()}/", "").replace(f"{self.root}{os.sep}", "")

    def save(self, path: Path, text: str) -> None:
        """Write a whole file, or leave what was there.

        Raises:
            RefusedError: It can't be written.
        """
        try:
            write(path, text)
        except OutputError as error:
            raise RefusedError(str(error)) from None

    def missions(self) -> list[str]:
        """Names of the files that may be missions, in order."""
        found = (path for path in self._files() if path.suffix.lower() in MISSION_SUFFIXES)
        return [self.name_of(path) for path in found if not is_map(path)]

    def pictures(self) -> list[str]:
        """Names of the files that are pictures, in order."""
        return [self.name_of(path) for path in self._files(PICTURE_SUFFIXES)]

    def maps(self) -> list[str]:
        """Names of the files that are maps, in order."""
        return [self.name_of(path) for path in self._files() if is_map(path)]

    def _files(self, endings: tuple[str, ...] = MISSION_SUFFIXES + MAP_SUFFIXES) -> list[Path]:
        found: list[Path] = []
        for path in self._walk(self.root, MAX_FOLDER_LEVELS, endings):
            if len(found) >= MAX_FILES_LISTED:
                break
            found.append(path)
        return sorted(found)

    def _walk(self, folder: Path, depth: int, endings: tuple[str, ...]) -> Iterator[Path]:
        try:
            entries = sorted(folder.iterdir())
        except OSError:
            return
        for path in entries:
            if path.name.startswith(".") or not self._holds(path):
                continue
            if path.is_file() and path.suffix.lower() in endings:
                yield path
            elif depth > 1 and path.is_dir() and path.name not in SKIPPED_FOLDERS:
                yield from self._walk(path, depth - 1, endings)


def is_map(path: Path) -> bool:
    """Whether a file is a map rather than a mission; YAML is when it names a picture."""
    suffix = path.suffix.lower()
    if suffix not in (".yaml", ".yml"):
        return suffix in MAP_SUFFIXES
    try:
        with path.open("rb") as file:
            lines = file.read(4096).splitlines()
    except OSError:
        return False
    return {b"image", b"resolution"} <= {line.split(b":")[0].strip() for line in lines}
