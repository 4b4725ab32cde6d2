"""What the robot's motors and its stations ask of the time law."""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.errors import GeometryError


@dataclass(frozen=True, kw_only=True)
class Limits:
    """Limits along a path.

    Attributes:
        max_speed: [m/s], more than 0.
        max_accel: Along the path, speeding up and braking [m/s²], more than 0.
        max_lateral_accel: Across the path, v² times curvature [m/s²]; None: no limit.
    """

    max_speed: float
    max_accel: float
    max_lateral_accel: float | None = None

    def __post_init__(self) -> None:
        for name in ("max_speed", "max_accel", "max_lateral_accel"):
            value = getattr(self, name)
            if value is not None and not 0 < value < float("inf"):
                raise GeometryError(f"{name} is {value}; give a finite number above 0")


@dataclass(frozen=True)
class Station:
    """A stop on the path: where [m along the path], how long [s], and its name."""

    distance: float
    dwell: float
    name: str = ""
