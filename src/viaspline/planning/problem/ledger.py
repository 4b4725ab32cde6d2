"""The ledger: for each group of obstacles that was met, every side that was tried and its price."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.told_in_lines import told_in_lines

PassingSide = Literal["left", "right", "over", "under", "straight", "through"]
"""On which side of a thing a way goes past it, seen along the leg; straight where it only keeps
closer to the line than the spline does, through where it is a zone that may be driven through."""


@told_in_lines
@dataclass(frozen=True, eq=False)
class Candidate(ComparedByValue):
    """One way past a group.

    Attributes:
        side: The side of the group on which the robot would go, seen along the leg.
        vias: The detour via points of the leg [m], shape (k, d).
        spans: The curve of the whole leg as Bézier control polygons [m], shape (m, 4, d); empty
            when the side is impossible.
        length: Length of the leg's curve [m].
        duration: The time in which that is driven, as far as its shape tells [s].
        clearance: Proven distance between the body and every known obstacle on this leg [m].
        max_curvature: Largest curvature of the leg's curve [1/m].
        chosen: Whether the plan takes it.
        impossible: Why it can't be taken; None when it can.
        passed_over: Why it isn't taken though it costs less than what is; None where it doesn't.
    """

    side: PassingSide
    vias: NDArray[np.float64]
    spans: NDArray[np.float64]
    length: float | None = None
    duration: float | None = None
    clearance: float | None = None
    max_curvature: float | None = None
    chosen: bool = False
    impossible: str | None = None
    passed_over: str | None = None


@told_in_lines
@dataclass(frozen=True)
class LedgerEntry:
    """A group of obstacles that stood in the way of a leg, and the ways past it.

    Attributes:
        members: The names of the group's obstacles.
        leg: The names of the via points before and after.
        candidates: Every side that was tried.
        forced: The side on which the mission has it passed; None where either will do.
    """

    members: tuple[str, ...]
    leg: tuple[str, str]
    candidates: tuple[Candidate, ...]
    forced: PassingSide | None = None

    @property
    def chosen(self) -> Candidate | None:
        """The candidate that the plan takes."""
        return next((c for c in self.candidates if c.chosen), None)
