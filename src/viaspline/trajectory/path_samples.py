"""A path and its time law as a table, equally far apart.

Tested through ``presentable/test_named_columns``.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.presentable.named_columns import Table, coordinates, named_columns
from viaspline.trajectory.trajectory import Trajectory

USUAL_STEP_M = 0.1


def path_samples(path: Path, law: Trajectory, step: float) -> Table:
    """Points of a path with what is driven there; both ends are among them.

    Args:
        path: In the plane; heights are carried along.
        law: Along it.
        step: From point to point along the path, at most [m].

    Returns:
        ``distance_m``, ``x_m``, ``y_m``, with heights ``z_m``, ``heading_rad``, ``curvature_1pm``,
        ``speed_mps``, ``time_s`` of arrival.
    """
    u, distance, points = path.sample(step)
    return named_columns(
        {
            "distance_m": distance,
            **coordinates(points),
            "heading_rad": np.asarray(path.heading(u)),
            "curvature_1pm": np.asarray(path.curvature(u)),
            "speed_mps": np.asarray(law.speed_at(distance)),
            "time_s": np.asarray(law.time_at(distance)),
        }
    )


def flight_samples(
    path: Path, law: Trajectory, headings: Callable[[Floats], Floats],
    ground: Callable[[Floats], Floats], step: float,
) -> Table:  # fmt: skip
    """Points of a path in space with what is flown there; both ends are among them.

    Args:
        path: In space.
        law: Along it.
        headings: Of the body at distances along the path [rad].
        ground: Heights of the ground below places (n, 3) [m].
        step: From point to point along the path, at most [m].

    Returns:
        As ``path_samples``, with ``agl_m``, the height above ground that is known (else not a
        number), and ``climb_mps``.
    """
    u, distance, points = path.sample(step)
    below = ground(points)
    speed = np.asarray(law.speed_at(distance))
    return named_columns(
        {
            "distance_m": distance,
            **coordinates(points),
            "agl_m": np.where(np.isfinite(below), points[:, 2] - below, np.nan),
            "heading_rad": headings(distance),
            "curvature_1pm": np.asarray(path.curvature(u)),
            "speed_mps": speed,
            "climb_mps": speed * path.tangent(u)[:, 2],
            "time_s": np.asarray(law.time_at(distance)),
        }
    )
