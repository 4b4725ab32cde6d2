"""Something whose place and velocity are told again and again, followed from look to look.

Tested through ``robot/perception/moving/test_track_sightings``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

from viaspline.kernels.arrays import Floats
from viaspline.tracks.motion_estimate import MotionEstimate

WANDER: Final = 0.4
"""By how much a velocity changes in a second, in standard deviations, where nothing else is said
[m/s per square root of s]."""

PLACE_ERROR_M: Final = 1e-3
"""A place that is measured exactly, for a filter that divides by its error [m]."""

VELOCITY_ERROR_MPS: Final = 1e-3
"""A velocity that is [m/s]."""

JUMP_RATIO: Final = 2.0
"""What has gone so many times as far as it would by its speed now and before has jumped,"""

JUMP_SIGMAS: Final = 6.0
"""though the speeds may be wrong by so many standard deviations,"""

JUMP_M: Final = 0.1
"""and by no less than this [m]."""

STOOD_M: Final = 0.02
"""What has gone no farther than this stands [m],"""

STOOD_RAD: Final = 0.02
"""if it has turned no more than this either [rad];"""

STOOD_S: Final = 2.0
"""it is taken to stay when it has stood for so long [s]."""


@dataclass(frozen=True)
class Standstill:
    """Since when something has been where it is.

    Attributes:
        since: [s].
        place: Where that is [m].
        heading: Which way it faces there [rad]; 0 where that doesn't matter.
    """

    since: float
    place: tuple[float, ...]
    heading: float = 0.0

    def going_on(self, place: tuple[float, ...], heading: float, time: float) -> Standstill:
        """It after one more look, at a time [s]: the old one if the thing is still there."""
        near = math.dist(place, self.place) <= STOOD_M
        is_there = near and abs(heading - self.heading) <= STOOD_RAD
        return self if is_there else Standstill(time, place, heading)

    def stays(self, time: float) -> bool:
        """Whether it has stood for so long by a time [s] that it is taken to stay."""
        return time - self.since >= STOOD_S


def followed(
    before: MotionEstimate | None, measured: Floats, time: float, velocity_noise: float,
    wander: float,
) -> tuple[MotionEstimate, bool]:  # fmt: skip
    """What is believed of something after one more look.

    Args:
        before: What was believed at the look before; None: it is new.
        measured: Its place [m] and velocity [m/s] now, shape (2d,).
        time: Of the look [s].
        velocity_noise: Standard deviation of each coordinate of a velocity that is told [m/s].
        wander: By how much its velocity changes in a second, in standard deviations
            [m/s per square root of s].

    Returns:
        (the estimate, whether it has jumped: it is followed anew since).
    """
    error = max(velocity_noise, VELOCITY_ERROR_MPS)
    jumped = before is not None and _has_jumped(before, measured, time, error)
    if before is None or jumped:
        return MotionEstimate.measured(time, measured, PLACE_ERROR_M, error), jumped
    foreseen = before.foreseen(time, wander)
    return foreseen.with_place_and_velocity(measured, PLACE_ERROR_M, error), False


def _has_jumped(before: MotionEstimate, measured: Floats, time: float, error: float) -> bool:
    """Whether something is farther from where it was than it can have gone.

    Args:
        before: What was believed of it at the look before.
        measured: Its place [m] and velocity [m/s] now, shape (2d,).
        time: [s].
        error: Standard deviation of a velocity [m/s].
    """
    gone = math.dist(measured[: before.dimension], before.place)
    speed = max(
        math.hypot(*measured[before.dimension :].tolist()), math.hypot(*before.velocity.tolist())
    )
    return gone > JUMP_RATIO * (speed + JUMP_SIGMAS * error) * (time - before.time) + JUMP_M
