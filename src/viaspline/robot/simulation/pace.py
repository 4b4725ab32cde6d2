"""How much of the world's time passes while a robot thinks.

Tested through ``robot/simulation/test_exact_drive``.
"""

from __future__ import annotations

import math


def steps_taken(work: float, step: float) -> int:
    """From one look of a robot to its next, in steps.

    It doesn't look while it searches for a new path, and goes on as it had meant to.

    Args:
        work: What it has spent on that [s of the reference machine], taken for seconds.
        step: From one look to the next where there is nothing to think about [s].

    >>> steps_taken(0.0, 0.05), steps_taken(0.04, 0.05), steps_taken(0.06, 0.05)
    (1, 1, 2)
    """
    return max(math.ceil(work / step), 1)
