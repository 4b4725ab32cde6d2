"""A log of a drive: where the robot was, and what it was told; and its CSV file.

Whatever holds such a log can be read into one: a ``DriveLog`` is a value of plain arrays.
"""

from __future__ import annotations

import csv
import io
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from viaspline.bounded_file import FileKind, read_bytes
from viaspline.errors import GeometryError, ViasplineError
from viaspline.handed_in import numbers_from
from viaspline.kernels.arrays import Floats

COLUMNS = ("time_s", "x_m", "y_m", "heading_rad", "speed_command_mps", "yaw_rate_command_radps")
"""Of the CSV file; others may stand beside them. ``heading_deg`` may take the place of radians."""

LOG_FILE = FileKind("log of a drive", 40_000_000, "take a part of it: a minute is enough")

MIN_ROWS, MIN_SECONDS = 50, 5.0
"""What a log has to have."""


class DriveLogError(ViasplineError):
    """A log can't be read, or doesn't show enough to fit a drive."""


@dataclass(frozen=True, eq=False)
class DriveLog:
    """What was measured and what was commanded, moment by moment.

    A command holds from its moment to the next one. All arrays have shape (n,), are finite and
    read-only; headings run on over whole turns.

    Attributes:
        times: Increasing [s].
        x: [m].
        y: [m].
        headings: Of the body, anticlockwise from x [rad].
        speeds: Commanded along the body [m/s].
        yaw_rates: Commanded [rad/s].

    Raises:
        GeometryError: When the arrays make no log.

    Example:
        >>> t = np.arange(0.0, 10.0, 0.05)
        >>> log = DriveLog(t, t, 0 * t, 0 * t, 0 * t + 1.0, 0 * t)
        >>> round(log.seconds, 6), round(float(log.along[-1]), 6)
        (9.95, 9.95)
    """

    times: Floats
    x: Floats
    y: Floats
    headings: Floats
    speeds: Floats
    yaw_rates: Floats

    def __post_init__(self) -> None:
        names = ("times", "x", "y", "headings", "speeds", "yaw_rates")
        for name in names:
            values = numbers_from(name, getattr(self, name)).astype(np.float64)
            if values.ndim != 1 or not np.isfinite(values).all():
                raise GeometryError(f"{name} of a log have to be finite numbers, shape (n,)")
            if name == "headings":
                values = np.unwrap(values)
            values.flags.writeable = False
            object.__setattr__(self, name, values)
        sizes = {len(getattr(self, name)) for name in names}
        if len(sizes) > 1:
            raise GeometryError(f"the arrays of a log have different lengths: {sorted(sizes)}")
        if not (np.diff(self.times) > 0.0).all():
            raise GeometryError("the times of a log have to increase from row to row")
        if len(self.times) < MIN_ROWS or self.seconds < MIN_SECONDS:
            raise GeometryError(
                f"a log of {len(self.times)} rows over {self.seconds:.1f} s is too short; give "
                f"{MIN_ROWS} rows and {MIN_SECONDS:g} s at least (viaspline identify --drive "
                "writes the commands of a drive that shows enough)"
            )

    @property
    def seconds(self) -> float:
        """How long it is [s]."""
        return float(self.times[-1] - self.times[0]) if len(self.times) else 0.0

    @property
    def along(self) -> Floats:
        """What was driven forward since the first row [m], shape (n,)."""
        middle = 0.5 * (self.headings[1:] + self.headings[:-1])
        steps = np.diff(self.x) * np.cos(middle) + np.diff(self.y) * np.sin(middle)
        return np.concatenate(([0.0], np.cumsum(steps)))


def read_drive_csv(path: Path) -> DriveLog:
    """The log in a CSV file with the columns ``COLUMNS``.

    Raises:
        DriveLogError: When something of it is missing or no number; it names the line.
        OSError: When the file can't be read.
    """
    text = read_bytes(path, LOG_FILE).decode("utf-8-sig", errors="replace")
    reader = csv.reader(io.StringIO(text))
    try:
        header = [name.strip() for name in next(reader)]
        wanted = list(COLUMNS)
        if "heading_rad" not in header and "heading_deg" in header:
            wanted[3] = "heading_deg"
        missing = [name for name in wanted if name not in header]
        if missing:
            raise DriveLogError(
                f"{path}:1: no column {', '.join(missing)}; a log has {', '.join(COLUMNS)}"
            )
        places = [header.index(name) for name in wanted]
        rows = [
            _numbers(path, line, row, places, wanted)
            for line, row in enumerate(reader, 2)
            if any(cell.strip() for cell in row)
        ]
    except StopIteration:
        raise DriveLogError(f"{path}: is empty; a log has {', '.join(COLUMNS)}") from None
    except csv.Error as error:
        raise DriveLogError(f"{path}: isn't a CSV file: {error}") from None
    columns = np.array(rows).reshape(-1, len(COLUMNS)).T
    if wanted[3] == "heading_deg":
        columns[3] = np.radians(columns[3])
    try:
        return DriveLog(*columns)
    except GeometryError as error:
        raise DriveLogError(f"{path}: {error}") from None


def _numbers(
    path: Path, line: int, row: list[str], places: list[int], names: list[str]
) -> list[float]:
    found = []
    for place, name in zip(places, names, strict=True):
        cell = row[place].strip() if place < len(row) else ""
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise DriveLogError(f"{path}:{line}: {name} is {cell!r:.40}; give a finite number")
        found.append(value)
    return found


def drive_csv(log: DriveLog) -> str:
    """A log as the text of its CSV file."""
    columns = (log.times, log.x, log.y, log.headings, log.speeds, log.yaw_rates)
    lines = [",".join(COLUMNS)]
    lines += [
        ",".join(f"{value:.6f}" for value in row) for row in np.column_stack(columns).tolist()
    ]
    return "\n".join(lines) + "\n"
