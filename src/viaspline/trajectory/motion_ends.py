"""How motions with a limit of the jerk begin and end, and what is asked of them on every stretch.

Tested through ``trajectory/test_jerk``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from viaspline.kernels.arrays import Floats

INTERIOR_SHARE = 0.998
"""Part of the limits that is planned with."""


class Rest(NamedTuple):
    """The motion begins or ends at rest, with a stretch of constant jerk beside it."""


class Moving(NamedTuple):
    """The motion begins at a speed.

    Attributes:
        square: v² [m²/s²], above 0.
        accel: [m/s²].
    """

    square: float
    accel: float


class Even(NamedTuple):
    """The motion ends at any speed, without acceleration."""


class Seam(NamedTuple):
    """The motion goes on at its start where it ends."""


@dataclass(frozen=True)
class Rows:
    """Limits p · (a0, a1, w0, m, w1) <= g of each stretch: its ends and its middle coefficient.

    Attributes:
        weights: Shape (n, k, 5).
        limits: Shape (n, k), above 0.
    """

    weights: Floats
    limits: Floats

    def spared(self) -> Rows:
        """The rows with a little less, so that a robot that is re-planned under way has room."""
        return Rows(self.weights, self.limits * INTERIOR_SHARE)
