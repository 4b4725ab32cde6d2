"""Heights for a curve that was laid on the ground.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats


def with_heights(spans: Floats, joints: NDArray[np.int64], heights: Floats) -> Floats:
    """Spans with further coordinates that run smoothly from via point to via point.

    Between via points they rise or fall without overshoot (Fritsch and Carlson's monotone cubics
    over the distance on the ground).

    Args:
        spans: On the ground [m], shape (m, 4, 2).
        joints: The span that begins at each via point, m at the end, shape (v,).
        heights: The other coordinates of each via point [m], shape (v, e).

    Returns:
        Shape (m, 4, 2 + e).
    """
    if heights.shape[1] == 0:
        return spans
    from scipy.interpolate import PchipInterpolator

    ground = PiecewiseCubic(spans)
    along = np.asarray(ground.distance(np.arange(len(spans) + 1.0)))
    rise = PchipInterpolator(along[joints], heights)
    at, slope = rise(along), rise(along, 1)
    first = np.linalg.norm(spans[:, 1] - spans[:, 0], axis=1)[:, None]
    last = np.linalg.norm(spans[:, 3] - spans[:, 2], axis=1)[:, None]
    rows = (at[:-1], at[:-1] + first * slope[:-1], at[1:] - last * slope[1:], at[1:])
    return np.concatenate((spans, np.stack(rows, axis=1)), axis=2)
