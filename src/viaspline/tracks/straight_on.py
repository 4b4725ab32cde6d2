"""For how long something that moves is taken to go straight on, and how far from there it may be.

No longer than it is known at all where it will be: a thing that was just seen for the first time
might be anywhere soon, and one look later much less so.

Tested through ``robot/yielding/test_foreseen``.
"""

from __future__ import annotations

from viaspline.mission.motion_spec import MotionError
from viaspline.tracks.motion_estimate import MotionEstimate

HORIZON_S = 8.0
"""So far ahead it is taken to go straight on [s]."""

LEAST_HORIZON_S = 1.0
"""It is so for so long at least [s]:"""

WIDEST_M = 1.5
"""else until it may be so far from there [m]."""

SIGMAS = 1.0
"""Standard deviations by which it may be elsewhere, or faster. With two, a robot that a lidar shows
things to was led round half of the traffic, which took twice as long."""


def straight_on(estimate: MotionEstimate) -> tuple[MotionError, float]:
    """How far from its straight line something may be, and for how long that is reckoned with.

    Args:
        estimate: Its motion now.

    Returns:
        (the error, the time [s]).
    """
    error = MotionError(
        position_m=SIGMAS * estimate.place_error, growth_mps=SIGMAS * estimate.velocity_error
    )
    return error, _horizon(error)


def _horizon(error: MotionError) -> float:
    """How long something is taken to go straight on [s].

    >>> _horizon(MotionError(position_m=0.1, growth_mps=0.7))
    2.0
    """
    spare = WIDEST_M - error.position_m
    if spare >= HORIZON_S * error.growth_mps:
        return HORIZON_S
    return max(spare / error.growth_mps, LEAST_HORIZON_S)
