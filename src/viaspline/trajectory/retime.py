"""The fastest way to drive along a path under limits, with stops at stations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.errors import GeometryError
from viaspline.kernels import profile
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.trajectory import Trajectory

Floats = NDArray[np.float64]

TOLERANCE = 1.1
"""Largest ratio of the curvatures within one arc of the profile."""


class Curve(Protocol):
    """What a time law needs of a piecewise cubic.

    Without a limit across the path the length is enough; the rest is not asked for.
    """

    @property
    def spans(self) -> Floats:
        """Bézier control polygons [m], shape (m, 4, d)."""

    @property
    def domain(self) -> tuple[float, float]:
        """First and last parameter; the spans share it equally."""

    @property
    def length(self) -> float:
        """Length [m]."""

    def distance(self, u: ArrayLike) -> Floats | float:
        """Distance along the curve [m]."""


def retime(
    path: Curve,
    limits: Limits,
    stations: Sequence[Station] = (),
    *,
    start: float = 0.0,
    start_speed: float = 0.0,
    end_speed: float = 0.0,
    speed_cap: float | None = None,
    start_time: float = 0.0,
) -> Trajectory:
    """The largest speed everywhere along a path that keeps every limit.

    v² is bounded from above on every arc of the path: by ``max_speed`` and, with a limit across
    the path, by that limit over the arc's proven largest curvature. A pass from the end and one
    from the start take off what braking and speeding up don't allow. v² is linear between the
    points of the result, so no limit is exceeded between them. The robot comes to rest at
    stations, and where it would have to turn on the spot (a corner or a cusp) if there is a limit
    across the path.

    Args:
        path: What is driven.
        limits: Speed, and acceleration along and across the path.
        stations: Stops, each with its dwell; those before ``start`` are left out.
        start: Distance along the path at which the time law begins [m].
        start_speed: Speed there [m/s]. If the limits on speed and across the path allow less, the
            robot brakes as hard as it can, and ``over_limit_until`` of the result says how far.
        end_speed: Speed at the end of the path [m/s].
        speed_cap: One more limit of the speed [m/s], e.g. what the sensor allows.
        start_time: Time at the start [s].

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
    """
    length = float(path.length)
    _check(length, start, start_speed, end_speed, speed_cap)
    stops = _stops_from(stations, start, length)
    top = limits.max_speed if speed_cap is None else min(limits.max_speed, speed_cap)
    if length - start <= 0.0:
        points, squares = np.full(2, length), np.zeros(2)
        return Trajectory.through(
            points, squares, max_accel=limits.max_accel, stations=stops, start_time=start_time
        )
    line, caps, rests = _stretches(path, limits, top, start, length, stops)
    points, squares, over, missed = profile.speed_profile(
        line, caps, rests, limits.max_accel, start_speed**2, end_speed**2
    )
    if missed == missed:
        raise GeometryError(
            f"the robot can't stop at {missed:g} m: from {start_speed:g} m/s at {start:g} m it "
            f"needs {start_speed**2 / (2 * limits.max_accel):g} m; start slower or stop later"
        )
    return Trajectory.through(
        points,
        squares,
        max_accel=limits.max_accel,
        stations=stops,
        start_time=start_time,
        over_limit_until=over if over > start else None,
    )


def braking(distance: float, speed: float, max_accel: float, start_time: float) -> Trajectory:
    """The time law of a robot that brakes as hard as it can until it stands.

    Args:
        distance: Where it begins along the path [m].
        speed: [m/s].
        max_accel: [m/s²].
        start_time: [s].

    Example:
        >>> braking(5.0, speed=2.0, max_accel=1.0, start_time=0.0).distances
        array([5., 7.])
    """
    points = np.array([distance, distance + speed * speed / (2.0 * max_accel)])
    squares = np.array([speed * speed, 0.0])
    return Trajectory.through(points, squares, max_accel=max_accel, start_time=start_time)


def _check(
    length: float, start: float, start_speed: float, end_speed: float, speed_cap: float | None
) -> None:
    if not 0.0 <= start <= length:
        raise GeometryError(f"start is {start} m; give a distance on the path, 0 to {length:g} m")
    for name, speed in (("start_speed", start_speed), ("end_speed", end_speed)):
        if not 0.0 <= speed < np.inf:
            raise GeometryError(f"{name} is {speed}; give a finite speed of 0 or more")
    if speed_cap is not None and not speed_cap > 0.0:
        raise GeometryError(f"speed_cap is {speed_cap}; give a speed above 0")


def _stops_from(stations: Sequence[Station], start: float, length: float) -> tuple[Station, ...]:
    slip = 1e-9 * (1.0 + length)
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


def _stretches(
    path: Curve, limits: Limits, top: float, start: float, length: float, stops: Sequence[Station]
) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Ends of the stretches from start to end, the largest v² on each, and where to rest."""
    places = np.unique([start, length, *(stop.distance for stop in stops)])
    if limits.max_lateral_accel is None:
        line, caps = places, np.full(len(places) - 1, top * top)
        rests = np.zeros(len(places), dtype=np.bool_)
    else:
        joints = np.asarray(path.distance(np.linspace(*path.domain, len(path.spans) + 1)))
        first = max(int(np.searchsorted(joints, start, side="right")) - 1, 0)
        arcs, arc_caps, corners = profile.bend_caps(
            np.ascontiguousarray(path.spans[first:]), joints[first:],
            limits.max_lateral_accel, limits.max_accel, top * top, TOLERANCE,
        )  # fmt: skip
        line = np.union1d(arcs[arcs > start], places)
        middles = 0.5 * (line[1:] + line[:-1])
        within = np.clip(np.searchsorted(arcs, middles) - 1, 0, len(arc_caps) - 1)
        caps = arc_caps[within]
        rests = np.isin(line, arcs[corners & (arcs > start)])
    rests |= np.isin(line, [stop.distance for stop in stops])
    return line, caps, rests
