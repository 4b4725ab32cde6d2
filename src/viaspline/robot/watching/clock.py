"""A clock that runs backwards: no law of time holds by it, so the robot stands until it is past.

Tested through ``robot/watching/test_fresh_inputs``.
"""

from __future__ import annotations

import math
from dataclasses import replace

from viaspline.robot.run import Event
from viaspline.robot.watching.watch import Watch

TIME_ROUNDING = 1e-12
"""Part of a time by which one that is not before it may look earlier."""


def runs_backwards(watch: Watch, time: float) -> bool:
    """Whether a time is before that of the last step.

    >>> runs_backwards(Watch(time=5.0), 4.9), runs_backwards(Watch(), 0.0)
    (True, False)
    """
    last = watch.time
    return math.isfinite(last) and time < last - TIME_ROUNDING * (1.0 + abs(last))


def told_of_clock(
    watch: Watch, where: tuple[float, ...], time: float
) -> tuple[Watch, tuple[Event, ...]]:
    """A watch that is held still by a clock that runs backwards, and the event the first time.

    Args:
        watch: Of the last step.
        where: The robot is [m], shape (d,).
        time: What the clock says [s].
    """
    if watch.held == "clock":
        return watch, ()
    back = watch.time - time
    words = (
        f"stops: the clock runs backwards, by {back:.3g} s; it goes on after {watch.time:g} s, and "
        "a clock that was set anew needs a new Navigator"
    )
    data = {"last_s": watch.time, "now_s": time, "back_s": back}
    event = Event("clock", watch.time, where, words, data)
    return replace(watch, held="clock"), (event,)
