"""The file of a corridor: rows x, y, right, left in metres.

Tested through ``mission/test_corridors``.
"""

from __future__ import annotations

import math
from pathlib import Path as FilePath
from typing import Any

from viaspline.bounded_file import TRACK_FILE, read_text
from viaspline.errors import MissionError
from viaspline.mission.fields import MAX_LENGTH_M
from viaspline.mission.unplaced_faults import (
    MAX_REPORTED_FAULTS,
    Path,
    UnplacedFault,
    children,
    is_number,
)

ROW_WORDS = "x, y, right, left"
CSV_PATH: Path = ("route", "corridor", "csv")


def resolve_corridor(data: Any, folder: FilePath) -> tuple[Any, list[UnplacedFault]]:
    """Read the corridor's file of a mission.

    Args:
        data: What a mission file holds, sound or not.
        folder: Where the file is looked for.

    Returns:
        The data with the line beside the file's absolute path, and what was wrong with the file;
        ``data`` itself if there is no file to read.
    """
    top = children(data) or {}
    route = children(top.get("route")) or {}
    corridor = children(route.get("corridor")) or {}
    name = corridor.get("csv")
    if not isinstance(name, str | FilePath) or not str(name) or corridor.get("line") is not None:
        return data, []
    path = folder / name
    rows, faults = read_track(path)
    if faults:
        resolved = {**corridor, "csv": str(name)}
    else:
        resolved = {**corridor, "csv": FilePath(path).resolve().as_posix(), "line": rows}
    return {**top, "route": {**route, "corridor": resolved}}, faults


def read_track(path: FilePath) -> tuple[list[list[float]], list[UnplacedFault]]:
    """The rows of a corridor's file, and what is wrong with it.

    Rows are numbers separated by commas, semicolons or blanks. Lines that start with ``#`` are
    comments, and so is a first line of names.
    """
    try:
        text = read_text(path, TRACK_FILE)
    except MissionError as error:
        return [], [_fault(f"{path}: {one.problem}", one.remedy) for one in error.faults]
    rows: list[list[float]] = []
    faults: list[UnplacedFault] = []
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        cells = line.replace(";", ",").replace(",", " ").split()
        row, wrong = _row(cells)
        if wrong is not None:
            if not rows and not faults and not any(map(is_number, cells)):
                continue  # the names of the columns
            faults.append(_fault(f"{path}:{number}: {wrong}", f"a row is {ROW_WORDS} in metres"))
        rows.append(row)
    if len(rows) < 2 and not faults:
        problem = f"{path}: has {len(rows)} rows, but a line needs two at least"
        faults.append(_fault(problem, f"give rows {ROW_WORDS} in metres"))
    more = len(faults) - MAX_REPORTED_FAULTS
    if more > 0:
        rest = _fault(f"{path}: {more} more rows are wrong", f"a row is {ROW_WORDS} in metres")
        faults = [*faults[:MAX_REPORTED_FAULTS], rest]
    return rows, faults


def _row(cells: list[str]) -> tuple[list[float], str | None]:
    """The numbers of a row, or what is wrong with it."""
    if len(cells) != 4:
        return [], f"has {len(cells)} columns"
    for cell in cells:
        if not is_number(cell):
            return [], f"'{cell[:20]}' is not a number"
    row = [float(cell) for cell in cells]
    for name, value in zip(("x", "y", "right", "left"), row, strict=True):
        if not abs(value) <= MAX_LENGTH_M:
            return [], f"{name} is {'NaN' if math.isnan(value) else 'out of range'}"
        if value < 0.0 and name in ("right", "left"):
            return [], f"the width to the {name} is negative: {value:g}"
    return row, None


def _fault(problem: str, remedy: str) -> UnplacedFault:
    return UnplacedFault(CSV_PATH, problem, remedy, at_key=True)


def given_twice(data: Any) -> list[UnplacedFault]:
    """What is wrong with a corridor that has both a line and a file of its own."""
    route = children((children(data) or {}).get("route")) or {}
    corridor = children(route.get("corridor")) or {}
    if corridor.get("line") is None or corridor.get("csv") is None:
        return []
    problem = "corridor has line and csv, which exclude each other"
    return [UnplacedFault(CSV_PATH, problem, "keep one of line and csv", at_key=True)]
