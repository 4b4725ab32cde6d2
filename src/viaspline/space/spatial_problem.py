"""What is asked of a path in space, as the planner sees it.

Tested through ``space/test_solve_route``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.world_spec import SpeedZone
from viaspline.space.laying.laid_route import CurveShape
from viaspline.space.timing.spatial_limits import SpatialLimits
from viaspline.space.timing.yaw_profile import Facing, FacingAlong
from viaspline.world.space.spatial_world import SpatialWorld

SpatialObjective = Literal["time", "length"]


@dataclass(frozen=True, eq=False)
class SpatialVia:
    """A via point of a route in space.

    Attributes:
        name: What it is called.
        at: [m], shape (3,).
        index: Its place in the mission's route, 0 for the start; None for the top of a take-off or
            a landing.
        dwell: How long the robot hovers there [s]; None: it doesn't stop.
        direction: A unit vector along which it is passed, shape (3,); None: any.
        look_at: x, y of what the robot faces there [m]; None: nothing.
    """

    name: str
    at: Floats
    index: int | None
    dwell: float | None = None
    direction: Floats | None = None
    look_at: tuple[float, float] | None = None


@dataclass(frozen=True, eq=False)
class SpatialProblem:
    """What is asked.

    Attributes:
        world: What to keep clear of, and in which heights to stay.
        vias: Start, via points and goal, in order; the start once more at the end of a round.
        clearance: Free space between the body and everything [m].
        radius: Of the body, if it is a ball; 0 if it is the world's core [m].
        limits: Of speed, acceleration, climb and turn.
        shape: Of the spline.
        keeps_spline: Whether clear legs are the spline's: the mission says how taut it is to be.
        objective: By what the ways past an obstacle are chosen.
        facing: Which way the body faces.
        takeoff: Where the robot stands on the ground, upright below the first via point [m], (3,);
            None: it begins in the air.
        landing: Where it touches down, upright below the last one [m], (3,); None: it doesn't.
        laps: How often a round is flown.
        zones: Areas with a lower speed, at every height.
    """

    world: SpatialWorld
    vias: Sequence[SpatialVia]
    clearance: float
    radius: float
    limits: SpatialLimits
    shape: CurveShape
    keeps_spline: bool = False
    objective: SpatialObjective = "time"
    facing: Facing = field(default_factory=FacingAlong)
    takeoff: Floats | None = None
    landing: Floats | None = None
    laps: int = 1
    zones: tuple[SpeedZone, ...] = ()

    @property
    def places(self) -> Floats:
        """The via points [m], shape (n, 3)."""
        return np.array([via.at for via in self.vias], np.float64)

    @property
    def required(self) -> float:
        """Distance from everything that the reference point, or the core about it, keeps [m]."""
        return self.clearance + self.radius

    @property
    def is_round(self) -> bool:
        """Whether it ends where it begins."""
        return len(self.vias) > 2 and bool(np.array_equal(self.vias[0].at, self.vias[-1].at))
