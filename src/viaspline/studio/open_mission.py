"""What lies open before a page: a document, its file, and where on earth its 0, 0 is.

Tested through ``studio/test_server_files``.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field, replace
from pathlib import Path

from viaspline.bounded_file import MISSION_FILE, read_bytes
from viaspline.formats.items import LatLon
from viaspline.formats.said_origin import KEY, said_origin
from viaspline.studio.background.studio_settings import (
    StudioSettings,
    read_settings,
    write_settings,
)
from viaspline.studio.document import EMPTY_DOCUMENT, Document
from viaspline.studio.folder import Folder
from viaspline.studio.load_document import opened
from viaspline.studio.save_document import is_yaml


@dataclass
class OpenMission:
    """What one page works on.

    Attributes:
        folder: Where missions are opened and saved.
        name: The name of its file from the folder, or None for a new mission.
        document: As it is on the screen.
        origin: Latitude and longitude of its 0, 0 [deg], if they are known.
        digest: Of what its file held when it was opened or saved here; None where there is none.
        settings: What the studio keeps beside the file.
    """

    folder: Folder
    name: str | None = None
    document: Document = field(default_factory=lambda: EMPTY_DOCUMENT)
    origin: LatLon | None = None
    digest: str | None = None
    settings: StudioSettings = field(default_factory=StudioSettings)

    @property
    def says_its_origin(self) -> bool:
        """Whether the file itself says where its 0, 0 is."""
        if self.name is None or self.origin is None:
            return False
        return not is_yaml(Path(self.name)) or said_origin(self.document) is not None

    @property
    def base(self) -> Path:
        """The folder of the mission's file."""
        if self.name is None:
            return self.folder.root
        return self.folder.inside(self.name).parent

    def open(self, name: str) -> tuple[str, ...]:
        """Take up a file; what of it a mission can't represent.

        Raises:
            MissionError: It can't be read.
            RefusedError: It lies elsewhere or is too large.
        """
        found = opened(self.folder.to_open(name))
        self.document, self.name, self.origin = found.document, name, found.origin
        self.digest = _digest(self.folder.to_open(name))
        self.settings, notes = read_settings(self.folder, name)
        if found.origin is None:
            self.origin = self.settings.origin
        return tuple(map(self.folder.told, (*found.warnings, *notes)))

    def remember(self, settings: StudioSettings) -> None:
        """Keep something beside the file; of a new mission when that is saved.

        Raises:
            RefusedError: It can't be written.
        """
        if self.name is not None:
            write_settings(self.folder, self.name, settings)
        if not self.says_its_origin:
            self.origin = settings.origin
        self.settings = settings

    def lies_at(self, origin: LatLon | None) -> None:
        """Take up where 0, 0 is, and keep it where the file can't say so.

        Raises:
            RefusedError: It can't be written.
        """
        if self.says_its_origin:
            self.origin = origin
            if origin is not None and said_origin(self.document) is not None:
                world = {**self.document["world"], KEY: list(origin)}
                self.document = {**self.document, "world": world}
        else:
            self.remember(replace(self.settings, origin=origin))

    def saved_as(self, name: str) -> None:
        """Note that the document has just been written to a file.

        Raises:
            RefusedError: What is kept beside it can't be written.
        """
        before = self.base
        self.name, self.digest = name, _digest(self.folder.to_open(name))
        kept = None if self.says_its_origin else self.origin
        self.settings = replace(self.settings.moved(before, self.base), origin=kept)
        write_settings(self.folder, name, self.settings)

    def would_lose(self, name: str, path: Path) -> tuple[str, ...]:
        """What saving to a file that is there would drop, if it is the mission's own.

        Somebody else may have saved it meanwhile: another page, or an editor.
        """
        if name != self.name or self.digest is None or _digest(path) == self.digest:
            return ()
        return ("what was saved there since it was opened here",)

    def clear(self) -> None:
        """Begin a new mission."""
        self.document, self.name, self.origin = EMPTY_DOCUMENT, None, None
        self.digest, self.settings = None, StudioSettings()


def _digest(path: Path) -> str:
    """Of a file's content."""
    return hashlib.sha256(read_bytes(path, MISSION_FILE)).hexdigest()
