"""Where a time law of constant accelerations is at given times.

Tested through ``trajectory/test_retime``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.arclength import panel_of
from viaspline.kernels.jit import kernel


@kernel
def law_states(
    times: Floats, distances: Floats, speeds: Floats, accelerations: Floats, at: Floats
) -> Floats:
    """Distance, speed and acceleration at any times.

    Before its start and from its end on the law stays as it is there, without acceleration.

    Args:
        times: Of the law's points [s], not decreasing, (n,).
        distances: There, not decreasing [m], (n,).
        speeds: There [m/s], (n,).
        accelerations: From each point to the next [m/s²], (n - 1,).
        at: When [s], (m,).

    Returns:
        In rows: [m], [m/s], [m/s²], (3, m); distance and speed are never beyond those of the
        points about, whatever the rounding says.
    """
    found = np.empty((3, at.size))
    for k in range(at.size):
        t = min(max(at[k], times[0]), times[-1])
        i = panel_of(times, t)
        late = t - times[i]
        first, second, acceleration = speeds[i], speeds[i + 1], accelerations[i]
        distance = distances[i] + (first + 0.5 * acceleration * late) * late
        found[0, k] = min(max(distance, distances[i]), distances[i + 1])
        speed = min(max(first + acceleration * late, min(first, second)), max(first, second))
        is_over = t >= times[-1]
        found[1, k] = speeds[-1] if is_over else speed
        found[2, k] = acceleration if t == at[k] and not is_over else 0.0
    return found
