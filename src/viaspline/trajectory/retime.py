"""The fastest way to drive along a path under limits, with stops at stations."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.curve.polynomial_curve import curve_from
from viaspline.errors import GeometryError
from viaspline.handed_in import all_of, check_answers, check_kind, finite_from, number_from
from viaspline.mission.world_spec import SpeedZone
from viaspline.trajectory.cells import Evaluable
from viaspline.trajectory.coupled import Profile, Stage
from viaspline.trajectory.curvature_limited import Cubic
from viaspline.trajectory.jerk import smooth_law
from viaspline.trajectory.jerk_limited_lap import smooth_lap
from viaspline.trajectory.limited_path import LimitedCubicPath, crawl, limited_path_of
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.motion_ends import Seam
from viaspline.trajectory.seam import checked_lap, lap_profile, once_a_lap
from viaspline.trajectory.slow_zones import Slow, slow_between
from viaspline.trajectory.trajectory import Trajectory

Curve = Cubic | Evaluable

SLIP = 1e-9
"""By this part of a metre and its length the end of a path may be off: lengths are sums."""


def retime(
    path: Curve,
    limits: Limits,
    stations: Sequence[Station] = (),
    *,
    zones: Sequence[SpeedZone] = (),
    slow: Sequence[Slow] = (),
    start: float = 0.0,
    start_speed: float = 0.0,
    start_accel: float = 0.0,
    end_speed: float | Seam = 0.0,
    speed_cap: float | None = None,
    start_time: float = 0.0,
    grid: int | None = None,
    replaces: Trajectory | None = None,
) -> Trajectory:
    """The fastest drive along a path that keeps every limit everywhere.

    With limits that are a largest speed at every place (speed, across the path, yaw rate, zones)
    v² is bounded on every arc by the arc's proven largest curvature, and two passes take off what
    braking and speeding up don't allow: exact but for the arcs' ends. Limits of the yaw
    acceleration and of the axes couple speed and acceleration; then the path is cut into cells and
    the fastest v² is found by reachability, as TOPP-RA does it. v² is linear between the points of
    the result, and the limits are kept between them as well: on a piecewise cubic in the plane
    that is proven, on any other curve the errors between samples are measured and allowed for.

    The robot comes to rest at stations, and where it would have to turn on the spot (a corner or a
    cusp) if a limit asks for anything across the path.

    ``max_jerk`` bounds the change of the acceleration along the path and is kept like every other
    limit; what is found is a local optimum. A drive that begins under way begins with
    ``start_accel``, and one that ends under way ends without acceleration. Where a robot that is
    under way has no room to keep everything, or none is found, it changes its acceleration faster,
    up to the first rest at most, and ``over_jerk_until`` says how far.

    Args:
        path: What is driven: a piecewise cubic such as ``Path`` or ``CardinalSpline``, or anything
            with ``domain`` and ``evaluate(u, derivative)``, for which distances are measured from
            its start; or a ``PPoly``, ``BPoly`` or ``BSpline`` of scipy.
        limits: Of speed, acceleration, yaw, jerk and axes.
        stations: Stops, each with its dwell; those before ``start`` are left out.
        zones: Areas in which the reference point of the robot drives no faster than they say. A
            station inside of one is a stop like any other.
        slow: Stretches of the path with a lower speed.
        start: Distance along the path at which the time law begins [m].
        start_speed: Speed there [m/s]. If the limits allow less, the robot brakes as hard as it
            can, and ``over_limit_until`` of the result says how far.
        start_accel: Acceleration there [m/s²] if the speed isn't 0; only ``max_jerk`` asks for it.
        end_speed: Speed at the end of the path [m/s], or less; a ``Seam`` if it is a lap that goes
            on at its start, which then ends as it begins.
        speed_cap: One more limit of the speed [m/s], e.g. what the sensor allows.
        start_time: Time at the start [s].
        grid: At least so many cells where speed and acceleration are coupled; on a sampled curve
            exactly so many, 1000 by default. By default as many as the limits need.
        replaces: The time law that is driven until ``start_time``, on this path or one that it
            leaves; only ``max_jerk`` asks for it, as a first guess of how the robot goes on.

    Returns:
        The time law from ``start`` to the end of the path.

    Raises:
        GeometryError: If a number makes no sense, or the robot is too fast at the start to stop
            at a station or at the end.

    Example:
        >>> from viaspline.curve.path import Path
        >>> line = Path([[[0, 0], [10, 0], [20, 0], [30, 0]]], vias=[])
        >>> law = retime(line, Limits(max_speed=2, max_accel=1), [Station(10, dwell=5)])
        >>> law.duration
        24.0
        >>> law.times
        array([ 0.,  2.,  5.,  7., 12., 14., 22., 24.])
        >>> slow = SpeedZone(polygon=[(20, -5), (25, -5), (25, 5), (20, 5)], max_speed_mps=1)
        >>> round(retime(line, Limits(max_speed=2, max_accel=1), zones=[slow]).duration, 3)
        20.0
    """
    path = curve_from(path)
    check_answers("path", path, "domain", "give a CardinalSpline, or the path of a plan")
    stations = all_of("stations", stations, Station, "give Station(distance, dwell)")
    zones = all_of("zones", zones, SpeedZone, "give SpeedZone(polygon=..., max_speed_mps=...)")
    check_kind("limits", limits, Limits, "give Limits(max_speed=2, max_accel=1)")
    slow = all_of("slow", slow, Slow, "give Slow(start, end, speed)")
    start, start_speed = number_from("start", start), number_from("start_speed", start_speed)
    start_accel = number_from("start_accel", start_accel)
    start_time = finite_from("start_time", start_time)
    speed_cap = None if speed_cap is None else number_from("speed_cap", speed_cap)
    last = 0.0 if isinstance(end_speed, Seam) else number_from("end_speed", end_speed)
    if grid is not None:
        check_kind("grid", grid, int | np.integer, "give a whole number, or None")
    limited_path = limited_path_of(path, limits, grid)
    length = limited_path.length
    _check(length, start, start_speed, start_accel, last, speed_cap)
    if isinstance(end_speed, Seam):
        limited_path, stations = checked_lap(limited_path, start), once_a_lap(stations, length)
    stops = stops_from(stations, start, length)
    if length - start <= 0.0:
        if start_speed**2 > 2.0 * limits.brake * SLIP * (1.0 + length):
            raise _no_room(length, start, start_speed, limits)
        return Trajectory.through(
            np.full(2, length), np.zeros(2), max_accel=crawl(limits), stations=stops,
            start_time=start_time,
        )  # fmt: skip
    stage = Stage(
        start=start,
        end=length,
        first=float(start_speed),
        last=last,
        top=limits.max_speed if speed_cap is None else min(limits.max_speed, float(speed_cap)),
        stops=tuple(stop.distance for stop in stops),
        slow=(*limited_path.slow(zones, start), *slow_between(slow, start, length)),
    )
    if isinstance(limited_path, LimitedCubicPath) and isinstance(end_speed, Seam):
        return _lap_law(limited_path, limits, stage, stops, start_time)
    profile = _kept(limited_path.profile(stage), stage, limits)
    if limits.max_jerk is not None:
        return smooth_law(
            limited_path, limits, stage, profile, stops, start_time, float(start_accel), replaces
        )
    return _as_trajectory(profile, limits, stage, stops, start_time)


def _lap_law(
    path: LimitedCubicPath, limits: Limits, stage: Stage, stops: Sequence[Station],
    start_time: float,
) -> Trajectory:  # fmt: skip
    """The time law of a lap that goes on at its start."""
    profile, seam_speed = lap_profile(path, stage)
    if limits.max_jerk is not None:
        return smooth_lap(path, limits, stage, profile, stops, start_time, seam_speed)
    return _as_trajectory(_kept(profile, stage, limits), limits, stage, stops, start_time)


def _kept(profile: Profile, stage: Stage, limits: Limits) -> Profile:
    """A profile; refused where the robot is too fast to stop somewhere."""
    if profile.missed == profile.missed:
        raise _no_room(float(profile.missed), stage.start, stage.first, limits)
    return profile


def _as_trajectory(
    profile: Profile, limits: Limits, stage: Stage, stops: Sequence[Station], start_time: float
) -> Trajectory:
    """A profile as the time law that it is."""
    return Trajectory.through(
        profile.points,
        profile.squares,
        max_accel=crawl(limits),
        stations=stops,
        start_time=start_time,
        over_limit_until=profile.over if profile.over > stage.start else None,
    )


def _no_room(stop: float, start: float, speed: float, limits: Limits) -> GeometryError:
    """What is said of a robot that is too fast to stop somewhere [m], [m/s]."""
    return GeometryError(
        f"the robot can't stop at {stop:g} m: from {speed:g} m/s at {start:g} m it needs "
        f"{speed**2 / (2 * limits.brake):g} m; start slower or stop later"
    )


def braking(distance: float, speed: float, max_accel: float, start_time: float) -> Trajectory:
    """The time law of a robot that brakes as hard as it can until it stands.

    One that stops within the rounding of its place stands already.

    Args:
        distance: Where it begins along the path [m].
        speed: [m/s].
        max_accel: [m/s²].
        start_time: [s].

    Example:
        >>> braking(5.0, speed=2.0, max_accel=1.0, start_time=0.0).distances
        array([5., 7.])
    """
    rest = distance + speed * speed / (2.0 * max_accel)
    points, squares = np.array([distance, rest]), np.array([speed * speed, 0.0])
    if rest == distance:
        squares[0] = 0.0
    return Trajectory.through(points, squares, max_accel=max_accel, start_time=start_time)


def _check(
    length: float,
    start: float,
    start_speed: float,
    start_accel: float,
    end_speed: float,
    speed_cap: float | None,
) -> None:
    if not 0.0 <= start <= length:
        raise GeometryError(f"start is {start} m; give a distance on the path, 0 to {length:g} m")
    for name, speed in (("start_speed", start_speed), ("end_speed", end_speed)):
        if not 0.0 <= speed < np.inf:
            raise GeometryError(f"{name} is {speed}; give a finite speed of 0 or more")
    if not np.isfinite(start_accel):
        raise GeometryError(f"start_accel is {start_accel}; give a finite acceleration")
    if speed_cap is not None and not speed_cap > 0.0:
        raise GeometryError(f"speed_cap is {speed_cap}; give a speed above 0")


def stops_from(stations: Sequence[Station], start: float, length: float) -> tuple[Station, ...]:
    """The stops from a distance on [m], in order and on the path."""
    slip = SLIP * (1.0 + length)
    for station in stations:
        if not (station.distance <= length + slip and 0.0 <= station.dwell < np.inf):
            raise GeometryError(
                f"station '{station.name}' is at {station.distance} m for {station.dwell} s; "
                f"give a place on the path, which is {length:g} m long, and a time of 0 or more"
            )
    ahead = sorted((s for s in stations if s.distance >= start), key=lambda s: s.distance)
    return tuple(
        Station(min(station.distance, length), station.dwell, station.name) for station in ahead
    )
