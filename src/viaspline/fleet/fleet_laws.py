"""The time laws of a fleet."""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.kernels.fleet.packed_laws import PackedLaws


@dataclass(frozen=True, eq=False)
class FleetLaws:
    """When every robot of a fleet is where.

    Attributes:
        packed: As kernels see them.
    """

    packed: PackedLaws
