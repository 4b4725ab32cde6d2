"""A picture, a band of rows at a time.

A map of a hundred million squares is an everyday thing: nothing as large as the whole picture is
made beside the picture itself.

Tested through ``maps/test_map_server``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Pixels: TypeAlias = NDArray[np.unsignedinteger[Any]]

BAND_PIXELS = 1 << 20
"""About so many pixels are in a band."""


@dataclass(frozen=True)
class Picture:
    """A picture whose top row comes first.

    Attributes:
        width: Pixels in a row.
        height: Rows.
        white: The greatest value of a channel.
        has_alpha: Whether the last channel is an opacity.
        rows: Gives the rows from one to before another, (rows, width, channels): grey or red,
            green and blue, then the opacity if there is one.
    """

    width: int
    height: int
    white: int
    has_alpha: bool
    rows: Callable[[int, int], Pixels]

    def bands(self) -> Iterator[tuple[slice, Pixels]]:
        """Rows from the top down, and which they are."""
        step = max(BAND_PIXELS // self.width, 1)
        for first in range(0, self.height, step):
            last = min(first + step, self.height)
            yield slice(first, last), self.rows(first, last)
