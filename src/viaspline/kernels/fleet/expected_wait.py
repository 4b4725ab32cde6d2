"""How long one of two robots has to wait for the other one where their paths cross, in the mean.

If both come as foreseen, the one waits that waits less. But both may have waited for others before,
so that they come sooner or later to each other than that: the mean over such differences is small
where they just about pass each other, and great where both drive along one stretch for long.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.jit import inlined, kernel

FAR = 5.0
"""Beyond so many spreads a normal variable doesn't come."""


@inlined
def _mean_above(mean: float, spread: float) -> float:
    """The mean of what a normal variable is above 0."""
    z = mean / spread
    if z > FAR:
        return mean
    if z < -FAR:
        return 0.0
    share = 0.5 * (1.0 + math.erf(z * math.sqrt(0.5)))
    return mean * share + spread * math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi)


@kernel
def expected_wait(late: float, other_late: float, spread: float) -> float:
    """The mean of the lesser wait [s].

    Args:
        late: How much too early the one comes for letting the other one pass first [s]; infinite
            where it can't.
        other_late: The same of the other one [s].
        spread: Standard deviation of what the one comes later or sooner than the other one, against
            what is foreseen [s].
    """
    if late + other_late <= 0.0:
        return 0.0
    if late == np.inf:
        return 0.0 if other_late == np.inf else _mean_above(other_late, spread)
    if other_late == np.inf:
        return _mean_above(late, spread)
    # a tent over the difference: up from -late to the middle, and down to other_late
    return (
        _mean_above(late, spread)
        - 2.0 * _mean_above(0.5 * (late - other_late), spread)
        + _mean_above(-other_late, spread)
    )
