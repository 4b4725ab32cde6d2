"""Does a corridor make sense, and what does it enclose?"""

from __future__ import annotations

from itertools import pairwise
from typing import Final

import numpy as np

from viaspline.mission.corridor_spec import Corridor
from viaspline.mission.fields import Corners
from viaspline.mission.partial_mission import PartialMission
from viaspline.mission.unplaced_faults import MAX_REPORTED_FAULTS, Path, UnplacedFault, number

CORRIDOR_PATH: Final[Path] = ("route", "corridor")
SAME_ROW_M: Final = 1e-6
"""Rows nearer to each other than this are one place."""


def corridor_faults(partial: PartialMission) -> list[UnplacedFault]:
    """A corridor without widths or with two, and lines that make no strip."""
    corridor = partial.corridor
    if corridor is None:
        return []
    widths = [key for key in ("left_m", "right_m") if getattr(corridor, key) is not None]
    line = next((key for key in ("csv", "line") if getattr(corridor, key) is not None), None)
    if line is not None and widths:
        problem = f"the corridor has {line} and {widths[0]}, which exclude each other"
        return [
            UnplacedFault((*CORRIDOR_PATH, widths[0]), problem, "keep one of the two", at_key=True)
        ]
    if line is None and len(widths) < 2:
        problem = f"the corridor has {widths[0]} only" if widths else "the corridor has no width"
        return [UnplacedFault(CORRIDOR_PATH, problem, "give left_m and right_m, or line, or csv")]
    return _line_faults(corridor, closed=bool(partial.closed)) if corridor.line is not None else []


def _line_faults(corridor: Corridor, *, closed: bool) -> list[UnplacedFault]:
    from viaspline.mission.strip import Strip

    rows = np.array(corridor.line)
    following = np.roll(rows, -1, axis=0) if closed else rows[1:]
    steps = np.linalg.norm(following[:, :2] - rows[: len(following), :2], axis=1)
    repeated = np.flatnonzero(steps < SAME_ROW_M)
    faults = []
    for row in repeated.tolist():
        then = (row + 1) % len(rows)
        problem = f"row {then + 1} is the same place as row {row + 1}"
        faults.append(UnplacedFault(_at(corridor, then), problem, "leave out one of the two"))
    if closed and len(rows) < 3:
        problem = f"a closed line has {len(rows)} rows only"
        faults.append(UnplacedFault(_at(corridor, 0), problem, "give three at least"))
    if not faults:
        faults = [
            UnplacedFault(
                _at(corridor, row),
                f"the edge on the {side} folds over itself between rows {row + 1} and "
                f"{(row + 1) % len(rows) + 1}: {number(rows[row, 2 if side == 'right' else 3])} m "
                "is more than the bend there leaves room for",
                f"make the corridor narrower on the {side} there, or its line smoother",
            )
            for row, side in Strip.of_rows(corridor.line, closed=closed).folds
        ]
    return faults[:MAX_REPORTED_FAULTS]


def _at(corridor: Corridor, row: int) -> Path:
    return (*CORRIDOR_PATH, "line", row) if corridor.csv is None else (*CORRIDOR_PATH, "csv")


def corridor_of(partial: PartialMission) -> list[tuple[Path, tuple[Corners, ...]]]:
    """The area of a corridor, if there is one that makes sense: outer ring and holes."""
    from viaspline.mission.strip import Strip, around, rings_of

    corridor, closed = partial.corridor, bool(partial.closed)
    if corridor is None:
        return []
    if corridor.line is not None:
        return [(CORRIDOR_PATH, rings_of(Strip.of_rows(corridor.line, closed=closed).area))]
    places = [point.at[:2] for _, point in partial.points if point is not None]
    whole = len(places) == len(partial.points) and len(places) > 1
    apart = all(a != b for a, b in pairwise(places))
    if corridor.left_m is None or corridor.right_m is None or not (whole and apart):
        return []
    area = around(places, corridor.right_m, corridor.left_m, closed=closed)
    return [(CORRIDOR_PATH, rings_of(area))]
