"""Time laws from rest to rest, one behind the other along a path.

Tested through ``fleet/patrols/test_driven_laps``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.trajectory.trajectory import Trajectory

SAME_S = 1e-9
"""Times that are no farther apart are one."""


def set_out(law: Trajectory) -> Trajectory:
    """A time law without what it waits at its start."""
    waits = int(law.distances.searchsorted(law.distances[0], side="right")) - 1
    pieces = slice(waits, None)
    return replace(
        law,
        distances=law.distances[waits:],
        speeds=law.speeds[waits:],
        times=law.times[waits:],
        accelerations=law.accelerations[pieces],
        changes=None if law.changes is None else law.changes[pieces],
        jerks=None if law.jerks is None else law.jerks[pieces],
    )


def repeated_law(law: Trajectory, seams: Floats, period: float) -> Trajectory:
    """A time law from rest to rest, driven again every period.

    Args:
        law: It begins at 0 m when its robot sets out, and takes no longer than the period.
        seams: Where the rounds begin and end [m], (n + 1,).
        period: [s].

    Raises:
        GeometryError: The law takes longer.

    Example:
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.curve.path import Path
        >>> from viaspline.trajectory.retime import retime
        >>> line = Path([[[0, 0], [3, 0], [6, 0], [9, 0]]], vias=[])
        >>> law = retime(line, Limits(max_speed=1, max_accel=1))
        >>> twice = repeated_law(law, np.array([0.0, 9.0, 18.0]), 15.0)
        >>> twice.time_at([4.5, 13.5]).tolist()
        [5.0, 20.0]
    """
    if law.duration > period + SAME_S:
        raise GeometryError(
            f"a lap of {law.duration:g} s doesn't fit a period of {period:g} s; give a longer one"
        )
    return laws_in_a_row([_moved(law, k, seams, period) for k in range(len(seams) - 1)])


def laws_in_a_row(parts: Sequence[Trajectory]) -> Trajectory:
    """Time laws from rest to rest behind each other, with a halt where one begins later.

    Args:
        parts: Each begins where the one before ends, and no sooner.

    Example:
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.curve.path import Path
        >>> from viaspline.trajectory.retime import retime
        >>> line = Path([[[0, 0], [3, 0], [6, 0], [9, 0]]], vias=[])
        >>> law = retime(line, Limits(max_speed=1, max_accel=1))
        >>> both = laws_in_a_row([law, law.moved(9.0).delayed(15.0)])
        >>> both.time_at([4.5, 13.5]).tolist()
        [5.0, 20.0]
    """
    waits = [later.start_time > before.end_time + SAME_S for before, later in pairwise(parts)]
    firsts = [0, *(0 if wait else 1 for wait in waits)]

    def points(key: str) -> Floats:
        return np.concatenate(
            [getattr(part, key)[first:] for part, first in zip(parts, firsts, strict=True)]
        )

    def pieces(key: str) -> Floats | None:
        if all(getattr(part, key) is None for part in parts):
            return None
        rows = []
        for k, (part, first) in enumerate(zip(parts, firsts, strict=True)):
            values = getattr(part, key)
            values = np.zeros(len(part.times) - 1) if values is None else values
            rows.append(np.concatenate(([0.0] if k > 0 and first == 0 else [], values)))
        return np.concatenate(rows)

    accelerations = pieces("accelerations")
    assert accelerations is not None
    return replace(
        parts[0],
        distances=points("distances"),
        speeds=points("speeds"),
        times=points("times"),
        accelerations=accelerations,
        changes=pieces("changes"),
        jerks=pieces("jerks"),
        stations=tuple(stop for part in parts for stop in part.stations),
    )


def _moved(law: Trajectory, k: int, seams: Floats, period: float) -> Trajectory:
    """A law by k rounds later; it ends where the next round begins, to the bit."""
    return ends_at(law.moved(float(seams[k])).delayed(k * period), float(seams[k + 1]))


def ends_at(law: Trajectory, end: float) -> Trajectory:
    """A law that ends at a place that it ends at but for rounding [m]."""
    is_end = law.distances == law.distances[-1]
    return replace(law, distances=np.where(is_end, end, np.minimum(law.distances, end)))
