"""When a driven robot was farther beside its path than was kept for that."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.machine.tracking import Tracking

ROUNDING_M = 1e-9
"""What is farther by less is not [m]."""


@dataclass(frozen=True)
class Excess:
    """A time in which a robot was farther beside its path than was kept.

    Attributes:
        since: When it began [s].
        until: When it was over [s].
        worst_at: When the robot was farthest beside its path [s].
        distance: How far along the path that was [m].
        off: How far any point of the body was beside then [m].
        kept: What was kept [m].
    """

    since: float
    until: float
    worst_at: float
    distance: float
    off: float
    kept: float


def excesses(tracking: Tracking, kept: float, reach: float) -> tuple[Excess, ...]:
    """All the times in which a robot was farther beside its path than was kept, in order.

    Args:
        tracking: What it was off.
        kept: For that [m].
        reach: Distance of the body's farthest corner if it is a polygon; 0 for a disc [m].

    Example:
        >>> off = np.array([0.0, 0.02, 0.03, 0.0, 0.05])
        >>> errors = Tracking(np.arange(5.0), np.arange(5.0), off, 0 * off, 0 * off, off >= 0.0)
        >>> [(one.since, one.until, one.off) for one in excesses(errors, 0.01, 0.0)]
        [(1.0, 2.0, 0.03), (4.0, 4.0, 0.05)]
    """
    off = tracking.body_deviations(reach)
    beyond = np.concatenate(([False], off > kept + ROUNDING_M, [False]))
    edges = np.flatnonzero(np.diff(beyond.astype(np.int8))).reshape(-1, 2)
    found = []
    for first, after in edges.tolist():
        worst = first + int(off[first:after].argmax())
        since, until, when = tracking.times[[first, after - 1, worst]].tolist()
        along, most = float(tracking.progress[worst]), float(off[worst])
        found.append(Excess(since, until, when, along, most, kept))
    return tuple(found)
