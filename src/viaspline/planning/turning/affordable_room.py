"""How wide turns are only because there is room, for a part of the length at most.

A corner is hardly longer with a wider turn. Who turns back drives more than a metre more for every
metre of radius.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats

LEAST_LONGER = 1e-12  # than round its corner, over its radius: a turn by nothing costs nothing


def affordable_radii(turns: Floats, radii: Floats, soonest: Floats, spent: float) -> Floats:
    r"""The radii up to which turns may be widened, if all together are to be little longer.

    A turn by :math:`\theta` with the radius R is :math:`R (\theta - 2 \sin(\theta / 2))` longer
    than lines through its apex. Those that would take more than an even share of what may be spent
    share it among them.

    Args:
        turns: None negative [rad], (n,).
        radii: To which they would be widened [m], (n,).
        soonest: Those with which they are driven soonest [m], (n,).
        spent: By how much the path may be longer than with the soonest [m].

    Returns:
        [m], (n,), none less than the soonest.

    Example:
        >>> affordable_radii(np.array([0.5, np.pi]), np.full(2, 3.0), np.ones(2), 0.1).round(2)
        array([20.26,  1.09])
    """
    per = np.maximum(turns - 2.0 * np.sin(0.5 * turns), LEAST_LONGER)
    longer = per * np.maximum(radii - soonest, 0.0)
    sharing = max(int((longer * len(turns) > spent).sum()), 1)
    found: Floats = soonest + spent / (sharing * per)
    return found
