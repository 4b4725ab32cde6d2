"""An upright cylinder: what a robot takes up at a place, or on a straight way up."""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.shapes.solids import Place


@dataclass(frozen=True)
class SpatialSize:
    """The size of a robot in space, as a cylinder and what is kept about it.

    Attributes:
        radius: Of the cylinder [m]; 0 for a ball.
        half_height: Of the cylinder [m]; 0 for a ball.
        margin: What is kept free about the cylinder [m]; a ball's radius is part of it.
    """

    radius: float
    half_height: float
    margin: float

    @classmethod
    def of(cls, robot: RobotSpec) -> SpatialSize:
        """That of a robot with its clearance.

        >>> SpatialSize.of(RobotSpec(radius_m=0.5, clearance_m=1))
        SpatialSize(radius=0.0, half_height=0.0, margin=1.5)
        """
        if robot.half_height_m is None:
            return cls(0.0, 0.0, robot.inner_radius + robot.clearance_m)
        return cls(robot.inner_radius, robot.half_height_m, robot.clearance_m)

    @property
    def upwards(self) -> float:
        """How far above a roof the reference point is at least [m]."""
        return self.half_height + self.margin

    def at(self, place: Place, top: float | None = None) -> UprightBody:
        """The cylinder at a place, or all that it passes on its way up to a height.

        Args:
            place: x, y, z of the reference point [m].
            top: z of the reference point at the end of the way [m].
        """
        x, y, z = place
        high = z if top is None else max(z, top)
        return UprightBody(x, y, z - self.half_height, high + self.half_height, self.radius)


@dataclass(frozen=True)
class UprightBody:
    """An upright cylinder.

    Attributes:
        x: Its middle [m].
        y: Its middle [m].
        low: Height of its bottom [m].
        high: Height of its top [m].
        radius: Its radius [m].
    """

    x: float
    y: float
    low: float
    high: float
    radius: float

    def gap(self, low: float, high: float) -> float:
        """The height between it and what lies between two heights [m]; less than 0: they meet.

        >>> UprightBody(0, 0, 1, 3, 1).gap(5, 9), UprightBody(0, 0, 1, 3, 1).gap(2, 9)
        (2, -1)
        """
        return max(low - self.high, self.low - high)
