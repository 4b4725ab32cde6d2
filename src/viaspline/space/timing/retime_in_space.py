"""The fastest drive along a path in space."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from viaspline.curve.path import Path
from viaspline.mission.world_spec import SpeedZone
from viaspline.space.timing.climb_speeds import climb_speeds
from viaspline.space.timing.spatial_limits import SpatialLimits
from viaspline.space.timing.yaw_profile import YawProfile
from viaspline.space.timing.yaw_speeds import with_yaw_turns, yaw_speeds
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory

FREE_AXIS = 10.0
"""How much more than all other limits together an axis without one may have."""


def retime_in_space(
    path: Path, limits: SpatialLimits, stations: tuple[Station, ...], yaw: YawProfile, *,
    zones: Sequence[SpeedZone] = (), start: float = 0.0, start_speed: float = 0.0,
    start_time: float = 0.0,
) -> Trajectory:  # fmt: skip
    """The fastest drive along a path that keeps every limit everywhere.

    Climb, descent and yaw are largest speeds at every place; they are taken on pieces of the path
    on which they change little, each as its slowest place allows. See `viaspline.retime` for the
    rest.

    Args:
        path: In space.
        limits: Of speed, acceleration, climb, descent and yaw.
        stations: Stops, each with its dwell.
        yaw: The headings along the path.
        zones: Areas with a lower speed, at every height.
        start: Distance along the path at which the law begins [m]; stops before it are left out.
        start_speed: Speed there [m/s].
        start_time: When that is [s].

    Raises:
        GeometryError: If a number makes no sense.

    >>> from viaspline.space.timing.yaw_profile import FacingAlong, yaw_profile
    >>> up = Path([[[0, 0, 0], [0, 0, 4], [0, 0, 8], [0, 0, 12]]], vias=[])
    >>> limits = SpatialLimits(along=Limits(max_speed=10, max_accel=2), climb=2)
    >>> retime_in_space(up, limits, (), yaw_profile(up, FacingAlong())).duration
    7.0
    """
    top = limits.along.max_speed
    slow = (
        *climb_speeds(path, top, limits.climb, limits.descent),
        *yaw_speeds(yaw, limits.yaw_rate, top),
    )
    stops = with_yaw_turns(stations, yaw, limits.yaw_rate)
    return retime(
        path, along_limits(limits), stops, slow=slow, zones=zones, start=start,
        start_speed=start_speed, start_time=start_time,
    )  # fmt: skip


def along_limits(limits: SpatialLimits) -> Limits:
    """The limits along the path and, where there is one, of the acceleration up and down."""
    along = limits.along
    if along.max_yaw_rate is not None or along.max_yaw_accel is not None:
        along = replace(along, max_yaw_rate=None, max_yaw_accel=None)
    if limits.vertical_accel is None:
        return along
    across = along.max_lateral_accel or along.max_accel
    free = FREE_AXIS * (along.max_accel + along.brake + across + limits.vertical_accel)
    return replace(along, axis_accel=(free, free, limits.vertical_accel))
