"""The seam of a lap: where it ends as it begins, and how fast a robot may be there.

Tested through ``trajectory/test_lap``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.trajectory.coupled import Profile, Stage
from viaspline.trajectory.limited_path import LimitedCubicPath, LimitedPath
from viaspline.trajectory.limits import YAW_SETTLE_S, Station
from viaspline.trajectory.steering_rate import jump_speeds

SEAM_TOLERANCE_M = 1e-6
"""A lap ends where it starts, this near [m]."""

SPEED_HALVINGS = 50


def checked_lap(limited_path: LimitedPath, start: float) -> LimitedCubicPath:
    """The path, if it is a piecewise cubic that ends where it starts, and driven from there.

    Raises:
        GeometryError: If it isn't.
    """
    if not isinstance(limited_path, LimitedCubicPath):
        raise GeometryError("a lap has to be a piecewise cubic; this path is only evaluated")
    if start > 0.0:
        raise GeometryError(f"a lap begins at the start of its path, not at {start:g} m")
    spans = limited_path.path.spans
    gap = float(np.linalg.norm(spans[0, 0] - spans[-1, 3]))
    if gap > SEAM_TOLERANCE_M:
        raise GeometryError(f"the path ends {gap:.3g} m from where it starts: that is no lap")
    return limited_path


def once_a_lap(stations: Sequence[Station], length: float) -> list[Station]:
    """Stations of which one at the seam is made once, at the end of the lap."""
    slip = 1e-9 * (1.0 + length)
    return [Station(length, s.dwell, s.name) if s.distance <= slip else s for s in stations]


def lap_profile(limited_path: LimitedCubicPath, stage: Stage) -> tuple[Profile, float]:
    """The fastest v² that is at the end of a lap what it is at its start.

    Every limit is convex in v² and a robot that stands keeps it, so a smaller speed at the seam is
    always possible, and the largest is found by halving.

    Args:
        limited_path: The lap.
        stage: All of it; its first and last speeds are sought.

    Returns:
        The profile, and the largest speed that the seam allows by itself [m/s].
    """

    def lap(speed: float) -> tuple[Profile, bool]:
        profile = limited_path.profile(replace(stage, first=speed, last=speed))
        ends = profile.squares[[0, -1]]
        kept = not profile.over > 0.0 and profile.missed != profile.missed
        return profile, kept and bool(np.all(ends >= speed * speed * (1.0 - 1e-12)))

    slip = 1e-9 * (1.0 + stage.end)
    halts = any(stop >= stage.end - slip for stop in stage.stops)
    top_at_seam = 0.0 if halts else min(stage.top, _seam_speed(limited_path))
    profile, kept = lap(top_at_seam)
    if not kept:
        low, high = 0.0, top_at_seam**2
        for _ in range(SPEED_HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if lap(np.sqrt(middle))[1] else (low, middle)
        profile, _ = lap(np.sqrt(low))
    if limited_path.limits.max_jerk is None:
        profile.squares[-1] = profile.squares[0]
    return profile, top_at_seam


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
