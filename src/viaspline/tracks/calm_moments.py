"""Moments of a drive: close together, and few where the robot stands and nothing comes near.

Tested through ``robot/simulation/test_standstills``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from viaspline.kernels.arrays import Floats, Ints

CALM_STEP_S = 60.0
"""From one moment to the next where it is calm, at least [s];"""

CALM_MOMENTS = 1000
"""and where it is for long it has no more of them than this."""

Stretches: TypeAlias = Sequence[tuple[float, float]]
"""Times from and until [s], in order, apart from each other."""


def kept_moments(count: int, spacing: float, calm: Stretches) -> Ints:
    """Which of moments at even distances are kept, in order.

    Args:
        count: The number of the last one; the first one, 0, is at time 0.
        spacing: From one to the next [s].
        calm: Where few do.

    >>> kept_moments(200, 1.0, [(2.0, 198.0)]).tolist()
    [0, 1, 2, 62, 122, 182, 198, 199, 200]
    """
    parts, first = [], 0
    for begin, end in calm:
        enters = min(max(math.ceil(begin / spacing), first), count)
        leaves = min(math.floor(end / spacing), count)
        if leaves <= enters:
            continue
        stride = math.ceil(max(CALM_STEP_S, (end - begin) / CALM_MOMENTS) / spacing)
        parts += [np.arange(first, enters), np.arange(enters, leaves, stride)]
        first = leaves
    return np.concatenate((*parts, np.arange(first, count + 1))).astype(np.int64)


def spread_moments(begin: float, end: float, count: int, calm: Stretches) -> Floats:
    """Moments from begin to end, ``count`` steps of one length but where it is calm [s].

    They are those of ``np.linspace`` where it is never calm.
    """
    spacing = (end - begin) / count
    shifted = [(since - begin, until - begin) for since, until in calm] if spacing > 0.0 else ()
    moments = np.asarray(kept_moments(count, spacing, shifted) * spacing + begin, np.float64)
    moments[-1] = end
    return moments
