"""What every path has to keep, whoever asks for it."""

from __future__ import annotations

from dataclasses import dataclass, field

from viaspline.mission.model import Mission
from viaspline.mission.parts import SplineSpec

LEAST = 1e-5  # what even a point without clearance keeps, so that touching is not crossing [m]


@dataclass(frozen=True, kw_only=True)
class Brief:
    """The robot's needs and the curve's shape.

    Attributes:
        radius: The robot's body [m].
        clearance: Free space kept between the body and every obstacle [m].
        spline: Tension, knots and tangents.
        goal_heading_deg: Heading with which the path arrives at the goal [deg]; None if it is free.
    """

    radius: float
    clearance: float
    spline: SplineSpec = field(default_factory=SplineSpec)
    goal_heading_deg: float | None = None

    @property
    def required(self) -> float:
        """Distance that the path itself keeps from every obstacle [m]."""
        return max(self.radius + self.clearance, LEAST)

    @classmethod
    def of(cls, mission: Mission) -> Brief:
        """The brief of a mission."""
        robot, goal = mission.robot, mission.route.goal
        return cls(
            radius=robot.inner_radius,
            clearance=robot.clearance_m,
            spline=mission.spline,
            goal_heading_deg=None if goal is None else goal.heading_deg,
        )
