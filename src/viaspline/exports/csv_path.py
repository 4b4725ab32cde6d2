"""A path as a table of numbers.

Tested through ``exports/test_other_readers``.
"""

from __future__ import annotations

import csv
import io
from typing import ClassVar, Final

from viaspline.exports.path_format import Carried
from viaspline.exports.path_table import DIGITS_DEG, DIGITS_M, PathTable

_BREAKS: Final = "\r\n"


class CsvPath:
    """A line for each point, with the place in degrees if the origin is known.

    The columns: distance_m (along the exact curve), x_m, y_m, z_m (in space), latitude, longitude,
    heading_rad, speed_mps (there, as planned), time_s (of arrival), dwell_s, via (its name).
    """

    description: ClassVar[str] = "a table"
    endings: ClassVar[tuple[str, ...]] = (".csv",)
    carries: ClassVar[frozenset[Carried]] = frozenset(
        {"speeds", "times", "dwells", "headings", "names"}
    )
    is_geographic: ClassVar[bool] = False
    is_cut_at_180: ClassVar[bool] = False
    is_driven: ClassVar[bool] = False
    spacing: ClassVar[float | None] = None

    def write(self, table: PathTable) -> bytes:
        """The file of a path."""
        columns: dict[str, list[str]] = {"distance_m": _texts(table.distances, 6)}
        for i, axis in enumerate("xyz"[: table.points.shape[1]]):
            columns[f"{axis}_m"] = _texts(table.points[:, i], DIGITS_M)
        if table.geodetic is not None:
            columns["latitude"] = _texts(table.geodetic[:, 0], DIGITS_DEG)
            columns["longitude"] = _texts(table.geodetic[:, 1], DIGITS_DEG)
        columns["heading_rad"] = _texts(table.headings, 9)
        columns["speed_mps"] = _texts(table.speeds, 6)
        columns["time_s"] = _texts(table.times, 6)
        columns["dwell_s"] = _texts(table.dwells, 6)
        columns["via"] = [name or "" for name in table.names]
        rows = zip(*columns.values(), strict=True)
        return "".join(map(_line, (tuple(columns), *rows))).encode()


def _line(cells: tuple[str, ...]) -> str:
    """A line of the table; csv quotes those breaks alone that end its own lines."""
    text = io.StringIO()
    csv.writer(text, lineterminator=_BREAKS).writerow(cells)
    return text.getvalue().removesuffix(_BREAKS) + "\n"


def _texts(values: object, digits: int) -> list[str]:
    import numpy as np

    return [f"{value + 0.0:.{digits}f}" for value in np.asarray(values, float).tolist()]
