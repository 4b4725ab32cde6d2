"""A time law as it is followed: where a robot should be, and between which rests."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.curve.arclength import panel_of
from viaspline.kernels.jit import inner
from viaspline.kernels.tracking.drive_model import clip

Floats = NDArray[np.float64]


class Law(NamedTuple):
    """A time law: the acceleration is constant from each point to the next."""

    distance: Floats
    speed: Floats
    time: Floats
    acceleration: Floats


@inner
def law_at(law: Law, time: float) -> tuple[float, float, float]:
    """Distance, speed and acceleration at a time; at rest before the law begins and after it."""
    n = law.time.shape[0]
    if time < law.time[0]:
        return law.distance[0], law.speed[0], 0.0
    if time >= law.time[n - 1]:
        return law.distance[n - 1], law.speed[n - 1], 0.0
    i = panel_of(law.time, time)
    late, a = time - law.time[i], law.acceleration[i]
    distance = law.distance[i] + (law.speed[i] + 0.5 * a * late) * late
    speed = max(law.speed[i] + a * late, 0.0)
    return clip(distance, law.distance[i], law.distance[i + 1]), speed, a


@inner
def ends_at(law: Law, time: float) -> tuple[float, float, bool]:
    """The rests before and after a time [m], between which the robot is on its way.

    The law may begin under way; then the first is its beginning, and the last value is false.
    """
    n = law.time.shape[0]
    i = panel_of(law.time, time)
    first = i
    while first > 0 and law.speed[first] > 0.0:
        first -= 1
    last = i + 1
    while last < n - 1 and (law.speed[last] > 0.0 or law.time[last] <= time):
        last += 1
    return law.distance[first], law.distance[last], law.speed[first] <= 0.0
