"""What the pixels of a map mean, as ROS's map_server has it.

A pixel of brightness x (0 to 1, the mean of its channels) is occupied with p = 1 - x, or p = x for
a map that is negated. Then, by the map's mode:

- ``trinary``: occupied where p > occupied_thresh, free where p < free_thresh, else unknown. The
  opacity, if there is one, counts as one more channel.
- ``scale``: 100 where p >= occupied_thresh, 0 where p < free_thresh, graded in between; unknown
  where the pixel is not wholly opaque. What is graded is not blocked.
- ``raw``: the brightness in 256ths is the occupancy itself: from 0 to 100, or unknown above.
  Blocked is what is at least occupied_thresh of 100. ``negate`` doesn't count.

See http://wiki.ros.org/map_server for the rules, and nav2_map_server's map_io for what they leave
open: opacity, raw values, equality.

Tested through ``maps/test_map_server``, beside Nav2's rules pixel by pixel.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Flags
from viaspline.maps.picture import Picture
from viaspline.maps.reading import Unknown

Mode: TypeAlias = Literal["trinary", "scale", "raw"]
MODES: tuple[Mode, ...] = get_args(Mode)


@dataclass(frozen=True)
class Meaning:
    """From brightness to what a square is.

    Attributes:
        mode: See above.
        negate: Whether white is occupied.
        occupied_thresh: Occupied from here, 0 to 1.
        free_thresh: Free below.
    """

    mode: Mode = "trinary"
    negate: bool = False
    occupied_thresh: float = 0.65
    free_thresh: float = 0.25

    def of(self, level: NDArray[Any], white: int) -> tuple[Flags, Flags]:
        """Whether levels of brightness are occupied, and whether they are unknown.

        Args:
            level: From 0 to ``white``; any shape.
            white: The greatest level.

        >>> occupied, unknown = Meaning().of(np.array([0, 128, 255]), white=255)
        >>> occupied.tolist(), unknown.tolist()
        ([True, False, False], [False, True, False])
        """
        if self.mode == "raw":
            percent = np.floor(level * (255 / white) + 0.5)
            unknown = percent > 100
            return ~unknown & (percent / 100 >= self.occupied_thresh), unknown
        p = (level if self.negate else white - level) / white
        if self.mode == "scale":
            return p >= self.occupied_thresh, np.zeros(p.shape, np.bool_)
        occupied = p > self.occupied_thresh
        return occupied, ~occupied & (p >= self.free_thresh)


def squares_of(picture: Picture, meaning: Meaning, unknown: Unknown) -> tuple[Flags, Flags | None]:
    """The squares of a picture; the lowest row comes first, as in a grid.

    Args:
        picture: The picture.
        meaning: What its pixels mean.
        unknown: What to make of squares that are unknown.

    Returns:
        (blocked, unknown), (height, width) each and read-only, as a `Grid` takes them; the second
        is None if nothing is blocked for being unknown.
    """
    blocked = np.empty((picture.height, picture.width), np.bool_)
    unseen = np.empty_like(blocked)
    for rows, pixels in picture.bands():
        target = slice(picture.height - rows.stop, picture.height - rows.start)
        occupied, veiled = _squares(pixels, picture, meaning)
        unseen[target] = veiled[::-1] if unknown == "blocked" else False
        blocked[target] = occupied[::-1]
        blocked[target] |= unseen[target]
    blocked.flags.writeable = False
    unseen.flags.writeable = False
    return blocked, unseen if unseen.any() else None


def _squares(pixels: NDArray[Any], picture: Picture, meaning: Meaning) -> tuple[Flags, Flags]:
    """Which pixels are occupied, and which unknown: looked up, as there are few levels."""
    channels = pixels.shape[2]
    counted = channels if meaning.mode == "trinary" or not picture.has_alpha else channels - 1
    levels = pixels[:, :, :counted].sum(axis=2, dtype=np.int32)
    white = counted * picture.white
    occupied, unknown = (table[levels] for table in meaning.of(np.arange(white + 1), white))
    if meaning.mode == "scale" and picture.has_alpha:
        veiled = pixels[:, :, -1] < picture.white
        return occupied & ~veiled, veiled
    return occupied, unknown
