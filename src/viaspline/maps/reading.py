"""How a map was read from its file.

Tested through ``maps/test_map_server``.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

Unknown: TypeAlias = Literal["blocked", "free"]
"""What to make of squares, or of cubes, that nobody has seen."""


@dataclass(frozen=True)
class Reading:
    """What it takes to read a grid, voxels or a terrain once more; a mission is written with it.

    Attributes:
        path: The file, absolute.
        unknown: What was made of squares that nobody has seen.
        resolution: The side of a square [m] that was asked for; None: what the file says.
        origin: Where the file's own ``0, 0, 0`` was put [m]; voxels have that.
    """

    path: Path
    unknown: Unknown = "blocked"
    resolution: float | None = None
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
