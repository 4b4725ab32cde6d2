"""A path: the curve that is drawn, checked, exported and driven, and where its via points lie."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.curve.arguments import frozen
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.handed_in import all_of

ViaKind = Literal["user", "detour"]
SEAM = "where the round closes"  # the name of a round's end, from where it goes on at its start
GUIDE = "along the corridor"  # the name of a place that only says which way a corridor leads


@dataclass(frozen=True)
class PathVia:
    """A via point as it lies on a path.

    Attributes:
        name: The user's name, or a name made from its place in the route.
        at: Its position [m], shape (d,).
        kind: ``user`` for a point of the route, ``detour`` for one that the planner put there.
        u: Its parameter on the path; user and detour via points lie on the joints of spans.
        dwell: How long the robot stays there [s].
        index: Its place in the mission's route (0 is the start), None for a detour.
    """

    name: str
    at: tuple[float, ...]
    kind: ViaKind
    u: float
    dwell: float = 0.0
    index: int | None = None


class Path(PiecewiseCubic):
    """A piecewise cubic that knows its via points.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).
        vias: The via points in order of ``u``.

    Example:
        >>> path = Path([[[0, 0], [1, 0], [2, 0], [3, 0]]], vias=[])
        >>> round(path.length, 9)
        3.0
    """

    def __init__(self, spans: ArrayLike, vias: Sequence[PathVia]) -> None:
        super().__init__(spans)
        self.vias = all_of("vias", vias, PathVia, "give PathVia(name, at, kind, u)")

    def _said(self) -> tuple[object, ...]:
        return *super()._said(), self.vias

    @cached_property
    def via_distances(self) -> NDArray[np.float64]:
        """Distance along the path of every via point [m], shape (k,)."""
        if not self.vias:
            return np.zeros(0)
        return frozen(np.asarray(self.distance(np.array([via.u for via in self.vias]))))

    @cached_property
    def stops(self) -> tuple[tuple[PathVia, float], ...]:
        """The points of the mission's route that lie on it, each with its distance along it [m]."""
        distances = self.via_distances.tolist()
        return tuple(
            (via, distance)
            for via, distance in zip(self.vias, distances, strict=True)
            if via.index is not None
        )
