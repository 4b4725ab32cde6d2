"""Guides pulled taut, each once: on its way past many islands a leg is led the same way again.

Tested through ``planning/routing/test_lattice_route``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.routing.taut_path import TautPath

MOST_KEPT = 256  # guides: a hundred kilobytes each where they are long


@dataclass(frozen=True)
class PulledGuide:
    """What came of a guide.

    Attributes:
        taut_path: The route; None where the guide goes through a gap that is too narrow.
        narrow: Segments across such gaps, which no route crosses, (n, 4) [m].
    """

    taut_path: TautPath | None
    narrow: Floats


@dataclass(frozen=True, eq=False)
class PulledGuides:
    """What came of guides through one world, for one distance that is kept.

    It changes, but what it says doesn't depend on that: ``known_gaps`` alone grow.
    """

    _pulled: dict[tuple[bytes, float], PulledGuide] = field(default_factory=dict)
    _gaps: dict[bytes, Floats] = field(default_factory=dict)

    def once(self, guide: Floats, side: float, pull: Callable[[], PulledGuide]) -> PulledGuide:
        """What comes of a guide, or came of it before.

        Args:
            guide: (k, 2) [m].
            side: Of the cells of its lattice [m].
            pull: Pulls it taut.
        """
        asked = guide.tobytes(), side
        if asked not in self._pulled:
            if len(self._pulled) == MOST_KEPT:
                self._pulled.clear()
            found = self._pulled[asked] = pull()
            for gap in found.narrow:
                self._gaps[gap.tobytes()] = gap
        return self._pulled[asked]

    @property
    def known_gaps(self) -> Floats:
        """Segments across all the gaps that have proven too narrow so far, (n, 4) [m]."""
        return np.array(list(self._gaps.values())).reshape(-1, 4)
