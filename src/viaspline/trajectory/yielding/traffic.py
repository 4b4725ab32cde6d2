"""What moves beside a path, and what a robot keeps to it.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.timing.yielding.near_miss import law_conflict, standing_conflicts
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.law_knots import LawKnots
from viaspline.trajectory.yielding.road import Road
from viaspline.world.moving_obstacles import MovingObstacles

FREE_M = 0.01
"""A place becomes free when this much more than required is [m]."""
LOOK_S, SLOW_MPS = 0.02, 0.1
"""How often at most is looked whether it is [s], and what moves more slowly counts as so fast."""

JERK_SAMPLE_S = 0.02
"""A law whose acceleration changes is looked at in pieces of even speed, so long [s]."""


@dataclass(frozen=True, eq=False)
class EvenPieces:
    """A law in pieces of even acceleration.

    Attributes:
        times: [s], (n,).
        places: Distances along the path [m], (n,).
        speeds: [m/s], (n,).
        accelerations: [m/s²], (n - 1,).
        off: The law is no farther from them than this [m].
    """

    times: Floats
    places: Floats
    speeds: Floats
    accelerations: Floats
    off: float = 0.0

    @classmethod
    def of(cls, law: Trajectory) -> EvenPieces:
        """The law itself; where its acceleration changes, short pieces of even speed."""
        if law.changes is None:
            return cls(law.times, law.distances, law.speeds, law.accelerations)
        off = 0.5 * float(np.abs(law.accelerations).max(initial=0.0)) * JERK_SAMPLE_S**2
        times = np.linspace(law.start_time, law.end_time, 2 + int(law.duration / JERK_SAMPLE_S))
        places = law.distance_at(times)
        speeds = np.append(np.diff(places) / np.maximum(np.diff(times), 1e-12), 0.0)
        return cls(times, places, speeds, np.zeros(len(times) - 1), off)


@dataclass(frozen=True)
class Traffic:
    """What moves, and what is kept.

    Attributes:
        moving: By the clock of the time law.
        required: From the robot's centre to every shape [m].
        hold: For how long the end of the path stays free after arrival [s].
    """

    moving: MovingObstacles
    required: float
    hold: float

    def conflict(self, road: Road, law: Trajectory) -> tuple[float, int] | None:
        """When something may come too near to a robot on its way, and what; None: never."""
        return self.conflict_later(road, EvenPieces.of(law), 0.0)

    def conflict_later(
        self, road: Road, pieces: EvenPieces, late: float
    ) -> tuple[float, int] | None:
        """As ``conflict``, for a robot that drives pieces of a law so much later [s]."""
        time, index = law_conflict(
            self.moving.packed, self.required + pieces.off, road.tree, pieces.times + late,
            pieces.places, pieces.speeds, pieces.accelerations, self.hold,
        )  # fmt: skip
        return None if index < 0 else (float(time), int(index))

    def is_clear(self, road: Road, knots: LawKnots) -> bool:
        """Whether nothing comes too near to a robot on its way to the end of a path."""
        return self.met(road, knots) < 0

    def met(self, road: Road, knots: LawKnots) -> int:
        """What first comes too near to a robot on its way to the end of a path; -1: nothing."""
        times, places, speeds = knots.merged().fields
        accelerations = np.diff(speeds) / np.diff(times)
        _, index = law_conflict(
            self.moving.packed, self.required, road.tree, times, places, speeds, accelerations,
            self.hold,
        )  # fmt: skip
        return int(index)

    def free_until(self, road: Road, place: float, begin: float, end: float) -> float:
        """Until when nothing comes near a robot that stands somewhere [s]; inf: until the end."""
        x, y = road.at(place)
        time, _ = standing_conflicts(self.moving.packed, self.required, x, y, begin, end)
        return float(time)

    def free_again(self, road: Road, place: float, begin: float, end: float) -> float:
        """From when on a robot can stand somewhere for a moment [s], or the end."""
        point = road.at(place)
        time = begin
        while time < end:
            gap, _ = self.moving.nearest(point, time)
            if gap[0] - self.required >= FREE_M:
                return time
            closing = max(self.moving.top_speed, SLOW_MPS)
            time += max((self.required + FREE_M - float(gap[0])) / closing, LOOK_S)
        return end
