"""Where a path has to be driven more slowly because the body turns about the vertical.

Tested through ``space/timing/test_yaw_profile``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.machine.turns_on_spot import TURN
from viaspline.space.timing.yaw_profile import YawProfile
from viaspline.trajectory.limits import Station
from viaspline.trajectory.slow_zones import Slow


def yaw_speeds(profile: YawProfile, rate: float | None, top: float) -> tuple[Slow, ...]:
    """The stretches on which the yaw rate allows less than the largest speed.

    Args:
        profile: The headings along the path.
        rate: Largest yaw rate [rad/s]; None: no limit.
        top: Largest speed along the path [m/s].

    >>> yaw_speeds(YawProfile(np.array([0.0, 4, 8]), np.array([0.0, 2, 2])), 1.0, 5.0)
    (Slow(start=0.0, end=4.0, speed=2.0),)
    """
    if rate is None:
        return ()
    along, by = np.diff(profile.distances), np.abs(np.diff(profile.headings))
    found: list[Slow] = []
    for k in np.flatnonzero((along > 0.0) & (by * top > rate * along)).tolist():
        start, end = float(profile.distances[k]), float(profile.distances[k + 1])
        speed = rate * float(along[k]) / float(by[k])
        if found and found[-1].end == start and math.isclose(found[-1].speed, speed, rel_tol=0.01):
            found[-1] = Slow(found[-1].start, end, min(speed, found[-1].speed))
        else:
            found.append(Slow(start, end, speed))
    return tuple(found)


def with_yaw_turns(
    stations: tuple[Station, ...], profile: YawProfile, rate: float | None
) -> tuple[Station, ...]:
    """The stops of a path, long enough for the turns on the spot.

    A turn where nothing stops yet is a stop of its own, for as long as it takes; during a dwell
    that is long enough it takes no time.

    Args:
        stations: The stops of the route.
        profile: The headings along the path.
        rate: Largest yaw rate [rad/s]; None: a turn takes no time.

    >>> profile = YawProfile(np.array([0.0, 4, 4, 8]), np.array([0.0, 0, 2, 2]))
    >>> with_yaw_turns((Station(4.0, 0.5, "gauge"),), profile, 1.0)
    (Station(distance=4.0, dwell=2.0, name='gauge'),)
    """
    stops = {station.distance: station for station in stations}
    for at, by in profile.turns:
        dwell = 0.0 if rate is None else abs(by) / rate
        near = next((d for d in stops if math.isclose(d, at, rel_tol=1e-9, abs_tol=1e-9)), None)
        if near is None:
            stops[at] = Station(at, dwell, TURN)
        else:
            stop = stops[near]
            stops[near] = Station(stop.distance, max(stop.dwell, dwell), stop.name)
    return tuple(stops[distance] for distance in sorted(stops))
