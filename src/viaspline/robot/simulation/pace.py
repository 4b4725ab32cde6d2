"""How much of the world's time passes while a robot thinks.

Tested through ``robot/simulation/test_exact_drive``.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from viaspline.errors import GeometryError
from viaspline.handed_in import LONGEST_S, finite_from
from viaspline.robot.navigator import Navigator

Pace = Callable[[Navigator], float]
"""How long what a navigator did in its last step keeps the robot from looking again [s]."""


def by_work(nav: Navigator) -> float:
    """The work of its search, in seconds of a reference machine: the same on every machine."""
    return nav.work


def by_clock(nav: Navigator) -> float:
    """What its search took by the clock on the wall: a run of its own on every machine."""
    return math.fsum(nav.compute_times)


def seconds_from(pace: Pace, nav: Navigator) -> float:
    """How long a navigator's last step keeps its robot from looking again [s].

    Raises:
        GeometryError: What was handed in as ``pace`` tells no time.

    """
    told = "what pace tells of a navigator"
    seconds = finite_from(told, pace(nav))
    if not 0.0 <= seconds <= LONGEST_S:
        raise GeometryError(f"{told} is {seconds}; give 0 s to {LONGEST_S:g} s")
    return seconds


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
