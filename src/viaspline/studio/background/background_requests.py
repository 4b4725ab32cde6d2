"""What a page asks of the picture under its mission, and of where on earth that lies."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import Any

from viaspline.studio.background.background import Background
from viaspline.studio.background.background_pictures import BackgroundPictures
from viaspline.studio.background.studio_settings import checked_origin
from viaspline.studio.open_mission import OpenMission
from viaspline.studio.page_messages import Message, text_of
from viaspline.studio.refused_error import RefusedError
from viaspline.studio.save_document import origin_from

Answer = dict[str, Any]


def pictures(current: OpenMission) -> Answer:
    """The pictures of the folder, each by its name from the folder of the mission's file."""
    root = current.folder.root
    names = (_from(current.base, root / name) for name in current.folder.pictures())
    return {"type": "pictures", "pictures": list(names)}


def _from(base: Path, path: Path) -> str:
    return Path(os.path.relpath(path, base)).as_posix()


async def picture(current: OpenMission, message: Message, kept: BackgroundPictures) -> Answer:
    """The size of a picture, and what it says of where it lies.

    Args:
        current: The mission.
        message: With the name of the ``picture``.
        kept: Opens it.
    """
    name = text_of(message, "picture")
    facts = await kept.facts(name, current.base)
    place = None
    if facts.place is not None:
        place = {"grid": facts.place.grid, "source": facts.place.source}
    return {"type": "picture", "picture": name, "size": facts.size, "place": place}


async def remember(current: OpenMission, message: Message, kept: BackgroundPictures) -> Answer:
    """Keep another origin, or another background, or none.

    Nothing is kept of a background that can't be shown.

    Args:
        current: The mission.
        message: With an ``origin`` as text, a ``background``, or both.
        kept: Opens the picture.
    """
    name, origin = current.name, current.origin
    changes: dict[str, Any] = {}
    if "origin" in message:
        if current.says_its_origin:
            raise RefusedError(f"{name} says itself where its 0, 0 is")
        typed = origin_from(text_of(message, "origin"))
        origin = changes["origin"] = None if typed is None else checked_origin(*typed)
    if "background" in message:
        given = message["background"]
        asked = changes["background"] = None if given is None else Background.parsed(given)
        if asked is not None:
            await kept.shown(asked, current.base, origin)
    if current.name != name:
        raise RefusedError("another mission was opened meanwhile")
    current.remember(replace(current.settings, **changes))
    return {"type": "remembered", "origin": current.origin, **await shown(current, kept)}


async def shown(current: OpenMission, kept: BackgroundPictures) -> Answer:
    """The background of a mission: what is shown of it, or why nothing is.

    Args:
        current: The mission.
        kept: Opens the picture.
    """
    asked = current.settings.background
    if asked is None:
        return {"background": None}
    try:
        return {"background": await kept.shown(asked, current.base, current.origin)}
    except RefusedError as error:
        return {"background": {**asked.as_json, "problem": str(error)}}
