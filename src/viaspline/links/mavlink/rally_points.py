"""The rally points of a plan file: a mission has none, so they are taken from the file itself.

Tested through ``commands/test_upload_command``.
"""

from __future__ import annotations

import math
from pathlib import Path

from viaspline.bounded_file import MISSION_FILE, read_text
from viaspline.errors import MissionError
from viaspline.formats.json_tree import json_tree


def rally_points(path: Path) -> tuple[tuple[float, float, float], ...]:
    """Latitude, longitude [deg] and height above home [m] of each rally point of a file.

    Args:
        path: A plan; any other kind of file has none.

    Raises:
        MissionError: One of them isn't three numbers.
    """
    text = read_text(path, MISSION_FILE)
    if not text.lstrip().startswith("{"):
        return ()
    root = json_tree(text, str(path))
    points: list[tuple[float, float, float]] = []
    for tree in root["rallyPoints"]["points"].items():
        numbers = tree.numbers(3, "[latitude, longitude, altitude]")
        if numbers and not all(map(math.isfinite, numbers[:3])):
            tree.fault("isn't a place", "give latitude, longitude and altitude")
        elif numbers:
            points.append((numbers[0], numbers[1], numbers[2]))
    if root.faults.found:
        raise MissionError(root.faults.found)
    return tuple(points)
