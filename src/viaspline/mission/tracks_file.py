"""The file of recorded motions: rows id, t, x, y in seconds and metres.

Tested through ``mission/test_tracks``.
"""

from __future__ import annotations

import csv
import io
import math
from pathlib import Path as FilePath
from typing import Final

import numpy as np

from viaspline.bounded_file import MOTION_FILE, read_text
from viaspline.errors import Fault, MissionError
from viaspline.mission.fields import MAX_DURATION_S, MAX_LENGTH_M
from viaspline.mission.greatest_speed import gone_too_fast
from viaspline.mission.unplaced_faults import MAX_REPORTED_FAULTS

COLUMNS: Final = ("id", "t_s", "x_m", "y_m")
_LIMITS: Final = (MAX_DURATION_S, MAX_LENGTH_M, MAX_LENGTH_M)

Row = tuple[float, float, float]


def read_tracks(path: FilePath) -> dict[str, list[Row]]:
    """The keyframes of every id, in the order in which ids are first met.

    Rows are separated by commas, semicolons or blanks, in any order of time. A first line may name
    the columns, then they may stand in any order and others are passed over; lines that start with
    ``#`` are comments.

    Raises:
        MissionError: The file can't be read, or rows make no sense; the first few, each with its
            line.
    """
    text = read_text(path, MOTION_FILE)
    tracks: dict[str, dict[float, Row]] = {}
    faults: list[Fault] = []
    places: tuple[int, ...] | None = None
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        cells = _cells(line)
        if places is None:
            named = _header(cells)
            places = named or (0, 1, 2, 3)
            if named:
                continue
        try:
            _add(tracks, cells, places)
        except ValueError as error:
            faults.append(
                Fault("", str(error), "a row is id, t, x, y in s and m", str(path), number, 1)
            )
            if len(faults) == MAX_REPORTED_FAULTS:
                break
    found = {name: [rows[t] for t in sorted(rows)] for name, rows in tracks.items()}
    faults += _too_fast(found, path)[: MAX_REPORTED_FAULTS - len(faults)]
    if not tracks and not faults:
        remedy = "give rows id, t, x, y in s and m"
        faults.append(Fault("", "has no rows", remedy, str(path)))
    if faults:
        raise MissionError(faults)
    return found


def _too_fast(tracks: dict[str, list[Row]], path: FilePath) -> list[Fault]:
    """What is wrong with how fast they go, one fault an id."""
    faults = []
    for name, rows in tracks.items():
        table = np.array(rows)
        found = gone_too_fast(table[:, 0], table[:, 1:])
        if found is not None:
            i, problem, remedy = found
            words = f"the row of '{name[:20]}' at {rows[i][0]:g} s {problem}"
            faults.append(Fault("", words, remedy, str(path)))
    return faults


def _cells(line: str) -> list[str]:
    """The cells of a line, whatever separates them."""
    for mark in (",", ";"):
        if mark in line:
            return [cell.strip() for cell in next(csv.reader(io.StringIO(line), delimiter=mark))]
    return line.split()


def _header(cells: list[str]) -> tuple[int, ...] | None:
    """Where the columns stand if the first line names them."""
    lowered = [cell.lower() for cell in cells]
    found = []
    for name in COLUMNS:
        short = name.partition("_")[0]
        if name in lowered:
            found.append(lowered.index(name))
        elif short in lowered:
            found.append(lowered.index(short))
        else:
            return None
    return tuple(found)


def _add(tracks: dict[str, dict[float, Row]], cells: list[str], places: tuple[int, ...]) -> None:
    """Put a row to its id.

    Raises:
        ValueError: It makes no sense, with the reason.
    """
    if len(cells) <= max(places):
        raise ValueError(f"has {len(cells)} columns")
    name = cells[places[0]]
    if not name:
        raise ValueError("has no id")
    values = []
    for column, place, limit in zip(COLUMNS[1:], places[1:], _LIMITS, strict=True):
        try:
            value = float(cells[place])
        except ValueError:
            raise ValueError(f"'{cells[place][:20]}' is not a number") from None
        if not abs(value) <= limit:
            raise ValueError(f"{column} is {'NaN' if math.isnan(value) else 'out of range'}")
        values.append(value)
    t, x, y = values
    rows = tracks.setdefault(name, {})
    if t in rows and rows[t] != (t, x, y):
        raise ValueError(f"puts '{name[:20]}' in two places at {t:g} s")
    rows[t] = (t, x, y)
