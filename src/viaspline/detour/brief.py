"""What every path has to keep, whoever asks for it."""

from __future__ import annotations

from dataclasses import dataclass, field

from viaspline.mission.model import Mission, SplineSpec


@dataclass(frozen=True, kw_only=True)
class Brief:
    """The robot's needs and the curve's shape.

    Attributes:
        radius: The robot's body [m].
        clearance: Free space kept between the body and every obstacle [m].
        spline: Tension, knots and tangents.
    """

    radius: float
    clearance: float
    spline: SplineSpec = field(default_factory=SplineSpec)

    @property
    def required(self) -> float:
        """Distance that the path itself keeps from every obstacle [m]."""
        return self.radius + self.clearance

    @classmethod
    def of(cls, mission: Mission) -> Brief:
        """The brief of a mission."""
        robot = mission.robot
        return cls(radius=robot.radius_m, clearance=robot.clearance_m, spline=mission.spline)
