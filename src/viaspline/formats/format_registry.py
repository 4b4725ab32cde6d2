"""The kinds of mission files that there are, in the order in which they are asked."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Final, cast

from viaspline.formats.file_faults import refusal
from viaspline.formats.items import Place
from viaspline.formats.mission_format import MissionFormat

FORMATS: Final = ("mission_yaml:MissionYaml", "qgc_plan:QgcPlan", "qgc_wpl:QgcWpl")
"""The file of each here, and its class."""


def formats() -> Iterator[MissionFormat]:
    """All formats. Each is imported when its turn comes: YAML doesn't wait for what others need.

    >>> [ending for each in formats() for ending in each.saved_endings]
    ['.yaml', '.yml', '.plan', '.waypoints', '.txt']
    """
    for entry in FORMATS:
        module, _, name = entry.partition(":")
        yield cast(MissionFormat, getattr(import_module(f"viaspline.formats.{module}"), name)())


def format_of(path: Path, text: str) -> MissionFormat:
    """The format of a file.

    Args:
        path: The file.
        text: What it holds.

    Raises:
        MissionError: It is empty, or of no kind that is understood.
    """
    found = next((each for each in formats() if each.sniff(path, text)), None)
    if found is not None:
        return found
    is_empty = not text or text.isspace()
    problem = "the file is empty" if is_empty else "is a kind of file that isn't understood"
    *most, last = (each.description for each in formats())
    remedy = f"understood are {', '.join(most)} and {last}"
    raise refusal(str(path), Place(""), problem, remedy)


def format_to_save(path: Path) -> MissionFormat | None:
    """The format in which a file of such a name is written, None if there is none."""
    return next((each for each in formats() if path.suffix.lower() in each.saved_endings), None)
