"""A moving obstacle as one that stands everywhere where it is for a while.

A path that leads round it passes where the obstacle won't be, if the robot is there in that while.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Obstacle, Side
from viaspline.spacetime.timed_drive import Passing
from viaspline.world.moving_obstacles import MovingObstacles

SAMPLES = 9  # instants whose places are taken
ARC_SEGMENTS = 4  # of a quarter circle of its outline
STILL_M = 1e-6  # what moves by less stands


def standing_ghost(
    moving: MovingObstacles,
    index: int,
    side: Side,
    window: tuple[float, float],
    apart: float = 0.0,
) -> tuple[Obstacle, Passing] | None:
    """An obstacle that stands where a moving one is from a time to another.

    Args:
        moving: Obstacles that move.
        index: Which of them.
        side: On which it is to be passed.
        window: From when to when [s].
        apart: So much larger it is on all sides [m].

    Returns:
        The obstacle, and what it stands for; None where the moving one isn't there.

    Example:
        >>> cart = Obstacle(
        ...     circle={"center": (0, 0), "radius": 1}, name="cart",
        ...     motion={"from": (0, 5), "velocity_mps": (1, 0)},
        ... )
        >>> ghost, passing = standing_ghost(MovingObstacles([cart]), 0, "left", (2.0, 4.0))
        >>> ghost.pass_on, ghost.ring.box
        ('left', (1.0, 4.0, 5.0, 6.0))
    """
    from shapely import GeometryCollection
    from shapely.affinity import affine_transform

    frames = _frames(moving, index, window)
    if not len(frames):
        return None
    ring = moving.obstacles[index].ring
    assert ring is not None
    error = _uncertainty(moving, index, window) + apart
    name = f"{moving.name(index)} at {0.5 * sum(window):.1f} s"
    passing = Passing(moving.name(index), side, *window)
    if ring.is_disc and np.ptp(frames[:, :2], axis=0).max() < STILL_M:
        circle = {"center": _placed(ring.loops[0][0], frames[0]), "radius": ring.radius + error}
        return Obstacle.model_validate({"circle": circle, "name": name, "pass_on": side}), passing
    shape = ring.outline(ARC_SEGMENTS)
    covered = [
        affine_transform(shape, (math.cos(h), -math.sin(h), math.sin(h), math.cos(h), x, y))
        for x, y, h in frames.tolist()
    ]
    outline = GeometryCollection(covered).convex_hull.buffer(error, quad_segs=ARC_SEGMENTS)
    corners = np.asarray(outline.exterior.coords)[:-1].tolist()
    return Obstacle.model_validate({"polygon": corners, "name": name, "pass_on": side}), passing


def _frames(moving: MovingObstacles, index: int, window: tuple[float, float]) -> Floats:
    """Where the frame is in the window: x, y [m], heading [rad], (k, 3)."""
    times = np.linspace(*window, SAMPLES if window[1] > window[0] else 1)
    frames = np.array([moving.frames(time)[index] for time in times])
    return np.ascontiguousarray(frames[np.isfinite(frames[:, 0])])


def _placed(point: tuple[float, float], frame: Floats) -> tuple[float, float]:
    """A point of the frame where that is [m]."""
    (x, y), (dx, dy, heading) = point, frame.tolist()
    c, s = math.cos(heading), math.sin(heading)
    return dx + c * x - s * y, dy + s * x + c * y


def _uncertainty(moving: MovingObstacles, index: int, window: tuple[float, float]) -> float:
    """How far from its place it may be in the window [m]."""
    motion = moving.obstacles[index].motion
    assert motion is not None
    late = max(0.0, window[1] - moving.since[index])
    return motion.error.position_m + motion.error.growth_mps * late
