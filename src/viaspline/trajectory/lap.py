"""The time law of a lap that is driven again and again: as fast at its end as at its start."""

from __future__ import annotations

from collections.abc import Sequence

from viaspline.handed_in import check_answers
from viaspline.mission.world_spec import SpeedZone
from viaspline.trajectory.curvature_limited import Cubic
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.motion_ends import Seam
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory


def retime_lap(
    path: Cubic,
    limits: Limits,
    stations: Sequence[Station] = (),
    *,
    zones: Sequence[SpeedZone] = (),
    speed_cap: float | None = None,
    start_time: float = 0.0,
    grid: int | None = None,
) -> Trajectory:
    """The fastest lap of a closed path that can be driven again and again without a halt.

    It is ``retime`` with a seam for its end: the speed there is the one at the start, the largest
    with which that can be so.

    Args:
        path: A piecewise cubic that ends where it starts.
        limits: As for ``retime``; with ``max_jerk`` the acceleration goes on at the seam as well.
        stations: Stops on the lap; one at the seam is made once, at the end of the lap.
        zones: Areas with a lower speed.
        speed_cap: One more limit of the speed [m/s].
        start_time: Time at the start [s].
        grid: As for ``retime``.

    Returns:
        The time law of one lap.

    Raises:
        GeometryError: If the path doesn't end where it starts, or a number makes no sense.

    Example:
        >>> import numpy as np
        >>> from viaspline.curve.cardinal import CardinalSpline
        >>> angles = np.linspace(0, 2 * np.pi, 25)[:-1]
        >>> ring = CardinalSpline(10 * np.stack((np.cos(angles), np.sin(angles)), 1), closed=True)
        >>> law = retime_lap(ring, Limits(max_speed=2, max_accel=1))
        >>> law.speeds.tolist(), round(law.duration, 2)
        ([2.0, 2.0], 31.41)
    """
    check_answers("path", path, "domain", "give the path of a plan")
    return retime(
        path, limits, stations, zones=zones, end_speed=Seam(), speed_cap=speed_cap,
        start_time=start_time, grid=grid,
    )  # fmt: skip
