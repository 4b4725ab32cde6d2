"""Where the paths of a fleet come nearer each other than two robots may be."""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.kernels.fleet.packed_crossings import PackedCrossings


@dataclass(frozen=True, eq=False)
class FleetCrossings:
    """Pairs of places on two paths at which two robots would be too near each other.

    Attributes:
        packed: As kernels see them.
    """

    packed: PackedCrossings
