"""A range sensor of what moves: it tells where each thing near enough is, and how fast it goes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viaspline.errors import GeometryError
from viaspline.handed_in import check_kind, numbers_from, seed_from
from viaspline.kernels.arrays import Floats
from viaspline.kernels.motion.moving_rates import rates_at
from viaspline.kernels.world.distance import obstacle_distances
from viaspline.mission.fields import MAX_LENGTH_M, SPEEDS_MPS
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.tracks.told_velocities import told_velocities
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.shapes_at import shapes_at


@dataclass(frozen=True)
class MovingSighting:
    """One moving thing at one instant.

    Attributes:
        index: Which one it is: the same in every look.
        obstacle: Its shape, in its own frame.
        frame: Where that frame is: x, y [m], heading [rad anticlockwise from x].
        velocity: Of the frame's origin as measured, (vx, vy) [m/s].

    Raises:
        GeometryError: When a number is none, not finite, or no place or speed of anything.

    Example:
        >>> cart = Obstacle(circle={"center": (0, 0), "radius": 0.5})
        >>> MovingSighting(3, cart, frame=(4, 2, 0), velocity=(0.8, 0)).frame
        (4.0, 2.0, 0.0)
    """

    index: int
    obstacle: Obstacle
    frame: tuple[float, float, float]
    velocity: tuple[float, float]

    def __post_init__(self) -> None:
        object.__setattr__(self, "index", seed_from("index", self.index))
        check_kind("obstacle", self.obstacle, Obstacle, "give Obstacle(circle={...})")
        for name, size in (("frame", 3), ("velocity", 2)):
            numbers = numbers_from(name, getattr(self, name))
            if numbers.shape != (size,) or not np.isfinite(numbers).all():
                raise GeometryError(f"{name} is {numbers.tolist()}; give {size} finite numbers")
            object.__setattr__(self, name, tuple(numbers.tolist()))
        if not math.hypot(*self.velocity) <= SPEEDS_MPS[1]:
            raise GeometryError(
                f"velocity is {self.velocity}; nothing goes over {SPEEDS_MPS[1]:g} m/s"
            )
        if not math.hypot(*self.frame[:2]) <= MAX_LENGTH_M:
            raise GeometryError(f"frame is {self.frame}; give a place within {MAX_LENGTH_M:g} m")


class MotionSensor:
    """Sees all round, up to a range, whatever is in between.

    Args:
        moving: What there is to see, as it truly moves.
        range_m: How far it sees from the robot's centre [m].
        velocity_noise_mps: Standard deviation of each coordinate of a velocity [m/s]. The noise is
            Gaussian, cut off at three standard deviations, and depends on nothing but the seed, the
            number of the look and which thing it is.
        seed: For the noise.

    Raises:
        GeometryError: When it sees nothing at all, or the noise is no standard deviation.

    Example:
        >>> cart = Obstacle(
        ...     circle={"center": (0, 0), "radius": 1},
        ...     motion={"from": (9, 0), "velocity_mps": (-2, 0)},
        ... )
        >>> sensor = MotionSensor(MovingObstacles([cart]), range_m=5)
        >>> sensor.seen((0, 0), time=1.0)
        ()
        >>> sensor.seen((0, 0), time=2.0)[0].frame
        (5.0, 0.0, 0.0)
    """

    def __init__(
        self,
        moving: MovingObstacles,
        range_m: float,
        velocity_noise_mps: float = 0.0,
        seed: int = 0,
    ) -> None:
        if not range_m > 0.0:
            raise GeometryError(f"range_m is {range_m}; give a range above 0")
        if not velocity_noise_mps >= 0.0:
            raise GeometryError(f"velocity_noise_mps is {velocity_noise_mps}; give 0 or more")
        self.moving = moving
        self.range = float(range_m)
        self.velocity_noise = float(velocity_noise_mps)
        self.seed = seed

    def seen(self, position: ArrayLike, time: float, number: int = 0) -> tuple[MovingSighting, ...]:
        """What has a part within range of a position [m], shape (d,), at an instant [s].

        Args:
            position: Of the robot.
            time: By the clock of what moves.
            number: Of the look; looks with the same number have the same noise.
        """
        frames, rates = self.moving.frames(time), rates_at(self.moving.packed, float(time))
        point = np.asarray(position, np.float64)[None, :2]
        near = self._in_range(frames, np.ascontiguousarray(point), time)
        told = told_velocities(rates[:, :2], self.velocity_noise, self.seed, number)
        return tuple(
            MovingSighting(
                i,
                self.moving.obstacles[i],
                (float(frames[i, 0]), float(frames[i, 1]), float(frames[i, 2])),
                (told[i][0], told[i][1]),
            )
            for i in near
        )

    def _in_range(self, frames: Floats, point: Floats, time: float) -> list[int]:
        """Indices of what is there and has a part in range."""
        away = np.hypot(*(frames[:, :2] - point).T) - self.moving.packed.reaches
        maybe: list[int] = np.flatnonzero(away <= self.range).tolist()  # nan is not
        if not maybe:
            return maybe
        shapes = shapes_at(self.moving, time)
        return [i for i in maybe if obstacle_distances(shapes, i, point)[0] <= self.range]
