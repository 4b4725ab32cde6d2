"""What the motors of a thing that flies allow.

Tested through ``space/timing/test_retime_in_space``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.errors import GeometryError
from viaspline.handed_in import number_from
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.trajectory.limits import Limits


@told_in_lines
@dataclass(frozen=True, kw_only=True)
class SpatialLimits:
    """Limits of a drive in space. None: no limit of its own.

    Attributes:
        along: Along the path: speed, acceleration, braking, across the path, jerk. Its largest
            speed holds in every direction.
        climb: Largest speed upward [m/s].
        descent: Largest speed downward [m/s].
        vertical_accel: Largest acceleration up or down [m/s²].
        yaw_rate: Largest rate at which the body turns about the vertical [rad/s].

    Raises:
        GeometryError: When a limit is not a finite number above 0.

    Example:
        >>> SpatialLimits(along=Limits(max_speed=10, max_accel=2), climb=2.5).descent is None
        True
    """

    along: Limits
    climb: float | None = None
    descent: float | None = None
    vertical_accel: float | None = None
    yaw_rate: float | None = None

    def __post_init__(self) -> None:
        for name in ("climb", "descent", "vertical_accel", "yaw_rate"):
            value = getattr(self, name)
            if value is None:
                continue
            number = number_from(name, value)
            if not 0.0 < number < math.inf:
                raise GeometryError(f"{name} is {value}; give a finite number above 0")
            object.__setattr__(self, name, number)
