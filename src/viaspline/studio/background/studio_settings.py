"""What the studio keeps beside a mission, in ``patrol.yaml.studio.json``: no plan depends on it."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from viaspline.bounded_file import read_text
from viaspline.errors import MissionError
from viaspline.formats.items import LatLon
from viaspline.formats.studio_origin import STUDIO_ENDING, STUDIO_FILE
from viaspline.studio.background.background import Background
from viaspline.studio.folder import Folder
from viaspline.studio.refused_error import RefusedError


@dataclass(frozen=True)
class StudioSettings:
    """What is kept beside a mission.

    Attributes:
        origin: Latitude and longitude of its 0, 0 [deg], where its own file can't say them.
        background: The picture under it.
        others: What else stands in the file, as it stands there.
    """

    origin: LatLon | None = None
    background: Background | None = None
    others: Mapping[str, Any] = field(default_factory=dict)

    def moved(self, old: Path, new: Path) -> StudioSettings:
        """As it is kept beside a file in another folder: the picture is named from there."""
        if self.background is None or old == new:
            return self
        name = Path(os.path.relpath(old / self.background.picture, new)).as_posix()
        return replace(self, background=replace(self.background, picture=name))

    @property
    def text(self) -> str:
        """What the file holds; the same every time.

        >>> print(StudioSettings((47.1, 8.5)).text, end="")
        {
          "origin": [47.1, 8.5]
        }
        """
        data = dict(self.others)
        if self.background is not None:
            data["background"] = self.background.as_json
        if self.origin is not None:
            data["origin"] = list(self.origin)
        lines = (f"  {json.dumps(key)}: {json.dumps(data[key])}" for key in sorted(data))
        body = ",\n".join(lines)
        return f"{{\n{body}\n}}\n" if body else "{}\n"


def checked_origin(latitude: Any, longitude: Any) -> LatLon:
    """Latitude and longitude that can be those of a mission's 0, 0 [deg].

    Raises:
        RefusedError: They can't.

    >>> checked_origin(47.1, 8.5)
    (47.1, 8.5)
    """
    numbers = (latitude, longitude)
    are_numbers = all(isinstance(n, int | float) and not isinstance(n, bool) for n in numbers)
    if not are_numbers or not (abs(latitude) <= 90 and abs(longitude) <= 180) or numbers == (0, 0):
        remedy = "latitudes are -90 to 90, longitudes -180 to 180 degrees, and 0, 0 means nowhere"
        said = ", ".join(f"{n:g}" if isinstance(n, float) else f"{n!r:.20}" for n in numbers)
        raise RefusedError(f"{said} can't be the origin; {remedy}")
    return float(latitude), float(longitude)


def read_settings(folder: Folder, mission: str) -> tuple[StudioSettings, tuple[str, ...]]:
    """What is kept beside a mission, and what of it isn't understood.

    Args:
        folder: The studio's.
        mission: The name of the mission's file.
    """
    name = f"{mission}{STUDIO_ENDING}"
    try:
        path = folder.inside(name)
        if not path.exists():
            return StudioSettings(), ()
        data = json.loads(read_text(path, STUDIO_FILE), parse_constant=_no_number)
        if not isinstance(data, dict):
            raise RefusedError("it isn't a JSON object")
        return _parsed(data), ()
    except MissionError as error:
        why = error.faults[0].problem
    except (RefusedError, ValueError, RecursionError) as error:
        why = str(error)
    return StudioSettings(), (f"{name} is left out: {why}",)


def _parsed(data: Mapping[str, Any]) -> StudioSettings:
    origin, background = data.get("origin"), data.get("background")
    others = {key: value for key, value in data.items() if key not in ("origin", "background")}
    if origin is not None and (not isinstance(origin, list) or len(origin) != 2):
        raise RefusedError("origin has to be [latitude, longitude]")
    return StudioSettings(
        None if origin is None else checked_origin(*origin),
        None if background is None else Background.parsed(background),
        others,
    )


def write_settings(folder: Folder, mission: str, settings: StudioSettings) -> None:
    """Keep what there is beside a mission; nothing is written where there is nothing to keep.

    Raises:
        RefusedError: The file can't be written.
    """
    path = folder.inside(f"{mission}{STUDIO_ENDING}")
    if settings == StudioSettings() and not path.exists():
        return
    old = ""
    with suppress(MissionError):  # what can't be read is written anew
        old = read_text(path, STUDIO_FILE)
    if settings.text != old:
        folder.save(path, settings.text)


def _no_number(name: str) -> float:
    raise ValueError(f"{name} is not a number")
