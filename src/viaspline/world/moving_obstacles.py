"""Obstacles that move as it is known: where they are when, and how far from them a place is."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.errors import GeometryError
from viaspline.handed_in import all_of, numbers_from
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.motion import moving_distance as kernels
from viaspline.kernels.motion.packed_motion import PackedMotion
from viaspline.mission.model import Mission
from viaspline.mission.motion_checks import faults_of_one
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.world.pack_motion import joined_motion, pack_motion, pack_shapes, part_of_motion


class MovingObstacles(ComparedByValue):
    """Obstacles with a motion each, by one clock.

    Two that look alike are two: an obstacle is known by its place among them.

    Args:
        obstacles: Each with a shape in its own frame and a motion.
        since: When their places begin to get less certain [s]; see the motion's ``error``. One
            time for all, or one for each.

    Raises:
        GeometryError: One has no motion, or is a map of squares, or doesn't say how it moves.

    Example:
        >>> cart = Obstacle(
        ...     name="cart",
        ...     circle={"center": (0, 0), "radius": 1},
        ...     motion={"from": (0, 5), "velocity_mps": (1, 0)},
        ... )
        >>> moving = MovingObstacles([cart])
        >>> moving.distance([(4, 0), (4, 0)], times=[4, 7])
        array([4.        , 4.83095189])
    """

    def __init__(
        self, obstacles: Iterable[Obstacle] = (), *, since: float | Sequence[float] = 0.0
    ) -> None:
        self.obstacles: tuple[Obstacle, ...] = all_of(
            "obstacles", obstacles, Obstacle, "give Obstacle(circle={...}, motion={...})"
        )
        for i, obstacle in enumerate(self.obstacles):
            if obstacle.motion is None or obstacle.ring is None:
                raise GeometryError(
                    f"obstacle {i} doesn't move, or is a map of squares; give "
                    "Obstacle(circle={...}, motion={...})"
                )
            for fault in faults_of_one((), obstacle, obstacle.motion):
                raise GeometryError(f"obstacle {i}: {fault.problem}; {fault.remedy}")
        times = numbers_from("since", since)
        if times.shape not in ((), (len(self.obstacles),)) or not np.isfinite(times).all():
            raise GeometryError("since isn't a finite time for all, nor one for each of them")
        self.since: tuple[float, ...] = tuple(
            np.broadcast_to(times, (len(self.obstacles),)).tolist()
        )

    @classmethod
    def known(cls, mission: Mission) -> MovingObstacles:
        """What moves as the mission knows it to."""
        return cls(mission.world.moving)

    @classmethod
    def everything(cls, mission: Mission) -> MovingObstacles:
        """What moves, known or not."""
        return cls((*mission.world.moving, *mission.world.unseen_moving))

    @classmethod
    def tracked(cls, obstacles: Iterable[Obstacle], since: float) -> MovingObstacles:
        """What was seen to move, as it is taken to go on.

        Their motions are the robot's own reckoning, by the clock of whoever drives it, and aren't
        looked at as those are that people write.

        Args:
            obstacles: Each with a shape in its own frame and a motion.
            since: When their places begin to get less certain [s].
        """
        all_of_them = tuple(obstacles)
        times = (float(since),) * len(all_of_them)
        return cls._sound(all_of_them, times, pack_motion(all_of_them, times))

    def and_those(self, others: MovingObstacles) -> MovingObstacles:
        """These and then others."""
        if not len(others):
            return self
        if not len(self):
            return others
        obstacles = (*self.obstacles, *others.obstacles)
        packed = joined_motion(self.packed, others.packed, pack_shapes(obstacles))
        return self._sound(obstacles, (*self.since, *others.since), packed)

    def first(self, count: int) -> MovingObstacles:
        """The first of them, so many."""
        return self._part(0, count)

    def from_on(self, index: int) -> MovingObstacles:
        """Those from one on."""
        return self._part(index, len(self))

    def alone(self, index: int) -> MovingObstacles:
        """One of them."""
        return self._part(index, index + 1)

    def _part(self, begin: int, end: int) -> MovingObstacles:
        """Those from one to before another."""
        if begin == 0 and end >= len(self):
            return self
        if begin >= min(end, len(self)):
            return MovingObstacles()
        obstacles = self.obstacles[begin:end]
        packed = part_of_motion(self.packed, begin, end, pack_shapes(obstacles))
        return self._sound(obstacles, self.since[begin:end], packed)

    @classmethod
    def _sound(
        cls, obstacles: tuple[Obstacle, ...], since: tuple[float, ...], packed: PackedMotion
    ) -> MovingObstacles:
        """Obstacles of which it is known that they move as they should: not looked at again.

        With a million keyframes a look takes a second, and under way they are put together anew
        in every step.
        """
        made = cls.__new__(cls)
        made.obstacles, made.since = obstacles, since
        made.__dict__["packed"] = packed
        return made

    def _said(self) -> tuple[object, ...]:
        return self.obstacles, self.since

    @cached_property
    def packed(self) -> PackedMotion:
        """What kernels take; built when it is first asked for."""
        return pack_motion(self.obstacles, self.since)

    def __len__(self) -> int:
        return len(self.obstacles)

    def __repr__(self) -> str:
        return f"MovingObstacles({len(self)})"

    def name(self, index: int) -> str:
        """What an index of ``nearest`` is called."""
        if index < 0:
            return "nothing"
        return self.obstacles[index].name or f"moving obstacle {index + 1}"

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all of them."""
        return tuple(map(self.name, range(len(self))))

    @property
    def top_speed(self) -> float:
        """The greatest speed of any point of any of them [m/s]; 0 if there is none."""
        return float(self.packed.speeds.max(initial=0.0))

    def nearest(self, points: ArrayLike, times: ArrayLike) -> tuple[Floats, Ints]:
        """Signed distance at an instant [m] and what is nearest, less how far off it may be.

        Args:
            points: Shape (n, 2), or (2,); a third coordinate plays no part.
            times: One for each point [s], or one for all.

        Returns:
            (distance (n,), index (n,)); infinite and -1 where nothing is there.

        Raises:
            GeometryError: For other shapes, and numbers that are not finite.
        """
        places = np.atleast_2d(numbers_from("points", points))
        instants = numbers_from("times", times)
        if places.ndim != 2 or places.shape[1] not in (2, 3):
            raise GeometryError(f"points have shape {places.shape}; give (n, 2) or (2,)")
        if instants.shape not in ((), (1,), (len(places),)):
            raise GeometryError(
                f"{instants.size} times don't go with {len(places)} points; give one for each"
            )
        if not (np.isfinite(places).all() and np.isfinite(instants).all()):
            raise GeometryError("points or times contain NaN or infinity; give finite numbers")
        each = np.ascontiguousarray(np.broadcast_to(instants, (len(places),)))
        return kernels.moving_distances(self.packed, each, np.ascontiguousarray(places[:, :2]))

    def distance(self, points: ArrayLike, times: ArrayLike) -> NDArray[np.float64]:
        """Signed distance of points at instants [m], (n,); see ``nearest``."""
        return self.nearest(points, times)[0]

    def frames(self, time: float) -> Floats:
        """Where their frames are: x, y [m] and heading [rad], (n, 3); nan for what isn't there."""
        return kernels.frames_at(self.packed, float(time))
