"""How sharply a part of a path bends; and what turns back, though its tangent never jumps."""

from __future__ import annotations

import math

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.curve.curvature_profile import VALUE, curvature_profile

HAIRPIN_1PM = 1e3
"""What bends more sharply is driven as a stop and a turn, which a driving time that is reckoned in
steps doesn't see [1/m]."""


def sharpest_bend(path: PiecewiseCubic, u: float, end: float) -> float:
    """The largest curvature on a part of a path, without its sign [1/m].

    Args:
        path: The path.
        u: Where the part begins; of its span all counts.
        end: Where it ends.

    Example:
        >>> from viaspline.curve.cardinal import CardinalSpline
        >>> back, wide = (CardinalSpline([(0, 0), (10, 0), (4, y)]) for y in (0.01, 4.0))
        >>> [sharpest_bend(path, 0.0, 2.0) > HAIRPIN_1PM for path in (back, wide)]
        [True, False]
    """
    spans = path.spans[math.floor(u) : math.ceil(end)]
    return float(np.abs(curvature_profile(spans)[:, VALUE]).max(initial=0.0))
