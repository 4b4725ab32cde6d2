"""How far turns swing out.

Tested through ``planning/turning/test_local_detours``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats


def swing_share(turns: Floats) -> Floats:
    """How far turns swing out from where their lines meet, over their radius, (n,).

    With ramps as long as the radius, turns by less than 1 rad are ramps alone.

    Args:
        turns: By how much they turn [rad], (n,).
    """
    theta = np.abs(turns)
    with_arc = 1.0 - np.cos(0.5 * theta) + 1.0 / 24.0
    found: Floats = np.where(theta < 1.0, theta / 6.0, with_arc)
    return found
