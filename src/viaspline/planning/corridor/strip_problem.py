"""What a line in a strip has to keep: the edges, what stands there, gates, a turning circle.

Tested through ``planning/corridor/test_corridor_planner``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.strip import Strip
from viaspline.planning.corridor.strip_edges import StripEdge
from viaspline.world.world import World


@dataclass(frozen=True, eq=False)
class Gate:
    """A place that the line runs through, exactly.

    Attributes:
        place: [m], (2,).
        row: Row of the strip that is nearest.
        direction: Unit vector in which it runs there, (2,), or None.
    """

    place: Floats
    row: int
    direction: Floats | None = None


@dataclass(frozen=True, eq=False)
class StripProblem:
    """What a line has to keep.

    Attributes:
        strip: Where it lies.
        margin: What it keeps from the edges, and from what stands in the strip [m].
        obstacles: What stands in the strip; None: nothing.
        gates: In the order of driving; an open line runs from the first to the last.
        max_curvature: [1/m]; None: no limit.
    """

    strip: Strip
    margin: float
    obstacles: World | None = None
    gates: tuple[Gate, ...] = ()
    max_curvature: float | None = None

    @cached_property
    def width(self) -> float:
        """The strip's usual width [m]."""
        return float(np.median(self.strip.widths))

    @cached_property
    def window(self) -> int:
        """How many rows before and after a place have edges that it may be near to."""
        return self.strip.rows_within(1.5 * float(self.strip.widths.max()))

    @cached_property
    def edges(self) -> tuple[StripEdge, StripEdge]:
        """On the right and on the left."""
        strip = self.strip
        return (
            StripEdge(strip.right, 1.0, strip.closed, self.window),
            StripEdge(strip.left, -1.0, strip.closed, self.window),
        )
