"""The picture under a mission, as somebody asks for it and as it is kept.

Tested through ``studio/background/test_studio_settings``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

from viaspline.studio.background.earth_grids import METRES, check_grid
from viaspline.studio.refused_error import RefusedError

Corners: TypeAlias = tuple[tuple[float, float], tuple[float, float]]

DEFAULT_OPACITY: Final = 0.7
_KEYS: Final = ("picture", "opacity", "grid", "corners")


@dataclass(frozen=True)
class Background:
    """A picture under a mission.

    Attributes:
        picture: Its file, from the folder of the mission's.
        opacity: From 0, not seen, to 1.
        grid: What its corners, or the numbers of its world file, are: ``metres`` of the mission,
            ``degrees``, or ``EPSG:…``. A GeoTIFF that says its own is believed.
        corners: The bottom left and the top right one, in degrees as latitude, longitude; None: the
            file says where it lies.
    """

    picture: str
    opacity: float = DEFAULT_OPACITY
    grid: str = METRES
    corners: Corners | None = None

    @classmethod
    def parsed(cls, value: Any) -> Background:
        """Of what a page or a file says.

        Raises:
            RefusedError: It is something else.

        >>> Background.parsed({"picture": "site.png", "corners": [[0, 0], [90, 60]]}).opacity
        0.7
        """
        if not isinstance(value, Mapping) or not set(value) <= set(_KEYS):
            raise RefusedError(f"a background has {', '.join(_KEYS)}")
        picture, grid = value.get("picture"), value.get("grid", METRES)
        if not isinstance(picture, str) or not picture:
            raise RefusedError("a background needs the file of a picture")
        if not isinstance(grid, str):
            raise RefusedError("the grid of a background is a text: metres, degrees or EPSG:32632")
        check_grid(grid)
        opacity = value.get("opacity", DEFAULT_OPACITY)
        if not _is_number(opacity) or not 0 <= opacity <= 1:
            raise RefusedError("the opacity of a background is a number from 0 to 1")
        return cls(picture, float(opacity), grid, _corners(value.get("corners")))

    @property
    def as_json(self) -> dict[str, Any]:
        """What is kept of it."""
        data: dict[str, Any] = {
            "picture": self.picture, "opacity": self.opacity, "grid": self.grid,
        }  # fmt: skip
        return data if self.corners is None else {**data, "corners": [*map(list, self.corners)]}


def _corners(value: Any) -> Corners | None:
    if value is None:
        return None
    is_pair = isinstance(value, list | tuple) and len(value) == 2
    if not is_pair or not all(isinstance(c, list | tuple) and len(c) == 2 for c in value):
        raise RefusedError("the corners of a background are two pairs: bottom left, top right")
    if not all(_is_number(number) for corner in value for number in corner):
        raise RefusedError("the corners of a background are numbers")
    (a, b), (c, d) = value
    if not (a < c and b < d):
        problem = "the second corner of the background has to lie above and to the right"
        raise RefusedError(f"{problem} of the first: give bottom left, then top right")
    return (float(a), float(b)), (float(c), float(d))


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
