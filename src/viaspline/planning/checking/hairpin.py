"""Where a path turns back on itself within next to nothing, though its tangent never jumps."""

from __future__ import annotations

import math

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.curve.curvature_profile import VALUE, curvature_profile

HAIRPIN_1PM = 1e3
"""What bends more sharply is driven as a stop and a turn, which a driving time that is reckoned in
steps doesn't see [1/m]."""


def has_hairpin(path: PiecewiseCubic, u: float, end: float) -> bool:
    """Whether a path turns back on itself within a millimetre somewhere on a part of it.

    Args:
        path: The path.
        u: Where the part begins; of its span all counts.
        end: Where it ends.

    Example:
        >>> from viaspline.curve.cardinal import CardinalSpline
        >>> back, wide = (CardinalSpline([(0, 0), (10, 0), (4, y)]) for y in (0.01, 4.0))
        >>> [has_hairpin(path, 0.0, 2.0) for path in (back, wide)]
        [True, False]
    """
    spans = path.spans[math.floor(u) : math.ceil(end)]
    return bool(np.abs(curvature_profile(spans)[:, VALUE]).max(initial=0.0) > HAIRPIN_1PM)
