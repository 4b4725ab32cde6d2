"""A path pulled taut round what stands between two places: the shortest of its kind.

Tested through ``planning/routing/test_router``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.routing.tangent_arcs import bends_of, detour_points, taut_length
from viaspline.kernels.routing.tangent_graph import barrier_crossings
from viaspline.kernels.world.corner_fans import X, Y

SAME_M = 1e-6  # paths whose lengths or places differ by less are one
WOUND = 1e-9  # part of its length by which a path that isn't taut is longer
PLACES = 16  # along a path, at which another is looked for


@dataclass(frozen=True)
class TautPath:
    """A taut path between two places.

    Attributes:
        corners: Corner rows, see ``kernels.world.corner_fans``, shape (k, 8), start and goal
            among them.
        bends: Pulled taut, see ``kernels.routing.tangent_arcs``, shape (m, 6); empty where the arcs
            have no common tangents.
        length: [m].
    """

    corners: Floats
    bends: Floats
    length: float

    @property
    def is_direct(self) -> bool:
        """Whether nothing stands between the two places."""
        return len(self.corners) == 2

    @property
    def is_wound(self) -> bool:
        """Whether its bends are longer than the corners that they are to be pulled taut from.

        Two arcs may be touched in another order than their corners: the bends go round one then.
        """
        steps = np.diff(self.corners[:, X : Y + 1], axis=0)
        return self.length > (1.0 + WOUND) * float(np.hypot(*steps.T).sum())

    @property
    def turns(self) -> Floats:
        """The corners between start and goal [m], shape (n, 2): their polyline is clear."""
        return np.ascontiguousarray(self.corners[1:-1, X : Y + 1])

    @cached_property
    def _places(self) -> Floats:
        """Places along its corners, equally far from each other [m], (PLACES, 2)."""
        at = self.corners[:, [X, Y]]
        along = np.concatenate(([0.0], np.hypot(*np.diff(at, axis=0).T).cumsum()))
        wanted = np.linspace(0.0, along[-1], PLACES)
        places: Floats = np.column_stack([np.interp(wanted, along, axis) for axis in at.T])
        return places

    def is_same(self, other: TautPath) -> bool:
        """Whether another path lies where it does: by other sides one may be as long as it."""
        if abs(self.length - other.length) > SAME_M:
            return False
        return bool(np.abs(self._places - other._places).max() <= SAME_M)

    def points(self, efforts: Floats) -> tuple[Floats, Ints]:
        """Detour via points along its bends; see ``tangent_arcs.detour_points``.

        Args:
            efforts: One for each bend, (m, 2).

        Returns:
            (points (n, 2) [m], the bend that each is of (n,)).
        """
        points: tuple[Floats, Ints] = detour_points(self.bends, efforts)
        return points

    @classmethod
    def through(cls, corners: Floats) -> TautPath:
        """The taut path along given corners."""
        bends = bends_of(corners)
        return cls(corners, bends, float(taut_length(corners, bends)))

    def crosses(self, barrier: Floats) -> bool:
        """Whether it crosses a barrier, shape (1, 4), an odd number of times."""
        return barrier_crossings(self.corners, barrier)[0] % 2 == 1

    def window(self, barrier: Floats, reach: int) -> tuple[int, int]:
        """The corners ``reach`` before and after the place where it crosses a barrier first."""
        crossing = barrier_crossings(self.corners, barrier)[1]
        return max(0, crossing - reach), min(len(self.corners) - 1, crossing + 1 + reach)

    def spliced(self, first: int, last: int, part: TautPath) -> TautPath:
        """This path with ``part`` between two of its corners."""
        inner = part.corners[1:-1]
        rows = (self.corners[: first + 1], inner, self.corners[last:])
        return TautPath.through(np.concatenate(rows))
