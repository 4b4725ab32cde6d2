"""How much of the world's time passes while a robot thinks.

Tested through ``robot/simulation/test_exact_drive``.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from viaspline.robot.navigator import Navigator

Pace = Callable[[Navigator], float]
"""How long what a navigator did in its last step keeps the robot from looking again [s]."""


def by_work(nav: Navigator) -> float:
    """The work of its search, in seconds of a reference machine: the same on every machine."""
    return nav.work


def by_clock(nav: Navigator) -> float:
    """What its search took by the clock on the wall: a run of its own on every machine."""
    return math.fsum(nav.compute_times)


def steps_taken(seconds: float, step: float) -> int:
    """From one look of a robot to its next, in steps.

    It doesn't look while it searches for a new path, and goes on as it had meant to.

    Args:
        seconds: How long it searched.
        step: From one look to the next where there is nothing to think about [s].

    >>> steps_taken(0.0, 0.05), steps_taken(0.04, 0.05), steps_taken(0.06, 0.05)
    (1, 1, 2)
    """
    return max(math.ceil(seconds / step), 1)
