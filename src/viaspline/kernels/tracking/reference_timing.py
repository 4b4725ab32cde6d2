"""A time law as it is followed: where a robot should be, and between which rests.

Tested through ``machine/test_trial_drive``.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.arclength import panel_of
from viaspline.kernels.jit import inner
from viaspline.kernels.tracking.drive_model import clip


class SpeedProfile(NamedTuple):
    """A time law: the acceleration is constant from each point to the next."""

    distance: Floats
    speed: Floats
    time: Floats
    acceleration: Floats


@inner
def profile_at(profile: SpeedProfile, time: float) -> tuple[float, float, float]:
    """Distance, speed and acceleration at a time; at rest before the law begins and after it."""
    n = profile.time.shape[0]
    if time < profile.time[0]:
        return profile.distance[0], profile.speed[0], 0.0
    if time >= profile.time[n - 1]:
        return profile.distance[n - 1], profile.speed[n - 1], 0.0
    i = panel_of(profile.time, time)
    late, a = time - profile.time[i], profile.acceleration[i]
    distance = profile.distance[i] + (profile.speed[i] + 0.5 * a * late) * late
    speed = max(profile.speed[i] + a * late, 0.0)
    return clip(distance, profile.distance[i], profile.distance[i + 1]), speed, a


@inner
def ends_at(profile: SpeedProfile, time: float) -> tuple[float, float, bool]:
    """The rests before and after a time [m], between which the robot is on its way.

    The law may begin under way; then the first is its beginning, and the last value is false.
    """
    n = profile.time.shape[0]
    i = panel_of(profile.time, time)
    first = i
    while first > 0 and profile.speed[first] > 0.0:
        first -= 1
    last = i + 1
    while last < n - 1 and (profile.speed[last] > 0.0 or profile.time[last] <= time):
        last += 1
    return profile.distance[first], profile.distance[last], profile.speed[first] <= 0.0
