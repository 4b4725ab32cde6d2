"""Space and time of a drive: how much room there is at every place of its path, at every instant.

Tested through ``report/test_moving_pictures``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.planner import Plan
from viaspline.planning.problem.requirements import Requirements
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles

ACROSS, UP = 240, 240  # places and instants that are looked at
LATER_RATIO = 0.05  # of the drive, that is shown after its end


@dataclass(frozen=True)
class SpaceTime:
    """What is to be seen of it.

    Attributes:
        path: What is driven.
        moving: What moves.
        required: Distance that the path keeps from it [m].
        begin: The first instant [s],
        end: and the last one [s].
    """

    path: Path
    moving: MovingObstacles
    required: float
    begin: float
    end: float

    @classmethod
    def of_plan(cls, plan: Plan) -> SpaceTime:
        """From the departure until the goal need not stay free any more, and a little later."""
        law = plan.trajectory
        lasts = law.end_time - law.start_time
        end = law.end_time + LATER_RATIO * lasts + plan.mission.route.hold_s
        moving = MovingObstacles.known(plan.mission)
        return cls(plan.path, moving, kept_from_moving(plan), law.start_time, end)

    def gaps(self, across: int = ACROSS, up: int = UP) -> tuple[Floats, Floats, Floats]:
        """Distances along the path (n,), times (m,), and how much room there is (m, n) [m].

        Args:
            across: How many places, n.
            up: How many instants, m.
        """
        distances = np.linspace(0.0, self.path.length, across)
        times = np.linspace(self.begin, self.end, up)
        places = np.asarray(self.path.at_distance(distances))[:, :2]
        room = self.moving.distance(np.tile(places, (up, 1)), np.repeat(times, across))
        return distances, times, room.reshape(up, across) - self.required


def kept_from_moving(plan: Plan) -> float:
    """Distance that a plan's path keeps from what moves [m].

    That of the disc around the body. Where a body that is no disc goes by more closely than that,
    it is what it keeps there: no law is drawn through what would block it.
    """
    requirements = Requirements.of(plan.mission, plan.tracking_error)
    moving = MovingObstacles.known(plan.mission)
    if requirements.footprint is None or not len(moving):
        return requirements.around
    distances, times = line_of(plan.trajectory).T
    nearest = float(moving.distance(plan.path.at_distance(distances), times).min())
    return float(np.clip(nearest, requirements.required, requirements.around))


def line_of(law: Trajectory) -> Floats:
    """A law as distances along the path [m] and times [s], (n, 2)."""
    times = np.unique(np.concatenate((law.times, np.linspace(law.start_time, law.end_time, 400))))
    return np.column_stack((np.asarray(law.distance_at(times)), times))
