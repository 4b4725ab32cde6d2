"""The maps and problems of MovingAI's benchmarks: https://movingai.com/benchmarks/formats.html."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from viaspline.bounded_file import MAP_FILE, SQUARES_FILE, read_bytes, read_text
from viaspline.errors import MissionError
from viaspline.maps.grid import Grid
from viaspline.maps.map_faults import check_size, refusal
from viaspline.maps.reading import Reading

_FREE: Final = b".GS"
_BLOCKED: Final = b"@OTW"
_HEADER: Final = re.compile(
    rb"type +\w+\s+(?:height +(\d{1,9})\s+width +(\d{1,9})|width +(\d{1,9})\s+height +(\d{1,9}))"
    rb"\s+map *\r?\n"
)
_FIELDS: Final = 9


def read_movingai(
    path: str | Path, resolution: float | None = None, *, source: str | None = None
) -> Grid:
    """Read a ``.map``: one character a square, ``.GS`` free and ``@OTW`` blocked.

    The lower left corner of the map is the plane's origin; outside of it nothing is known, and
    nothing blocked.

    Args:
        path: The file.
        resolution: Side of a square [m]; 1 if it isn't given.
        source: What the grid's file is called; ``path`` if it isn't given.

    Raises:
        MissionError: The file can't be read, or is no such map; with line and column.
    """
    file = Path(path)
    blocked = _squares(file, read_bytes(file, SQUARES_FILE))
    name = str(path) if source is None else source
    reading = Reading(file.absolute(), resolution=resolution)
    return Grid(blocked, resolution or 1.0, source=name, reading=reading)


def _squares(path: Path, data: bytes) -> NDArray[np.bool_]:
    header = _HEADER.match(data)
    if header is None:
        remedy = "it should be type octile, height, width and map, a line each, then the rows"
        raise refusal(path, "the header of the map is broken", remedy, at=(1, 1))
    height, width = (int(header[i] or header[j]) for i, j in ((1, 4), (2, 3)))
    check_size(path, width, height)
    rows = data[header.end() :].rstrip().split(b"\n")
    first = data.count(b"\n", 0, header.end()) + 1
    if len(rows) != height:
        problem = f"the map has {len(rows)} rows, but its header says {height}"
        raise refusal(path, problem, "correct the height", at=(first + len(rows) - 1, 1))
    blocked = np.empty((height, width), np.bool_)
    table = np.zeros(256, np.bool_)
    table[list(_BLOCKED)] = True
    for i, row in enumerate(rows):
        cells = row.rstrip(b"\r ")
        if len(cells) != width or cells.strip(_FREE + _BLOCKED):
            raise _wrong_row(path, cells, width, first + i)
        blocked[height - 1 - i] = table[np.frombuffer(cells, np.uint8)]
    blocked.flags.writeable = False
    return blocked


def _wrong_row(path: Path, cells: bytes, width: int, line: int) -> MissionError:
    if len(cells) != width:
        problem = f"the row has {len(cells)} squares, but the header says {width}"
        return refusal(path, problem, "correct the row or the width", at=(line, 1))
    column = next(i for i, cell in enumerate(cells) if cell not in _FREE + _BLOCKED)
    problem = f"the character {chr(cells[column])!r} isn't a kind of square"
    return refusal(path, problem, "it should be one of . G S @ O T W", at=(line, column + 1))


@dataclass(frozen=True)
class BenchmarkProblem:
    """A way to find in a map.

    Attributes:
        bucket: The problem's class of length: its optimal length in squares, by fours.
        map: The file name of the map, as the problem has it.
        start: x, y [m] of the middle of a square.
        goal: x, y [m].
        optimal: Length [m] of the shortest way from square to square in eight directions that cuts
            no corner. A way of any angle may be a few percent shorter.
    """

    bucket: int
    map: str
    start: tuple[float, float]
    goal: tuple[float, float]
    optimal: float


def read_problems(path: str | Path, resolution: float = 1.0) -> tuple[BenchmarkProblem, ...]:
    """Read a ``.scen``: the problems of a map.

    Args:
        path: The file.
        resolution: Side of a square of the map [m].

    Raises:
        MissionError: The file can't be read, or is no such list; with its line.
    """
    file = Path(path)
    lines = read_text(file, MAP_FILE).splitlines()
    if not lines or not re.fullmatch(r"version +1(\.0)?", lines[0].strip()):
        problem = "the list of problems has no header"
        raise refusal(file, problem, "its first line should be version 1", at=(1, 1))
    numbered = [(number, line) for number, line in enumerate(lines[1:], 2) if line.strip()]
    return tuple(_problem(file, number, line, resolution) for number, line in numbered)


def _problem(path: Path, number: int, line: str, resolution: float) -> BenchmarkProblem:
    fields = line.split("\t") if "\t" in line else line.split()
    try:
        if len(fields) != _FIELDS:
            raise ValueError
        bucket, (height, *cells) = int(fields[0]), map(int, fields[3:8])
        x0, y0, x1, y1 = cells
        optimal = float(fields[8])
    except ValueError:
        remedy = "it should be bucket, map, width, height, start x y, goal x y, optimal length"
        raise refusal(path, f"found {line!r}", remedy, at=(number, 1)) from None

    def middle(x: int, y: int) -> tuple[float, float]:
        return (x + 0.5) * resolution, (height - y - 0.5) * resolution

    return BenchmarkProblem(bucket, fields[1], middle(x0, y0), middle(x1, y1), optimal * resolution)
