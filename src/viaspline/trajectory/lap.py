"""The time law of a lap that is driven again and again: as fast at its end as at its start."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.mission.parts import SpeedZone
from viaspline.trajectory.coupled import Profile, Stage
from viaspline.trajectory.curvature_limited import Cubic
from viaspline.trajectory.jerk_limited_lap import smooth_lap
from viaspline.trajectory.limited_path import LimitedCubicPath, crawl
from viaspline.trajectory.limits import YAW_SETTLE_S, Limits, Station
from viaspline.trajectory.retime import stops_from
from viaspline.trajectory.steering_rate import jump_speeds
from viaspline.trajectory.trajectory import Trajectory

SEAM_TOLERANCE = 1e-6
"""A lap ends where it starts, this near [m]."""

SPEED_HALVINGS = 50


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

    The speed at its end is the one at its start, the largest with which that can be so. Every
    limit is convex in v² and a robot that stands keeps it, so a smaller speed at the seam is
    always possible, and the largest is found by halving.

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
        >>> from viaspline.curve.cardinal import CardinalSpline
        >>> angles = np.linspace(0, 2 * np.pi, 25)[:-1]
        >>> ring = CardinalSpline(10 * np.stack((np.cos(angles), np.sin(angles)), 1), closed=True)
        >>> law = retime_lap(ring, Limits(max_speed=2, max_accel=1))
        >>> law.speeds.tolist(), round(law.duration, 2)
        ([2.0, 2.0], 31.41)
    """
    limited_path = LimitedCubicPath(path, limits, grid)
    gap = float(np.linalg.norm(path.spans[0, 0] - path.spans[-1, 3]))
    if gap > SEAM_TOLERANCE:
        raise GeometryError(f"the path ends {gap:.3g} m from where it starts: that is no lap")
    length = limited_path.length
    top = limits.max_speed if speed_cap is None else min(limits.max_speed, float(speed_cap))
    if not top > 0.0:
        raise GeometryError(f"speed_cap is {speed_cap}; give a speed above 0")
    slip = 1e-9 * (1.0 + length)
    stops = stops_from(
        [Station(length, s.dwell, s.name) if s.distance <= slip else s for s in stations],
        0.0,
        length,
    )
    slow = limited_path.slow(zones, 0.0)

    def lap(speed: float) -> tuple[Profile, bool]:
        stage = Stage(
            start=0.0, end=length, first=speed, last=speed, top=top,
            stops=tuple(stop.distance for stop in stops), slow=slow,
        )  # fmt: skip
        profile = limited_path.profile(stage)
        ends = profile.squares[[0, -1]]
        kept = not profile.over > 0.0 and profile.missed != profile.missed
        return profile, kept and bool(np.all(ends >= speed * speed * (1.0 - 1e-12)))

    if any(stop.distance >= length - slip for stop in stops):
        top_at_seam = 0.0
    else:
        top_at_seam = min(top, _seam_speed(limited_path))
    profile, kept = lap(top_at_seam)
    if not kept:
        low, high = 0.0, top_at_seam**2
        for _ in range(SPEED_HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if lap(np.sqrt(middle))[1] else (low, middle)
        profile, _ = lap(np.sqrt(low))
    if limits.max_jerk is not None:
        stage = Stage(
            start=0.0, end=length, first=0.0, last=0.0, top=top,
            stops=tuple(stop.distance for stop in stops), slow=slow,
        )  # fmt: skip
        return smooth_lap(limited_path, limits, stage, profile, stops, start_time, top_at_seam)
    profile.squares[-1] = profile.squares[0]
    return Trajectory.through(
        profile.points,
        profile.squares,
        max_accel=crawl(limits),
        stations=stops,
        start_time=start_time,
    )


def _seam_speed(limited_path: LimitedCubicPath) -> float:
    """The largest speed that a turn or a jump of the curvature at the seam allows [m/s]."""
    limits, spans = limited_path.limits, limited_path.path.spans
    across = (
        limits.max_lateral_accel, limits.max_yaw_rate, limits.max_yaw_accel, limits.axis_accel,
        limits.max_steer_rate,
    )  # fmt: skip
    if all(limit is None for limit in across):
        return np.inf
    before, after = _direction(spans[-1, ::-1]), _direction(spans[0])
    if np.linalg.norm(before + after) > 1e-5:
        return 0.0
    if limits.max_yaw_accel is None and limits.max_steer_rate is None:
        return np.inf
    stage = Stage(start=0.0, end=limited_path.length, first=0.0, last=0.0, top=limits.max_speed)
    cells, _ = limited_path.cells(stage)
    if not cells.yaws.size:
        return np.inf
    before, after = cells.yaws[-1:, 0, 2], cells.yaws[:1, 0, 0]
    steered = float(jump_speeds(before, after, limits)[0])
    if limits.max_yaw_accel is None:
        return steered
    jump = abs(float(after[0] - before[0]))
    return min(steered, limits.max_yaw_accel * YAW_SETTLE_S / max(jump, 1e-12))


def _direction(span: Floats) -> Floats:
    """Unit vector from the first control point to the next one that is elsewhere."""
    ways = span[1:] - span[0]
    lengths = np.linalg.norm(ways, axis=1)
    k = int(np.argmax(lengths > 1e-12 * lengths.max()))
    return np.asarray(ways[k] / max(float(lengths[k]), 1e-300))
