"""What a kind of mission file is: something that is recognised, read and written.

Tested through ``formats/test_format_registry``.
"""

from __future__ import annotations

from abc import abstractmethod
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, NamedTuple, Protocol, TypeVar

if TYPE_CHECKING:
    from viaspline.formats.items import LatLon

Asked = TypeVar("Asked")
"""What a file asks for: a mission, or a fleet."""


class Whereabouts(NamedTuple):
    """Where a mission is written to, and where it lies.

    Attributes:
        folder: Where the file will stand: files that it names are named from there.
        origin: Latitude and longitude of the mission's 0, 0 [deg], if they are known.
    """

    folder: Path = Path()
    origin: LatLon | None = None


class Written(NamedTuple):
    """The text of a mission file.

    Attributes:
        text: What the file holds.
        lost: What of the mission isn't in it, or not in the same form: a kind a line, with where.
    """

    text: str
    lost: tuple[str, ...]


class MissionFormat(Protocol[Asked]):
    """A kind of file with a mission or a fleet: one file here, one line in ``format_registry``.

    Attributes:
        description: What it is called, with the endings of its files.
        endings: How its files may end, in small letters.
        saved_endings: The endings by which it is chosen for writing.
    """

    description: ClassVar[str]
    endings: ClassVar[tuple[str, ...]]
    saved_endings: ClassVar[tuple[str, ...]]

    @abstractmethod
    def sniff(self, path: Path, text: str) -> bool:
        """Whether a file is of this kind, by its text or its name."""
        ...

    @abstractmethod
    def read(self, text: str, source: str) -> Asked:
        """The mission (or the fleet) that a text describes.

        Args:
            text: What the file holds.
            source: The file, as errors name it; other files are looked for beside it.

        Raises:
            MissionError: The text or its mission has faults.

        Warns:
            MissionWarning: One for each kind of thing that a mission can't represent.
        """
        ...

    @abstractmethod
    def origin(self, text: str, source: str) -> LatLon | None:
        """Latitude and longitude of a text's 0, 0 [deg]; None if it has metres or no position.

        Raises:
            MissionError: The text has faults.
        """
        ...

    @abstractmethod
    def write(self, asked: Asked, where: Whereabouts) -> Written:
        """A mission (or a fleet) as a text, and what of it isn't in there.

        Raises:
            OutputError: It can't be written.
        """
        ...
