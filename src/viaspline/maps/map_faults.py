"""Faults in map files.

Tested through ``maps/test_map_server``, ``maps/test_movingai`` and ``maps/test_svg``.
"""

from __future__ import annotations

from pathlib import Path

from viaspline.errors import Fault, MissionError
from viaspline.maps.grid import MOST_CELLS_ASIDE


def refusal(
    source: str | Path,
    problem: str,
    remedy: str,
    *,
    key: str = "",
    at: tuple[int, int] | None = None,
) -> MissionError:
    """An error with a single fault.

    Args:
        source: The file.
        problem: What is wrong.
        remedy: What would be right.
        key: Where in the file, in its own words.
        at: Line and column, from 1; None where it has none.
    """
    line, column = at if at is not None else (None, None)
    return MissionError([Fault(key, problem, remedy, str(source), line, column)])


def check_size(source: str | Path, width: int, height: int) -> None:
    """Refuse a map without cells and one that is too large, before anything is made for it.

    Raises:
        MissionError: It has no cell, or too many aside.
    """
    if width < 1 or height < 1:
        raise refusal(source, f"the map has {width} x {height} cells", "give at least one")
    if max(width, height) > MOST_CELLS_ASIDE:
        problem = f"the map has {width} x {height} cells"
        raise refusal(source, problem, f"cut it: at most {MOST_CELLS_ASIDE} aside are read")
