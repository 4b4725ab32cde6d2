"""The folders that an earlier run of a fleet left, as its ``fleet.json`` names them.

A robot that is gone, has another name or is no longer served would else keep a plan that nobody
has proven apart from the new ones.

Tested through ``report/files/test_fleet_results``.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

from viaspline.bounded_file import FileKind, read_bytes
from viaspline.errors import MissionError

EARLIER_FILE: Final = FileKind("fleet.json", 200_000_000, "remove it")


def earlier_robots(path: Path) -> frozenset[str]:
    """The folders of robots that an earlier run says it has written.

    Args:
        path: The folder of the fleet.

    Returns:
        Their names; none without a ``fleet.json`` of ours, whatever else is there.
    """
    try:
        data = json.loads(read_bytes(path / "fleet.json", EARLIER_FILE))
    except (MissionError, ValueError, RecursionError):
        return frozenset()
    robots = data.get("robots") if isinstance(data, dict) else None
    found = map(_folder_of, robots if isinstance(robots, list) else ())
    return frozenset(name for name in found if name)


def _folder_of(robot: Any) -> str:
    """The folder of a robot's plan; empty if that isn't one right inside of the fleet's."""
    plan = robot.get("plan") if isinstance(robot, dict) else None
    name = plan.removesuffix("/plan.json") if isinstance(plan, str) else ""
    is_plain = bool(name) and name == Path(name).name and name not in (".", "..") and name != plan
    return name if is_plain and "\\" not in name and "\0" not in name else ""


def forget_robots(path: Path, folders: Iterable[str], files: Iterable[str]) -> list[str]:
    """Remove the files of robots, and their folders where nothing else is in them.

    Args:
        path: The folder of the fleet.
        folders: Of the robots.
        files: That were written for each of them.

    Returns:
        Those of which something was removed.
    """
    removed = []
    for folder in sorted(folders):
        place = path / folder
        if place.is_symlink() or not place.is_dir():
            continue
        there = [place / file for file in files if (place / file).is_file()]
        with suppress(OSError):  # it stays, as what isn't ours does
            for file in there:
                file.unlink()
            if there:
                removed.append(folder)
                place.rmdir()
    return removed
