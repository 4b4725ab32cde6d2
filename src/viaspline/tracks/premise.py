"""What was seen to do what nothing does by the mission, in words.

Tested through ``robot/yielding/test_broken_premises``.
"""

from __future__ import annotations

import math
from typing import Final

from viaspline.tracks.motion_estimate import MotionEstimate

SIGMAS: Final = 3.0
"""Something is too fast if it is even with an error of so many standard deviations."""


def is_faster(estimate: MotionEstimate, top: float, noise: float = 0.0) -> bool:
    """Whether something goes faster than the mission says that anything does.

    Args:
        estimate: Of its motion.
        top: What the mission says [m/s].
        noise: Standard deviation of each coordinate of a velocity that is told [m/s].
    """
    speed = math.hypot(*estimate.velocity.tolist())
    return speed - SIGMAS * max(estimate.velocity_error, noise) > top


def too_fast_words(name: str, estimate: MotionEstimate, top: float) -> str:
    """That it does."""
    speed = math.hypot(*estimate.velocity.tolist())
    return f"the premise is broken: '{name}' goes {speed:.2f} m/s, and not {top:g} at most"


def jumped_words(name: str) -> str:
    """That something was elsewhere in the look before."""
    return f"the premise is broken: '{name}' jumped"
