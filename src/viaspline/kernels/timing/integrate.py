"""Speeds, times and accelerations of a v² that is linear between its points.

Tested through ``trajectory/test_retime``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import kernel


@kernel
def ride(
    distances: Floats,
    squares: Floats,
    stops: Floats,
    dwells: Floats,
    accel: float,
    start_time: float,
) -> tuple[Floats, Floats, Floats, Floats]:
    """The time law of a v²; where the robot stops it is twice, as it comes and as it goes.

    Args:
        distances: Increasing [m], shape (n,).
        squares: v² there [m²/s²], shape (n,).
        stops: Distances where it waits, among those above [m], not decreasing, shape (k,).
        dwells: How long [s], shape (k,).
        accel: For stretches with no speed at either end [m/s²].
        start_time: [s].

    Returns:
        Distances, speeds and times, shape (n + k,), and the accelerations between them.
    """
    n, k = distances.shape[0], stops.shape[0]
    line, speeds, times = np.empty(n + k), np.empty(n + k), np.empty(n + k)
    accelerations = np.empty(n + k - 1)
    total, count, j = 0.0, 0, 0
    for i in range(n):
        speed = np.sqrt(squares[i])
        if i > 0:
            width, both = distances[i] - distances[i - 1], speeds[count - 1] + speed
            spent = 2.0 * width / both if both > 0.0 else 2.0 * np.sqrt(width / accel)
            rise = speed - speeds[count - 1]
            accelerations[count - 1] = rise / spent if spent > 0.0 else 0.0
            total += spent
        line[count], speeds[count], times[count] = distances[i], speed, start_time + total
        count += 1
        while j < k and stops[j] <= distances[i]:
            total += dwells[j]
            accelerations[count - 1] = 0.0
            line[count], speeds[count], times[count] = distances[i], speed, start_time + total
            count += 1
            j += 1
    return line, speeds, times, accelerations
