"""The body of a robot in space, and how much free space there is between two of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec


@dataclass(frozen=True)
class FlyingBody:
    """An upright cylinder about the reference point, with a margin that is rounded about it.

    Attributes:
        radius: Of the cylinder [m]; 0 for a ball.
        half_height: Of the cylinder [m]; 0 for a ball.
        margin: What it takes up beyond the cylinder [m]: a ball's radius, and how far the robot
            gets beside its path.
    """

    radius: float
    half_height: float
    margin: float

    @classmethod
    def of(cls, robot: RobotSpec) -> FlyingBody:
        """That of a robot.

        >>> FlyingBody.of(RobotSpec(radius_m=0.5)), FlyingBody.of(
        ...     RobotSpec(radius_m=0.5, half_height_m=0.2, tracking_error_m=0.1))
        (FlyingBody(radius=0.0, half_height=0.0, margin=0.5),
         FlyingBody(radius=0.5, half_height=0.2, margin=0.1))
        """
        error = robot.tracking_error_m or 0.0
        if robot.half_height_m is None:
            return cls(0.0, 0.0, robot.radius_m + error)
        return cls(robot.radius_m, robot.half_height_m, error)

    @property
    def outermost(self) -> float:
        """The radius of a ball about the reference point that holds the body [m]."""
        return float(np.hypot(self.radius, self.half_height)) + self.margin

    @property
    def beside(self) -> float:
        """How far from its reference point it reaches, seen from above [m]."""
        return self.radius + self.margin

    def gaps(self, other: FlyingBody, offsets: Floats) -> Floats:
        """Free space between it and another body [m]; less than 0 where they overlap.

        Args:
            other: The other body.
            offsets: From the one's reference point to the other's [m], (n, 3).

        Returns:
            (n,). Where both cylinders meet, it is less the sum of both margins.

        >>> flat = FlyingBody(0.5, 0.2, 0.0)
        >>> flat.gaps(flat, np.array([[4.0, 0, 0], [0, 0, 3.4], [0, 4, 4.4]])).tolist()
        [3.0, 3.0, 5.0]
        """
        radius, half = self.radius + other.radius, self.half_height + other.half_height
        level = np.maximum(np.hypot(offsets[:, 0], offsets[:, 1]) - radius, 0.0)
        upright = np.maximum(np.abs(offsets[:, 2]) - half, 0.0)
        return np.asarray(np.hypot(level, upright) - self.margin - other.margin)
