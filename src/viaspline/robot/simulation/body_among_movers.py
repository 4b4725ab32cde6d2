"""How near a body that is no disc came to what moves: to its outline as it was turned."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.simulation.driven_motion import DrivenMotion
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

OVERLAPS_M = -1e-6
"""The distance to what lies over the body, at most [m]."""


@dataclass(frozen=True, eq=False)
class BodyAmongMovers:
    """What moves, with its distances to a polygonal body where that was: ``tracks``' ``Movers``.

    Attributes:
        moving: All that moves.
        robot: Whose body it is.
        motion: Where it was, and how it was turned.
    """

    moving: MovingObstacles
    robot: RobotSpec
    motion: DrivenMotion

    @cached_property
    def top_speed(self) -> float:
        """Of what moves, and of what the body's corners do more than its reference point [m/s]."""
        spent = np.diff(self.motion.times)
        turned = np.abs(np.diff(np.unwrap(self.motion.headings)))[spent > 0.0]
        rate = float((turned / spent[spent > 0.0]).max(initial=0.0))
        return self.moving.top_speed + self.robot.outer_radius * rate

    def __len__(self) -> int:
        return len(self.moving)

    def name(self, index: int) -> str:
        """What one is called."""
        return self.moving.name(index)

    def alone(self, index: int) -> BodyAmongMovers:
        """One of them."""
        return BodyAmongMovers(self.moving.alone(index), self.robot, self.motion)

    def distance(self, places: Floats, times: Floats) -> Floats:
        """See ``nearest``."""
        return self.nearest(places, times)[0]

    def nearest(self, places: Floats, times: Floats) -> tuple[Floats, Ints]:
        """Distances to the nearest [m], (n,), and its number.

        They are exact wherever they are the least of all or something touches; where they are
        larger than that they may be too small.

        Args:
            places: Of the body's reference point [m], (n, 2).
            times: When it was there [s], (n,).
        """
        least, index = np.full(len(places), np.inf), np.full(len(places), -1)
        for i in range(len(self.moving)):
            gaps = self._gaps(i, places, times)
            index[gaps < least] = i
            least = np.minimum(least, gaps)
        return least, index

    def _gaps(self, i: int, places: Floats, times: Floats) -> Floats:
        one = self.moving.alone(i)
        away = one.distance(places, times)
        gaps: Floats = away - self.robot.outer_radius
        nearest = max(float(away.min(initial=np.inf)) - self.robot.inner_radius, 0.0)
        worth = np.flatnonzero(gaps <= nearest) if np.isfinite(nearest) else np.empty(0, np.int64)
        if not worth.size:
            return gaps
        frames = np.array([one.frames(time)[0] for time in times[worth].tolist()])
        cos, sin = np.cos(frames[:, 2]), np.sin(frames[:, 2])
        x, y = (places[worth] - frames[:, :2]).T
        seen = np.column_stack((cos * x + sin * y, cos * y - sin * x))
        headings = np.interp(times[worth], self.motion.times, np.unwrap(self.motion.headings))
        assert self.robot.footprint is not None
        standing = World([one.obstacles[0].model_copy(update={"motion": None})])
        to_body = standing.body_distance(seen, headings - frames[:, 2], self.robot.footprint)
        off = standing.distance(seen) - away[worth]  # how far off it may be
        over = np.minimum(gaps[worth], OVERLAPS_M)  # how deep isn't known: no deeper than in a disc
        gaps[worth] = np.where(to_body > 0.0, to_body - off, over)
        return gaps


def movers_about(
    robot: RobotSpec, moving: MovingObstacles, motion: DrivenMotion
) -> tuple[float, MovingObstacles | BodyAmongMovers]:
    """The radius that comes off distances to what moves [m], and what tells these."""
    if robot.footprint is None:
        return robot.outer_radius, moving
    return 0.0, BodyAmongMovers(moving, robot, motion)
