"""What a drive's actuators can do, in numbers: all that kernels know of it. It imports no numba.

Tested through ``kernels/tracking/test_drive_model``.
"""

from __future__ import annotations

import math
from typing import NamedTuple


class Actuators(NamedTuple):
    """The actuators of a drive; the defaults are those of one that moves as it is commanded.

    A drive that steers turns by an angle δ of its wheels, with the yaw rate v tan(δ) / wheelbase;
    all others turn by a yaw rate. Where there are wheels on two sides the faster of them runs at
    |v| + |ω| track / (2 grip).

    Attributes:
        wheelbase: From the driven to the steered axle [m]; 0 where nothing steers.
        max_steer: Greatest steering angle [rad].
        max_steer_rate: Greatest change of it per second [rad/s].
        track: Distance between the wheels of two sides [m]; 0 where there are none.
        grip: Part of the yaw rate that is left after slipping.
        max_wheel_speed: Greatest speed of a wheel [m/s].
        max_along: Greatest speed along the body, where it can move across too [m/s].
        max_across: Greatest speed across the body [m/s]; 0 where it can't.
        held_heading: Heading that the body keeps wherever it goes [rad]; nan where it looks the
            way that it goes.

    Example:
        >>> Actuators(track=0.5, max_wheel_speed=1.0).wheelbase
        0.0
    """

    wheelbase: float = 0.0
    max_steer: float = math.inf
    max_steer_rate: float = math.inf
    track: float = 0.0
    grip: float = 1.0
    max_wheel_speed: float = math.inf
    max_along: float = math.inf
    max_across: float = 0.0
    held_heading: float = math.nan
