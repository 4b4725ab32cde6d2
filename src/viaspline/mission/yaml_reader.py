"""Missions from YAML files, with every fault at once and each in its place."""

from __future__ import annotations

from pathlib import Path

from viaspline.mission.model import Mission
from viaspline.mission.validation import Context
from viaspline.mission.yaml_document import read_document


def read_yaml(path: str | Path) -> Mission:
    """Read a mission from a YAML file.

    Args:
        path: The file.

    Returns:
        The mission, sound in itself.

    Raises:
        MissionError: The file can't be read or the mission has faults; each fault has the line
            and column where it stands.

    >>> read_yaml("no-such-file.yaml")
    Traceback (most recent call last):
    viaspline.errors.MissionError: no-such-file.yaml: there is no such file; give the path of ...
    """
    document = read_document(path)
    return Mission.model_validate(document.data, context=Context(document))
