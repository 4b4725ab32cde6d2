"""Points that are to be passed in a direction: which orders pass them the wrong way round.

A point is passed backwards where the way comes from ahead of it and goes on behind it. A way that
comes from ahead and goes on ahead turns round before it, and one from behind to behind after it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints

NOWHERE: Final = -1
"""Behind the last point of an order that just ends there."""


@dataclass(frozen=True, eq=False)
class FacingPoints:
    """Points of a round and the directions that some of them face.

    Attributes:
        places: Where they are, level [m], (n, 2).
        ways: The level unit vectors of the directions that they face, zero where none, (n, 2).

    >>> places = np.array([[0.0, 0], [5, 0], [9, 0]])
    >>> row = FacingPoints(places, np.array([[0.0, 0], [-1, 0], [0, 0]]))
    >>> row.backwards((0, 1, 2)), row.backwards((2, 1, 0))
    ([1], [])
    """

    places: Floats
    ways: Floats

    def backwards(self, stops: Sequence[int]) -> list[int]:
        """The points that an order passes backwards.

        Args:
            stops: The order, from the first point to the last, which may be ``NOWHERE``: then the
                one before it is where the round ends.
        """
        at = np.array(stops, np.int64)
        return [int(k) for k in at[1:-1][self.wrong(at[:-2], at[1:-1], at[2:])]]

    def wrong(self, before: Ints, at: Ints, behind: Ints) -> Flags:
        """Whether points are passed backwards between others, for every row of three."""
        on = (self.ahead(at, behind) < 0.0) | (behind == NOWHERE)
        return np.asarray((self.ahead(at, before) > 0.0) & on)

    def ahead(self, at: Ints, others: Ints) -> Floats:
        """How far ahead of points others lie [m], elementwise; 0 of a point that faces nowhere.

        Args:
            at: The points.
            others: The others; NOWHERE gives a number without a meaning.
        """
        apart = self.places[others] - self.places[at]
        return np.asarray(apart[..., 0] * self.ways[at, 0] + apart[..., 1] * self.ways[at, 1])
