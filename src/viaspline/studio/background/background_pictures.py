"""The pictures under missions: unpacked in a thread of their own, each once.

Tested through ``studio/background/test_background_requests``.
"""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any, Final

from viaspline.formats.items import LatLon
from viaspline.studio.background.background import Background
from viaspline.studio.background.picture_file import (
    PictureFacts,
    ScreenPicture,
    picture_facts,
    screen_picture,
)
from viaspline.studio.background.placed_picture import placed_picture
from viaspline.studio.folder import Folder
from viaspline.studio.refused_error import RefusedError
from viaspline.studio.worker import Worker

MAX_KEPT_PICTURES: Final = 4


class BackgroundPictures:
    """The pictures of the files in a folder.

    Args:
        folder: None is read from elsewhere.
    """

    def __init__(self, folder: Folder) -> None:
        self._folder = folder
        self._worker = Worker("pictures")
        self._kept: dict[str, ScreenPicture] = {}

    def content(self, name: str) -> ScreenPicture | None:
        """A picture by the name that the page was told."""
        return self._kept.get(name)

    async def facts(self, picture: str, base: Path) -> PictureFacts:
        """The size of a picture, and where it says that it lies.

        Args:
            picture: Its file, from the folder of the mission's.
            base: That folder.

        Raises:
            RefusedError: It is none, or lies outside of the studio's folder.
        """
        path = self._folder.inside(picture, base)
        return await self._worker.run(lambda: picture_facts(path, self._folder))

    async def shown(self, asked: Background, base: Path, origin: LatLon | None) -> dict[str, Any]:
        """A background as the page is told of it.

        Args:
            asked: The background.
            base: The folder of the mission's file.
            origin: Latitude and longitude of the mission's 0, 0 [deg], if they are known.

        Raises:
            RefusedError: The picture can't be shown, or lies nowhere.
        """
        path = self._folder.inside(asked.picture, base)

        def work() -> dict[str, Any]:
            facts = picture_facts(path, self._folder)
            placed = placed_picture(asked, facts.place, facts.size, origin)
            by_file = asked.corners is None and facts.place is not None
            return {
                **asked.as_json,
                "name": self._prepared(path),
                "sheet": placed.sheet,
                "off_by": placed.off_by,
                "source": facts.place.source if by_file and facts.place else None,
            }

        return await self._worker.run(work)

    def _prepared(self, path: Path) -> str:
        """Have a picture ready for the page; what it is asked for by."""
        try:
            stat = path.stat()
        except OSError:
            raise RefusedError(f"{path.name}: there is no such file") from None
        stamp = f"{path}\0{stat.st_mtime_ns}\0{stat.st_size}"
        name = hashlib.sha256(stamp.encode()).hexdigest()[:32]
        if name not in self._kept:
            picture = screen_picture(path)
            while len(self._kept) >= MAX_KEPT_PICTURES:
                del self._kept[next(iter(self._kept))]
            self._kept[name] = picture
        return name
