"""What a lag of first order with a limit of its slope makes of commands."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import kernel


@kernel
def lagged_response(wanted: Floats, share: float, most: float, first: float) -> Floats:
    """What follows commands, step by step.

    Args:
        wanted: At even moments, shape (n,).
        share: Of what is missing, that comes within a step.
        most: The greatest change in a step.
        first: What it is at first.

    Returns:
        At the same moments, shape (n,).
    """
    found = np.empty(len(wanted))
    now = first
    for k in range(len(wanted)):
        found[k] = now
        now += min(max((wanted[k] - now) * share, -most), most)
    return found
