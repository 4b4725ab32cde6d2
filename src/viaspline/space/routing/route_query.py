"""What is asked of a search for a route in space, and what is wrong with it.

Tested through ``space/routing/test_space_router``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from viaspline.errors import GeometryError
from viaspline.handed_in import number_from, numbers_from
from viaspline.kernels.arrays import Floats
from viaspline.space.routing.taut_route import Norm


@dataclass(frozen=True, eq=False)
class RouteQuery:
    """What is asked of a search.

    Attributes:
        ends: Start and goal [m], (2, 3).
        radius: To be kept from everything [m].
        norm: See ``kernels.space.routing.travel_norm``, (3,).
        gates: See ``pass_gates``, (g, 8).
        margin: How far beyond all solids a route may go [m].
    """

    ends: Floats
    radius: float
    norm: Floats
    gates: Floats
    margin: float

    @property
    def reversed(self) -> RouteQuery:
        """The one for the way back, where climbing is sinking."""
        return replace(self, ends=self.ends[::-1].copy(), norm=self.norm[[0, 2, 1]])


def checked_ends(start: ArrayLike, goal: ArrayLike) -> Floats:
    """Two places [m], (2, 3).

    Raises:
        GeometryError: They are something else.
    """
    rows = [numbers_from("start", start), numbers_from("goal", goal)]
    for name, row in zip(("start", "goal"), rows, strict=True):
        if row.shape != (3,) or not np.isfinite(row).all():
            raise GeometryError(f"the {name} is {row}; give x, y, z [m]")
    return np.array(rows)


def checked_required(required: float) -> float:
    """A distance to be kept [m].

    Raises:
        GeometryError: It is something else.
    """
    number = number_from("required", required)
    if not 0.0 <= number < math.inf:
        raise GeometryError(f"required is {required}; give 0 m or more")
    return number


def checked_norm(norm: Norm) -> Floats:
    """Speeds for kernels, (3,); see ``kernels.space.routing.travel_norm``.

    Raises:
        GeometryError: They are something else.
    """
    speeds = numbers_from("norm", norm)
    if speeds.shape != (3,) or not (
        (np.isfinite(speeds).all() and (speeds > 0.0).all()) or (speeds == 0.0).all()
    ):
        raise GeometryError(f"norm is {norm}; give three speeds above 0 m/s, or LENGTH")
    return np.array(speeds)
