"""Mission files of every kind as documents.

Tested through ``studio/test_server_files``.
"""

from __future__ import annotations

import json
import warnings
from dataclasses import dataclass
from pathlib import Path

from viaspline.errors import Fault, MissionError
from viaspline.formats.items import LatLon
from viaspline.formats.said_origin import said_origin
from viaspline.formats.yaml_document import read_document
from viaspline.mission.model import Mission
from viaspline.mission.unplaced_faults import located
from viaspline.studio import yaml_round_trip
from viaspline.studio.document import Document, check_size
from viaspline.studio.refused_error import RefusedError
from viaspline.studio.save_document import is_yaml


@dataclass(frozen=True)
class LoadedDocument:
    """A mission file.

    Attributes:
        document: What it holds, sound or not.
        warnings: What of it a mission can't represent.
        origin: Latitude and longitude of its 0, 0 [deg], if the file has such.
    """

    document: Document
    warnings: tuple[str, ...]
    origin: LatLon | None


_LAST: dict[tuple[str, int, int], LoadedDocument] = {}
"""The file that was read last, by its path, time and size: the command reads what the page asks
for next, and a map may take seconds."""


def opened(path: Path) -> LoadedDocument:
    """Open a mission file: YAML as it stands there, other kinds as what they mean.

    Raises:
        MissionError: It can't be read, or isn't what its name says.
        RefusedError: It is too large for the studio, or a fleet in JSON.
    """
    try:
        stat = path.stat()
    except OSError:
        return _opened(path)  # which says why
    stamp = (str(path.resolve()), stat.st_mtime_ns, stat.st_size)
    if stamp not in _LAST:  # the command has just read what the page asks for
        found = _opened(path)
        _LAST.clear()
        _LAST[stamp] = found
    return _LAST[stamp]


def _opened(path: Path) -> LoadedDocument:
    notes: tuple[str, ...] = ()
    origin: LatLon | None = None
    if is_yaml(path):
        found = read_document(path)
        if found.faults:  # a key that stands there twice would be lost on saving
            raise MissionError(located(list(found.faults), found.data, found))
        document: Document = found.data
        origin = said_origin(document)
    else:
        document, notes, origin = _understood(path)
    try:
        json.dumps(document, allow_nan=False)
    except ValueError:
        fault = Fault("", "has a number that is infinite or none", "write it out", str(path))
        raise MissionError([fault]) from None
    check_size(document)
    return LoadedDocument(document, notes, origin)


def _understood(path: Path) -> tuple[Document, tuple[str, ...], LatLon | None]:
    from viaspline.formats.load import load, origin_of
    from viaspline.formats.mission_yaml import yaml_text

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        mission = load(path)
    if not isinstance(mission, Mission):
        raise RefusedError(f"'{path.name}' is a fleet in JSON: call it '{path.stem}.yaml'")
    document = yaml_round_trip.read(yaml_text(mission, path.parent))
    return document, tuple(str(warning.message) for warning in caught), origin_of(path)
