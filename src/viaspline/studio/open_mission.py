"""What lies open before a page: a document, its file, and where on earth its 0, 0 is.

Tested through ``studio/test_server_files``.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from viaspline.formats.items import LatLon
from viaspline.studio.document import EMPTY_DOCUMENT, Document
from viaspline.studio.folder import Folder
from viaspline.studio.load_document import opened


@dataclass
class OpenMission:
    """What one page works on.

    Attributes:
        folder: Where missions are opened and saved.
        name: The name of its file from the folder, or None for a new mission.
        document: As it is on the screen.
        origin: Latitude and longitude of its 0, 0 [deg], if they are known.
    """

    folder: Folder
    name: str | None = None
    document: Document = field(default_factory=lambda: EMPTY_DOCUMENT)
    origin: LatLon | None = None

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
        return found.warnings

    def clear(self) -> None:
        """Begin a new mission."""
        self.document, self.name, self.origin = EMPTY_DOCUMENT, None, None
