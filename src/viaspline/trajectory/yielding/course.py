"""What is driven, from rest to rest, and how the static fastest law drives it.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.mission.world_spec import SpeedZone
from viaspline.trajectory.coupled import Stage
from viaspline.trajectory.curvature_limited import stretches_of
from viaspline.trajectory.limited_path import limited_path_of
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import stops_from
from viaspline.trajectory.slow_zones import Slow, slow_between
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.law_knots import LawKnots

SAME_PLACE_M = 1e-6
"""Rests that are no farther apart are one, and one so near ahead is where the robot stands [m]: a
lattice between rests that only rounding keeps apart has places that no number tells apart."""


@dataclass(frozen=True, eq=False)
class Course:
    """What is driven.

    Attributes:
        path: The path.
        limits: What is kept along it.
        stops: Stations, in order.
        stage: From where to where, and where it is slow.
        static: The fastest law where nothing moves.
    """

    path: PiecewiseCubic
    limits: Limits
    stops: tuple[Station, ...]
    stage: Stage
    static: Trajectory

    @classmethod
    def of(
        cls, path: PiecewiseCubic, limits: Limits, stations: Sequence[Station],
        zones: Sequence[SpeedZone], slow: Sequence[Slow], speed_cap: float | None,
        static: Trajectory,
    ) -> Course:  # fmt: skip
        """The course of a static law."""
        start, length = float(static.distances[0]), float(path.length)
        stops = stops_from(stations, start, length)
        stage = Stage(
            start=start,
            end=length,
            first=float(static.speeds[0]),
            last=0.0,
            top=limits.max_speed if speed_cap is None else min(limits.max_speed, speed_cap),
            stops=tuple(stop.distance for stop in stops),
            slow=(
                *limited_path_of(path, limits).slow(zones, start),
                *slow_between(slow, start, length),
            ),
        )
        return cls(path, limits, stops, stage, static)

    def stretches(self) -> tuple[Floats, Floats, Floats]:
        """Ends of stretches (n + 1,) [m], the largest speed on each (n,) [m/s], and rests [m].

        Of rests in one place the last one counts.
        """
        line, caps, is_rest = stretches_of(self.path, self.limits, self.stage)
        ahead = line[is_rest & (line > self.stage.start + SAME_PLACE_M)]
        rests = np.unique(np.append(ahead, self.stage.end))
        is_last = np.append(np.diff(rests) > SAME_PLACE_M, True)
        return line, np.sqrt(caps), rests[is_last]

    def dwell(self, distance: float) -> float:
        """How long the robot stays at a distance [s]."""
        here = (stop for stop in self.stops if abs(stop.distance - distance) <= SAME_PLACE_M)
        return sum(stop.dwell for stop in here)

    def onset(self) -> LawKnots:
        """The law until it can be chosen: where the robot is too fast, it brakes."""
        law, over = self.static, self.static.over_limit_until
        last = 1 if over is None else int(law.distances.searchsorted(over)) + 1
        first = LawKnots(law.times[:last], law.distances[:last], law.speeds[:last])
        if first.speeds[-1] > 0.0 or self.dwell(self.stage.start) == 0.0:
            return first
        return first.then(first.times[-1] + self.dwell(self.stage.start))

    def reaches(self, distance: float) -> float:
        """When the static law comes to a distance [s]."""
        return float(self.static.time_at(distance))

    def law(self, knots: LawKnots) -> Trajectory:
        """The time law through some knots to the end, where the robot stays as long as asked."""
        stays = self.dwell(self.stage.end)
        whole = knots.then(knots.times[-1] + stays) if stays > 0.0 else knots
        times, places, speeds = whole.merged().fields
        return Trajectory(
            places, speeds, times, np.diff(speeds) / np.diff(times), self.stops,
            self.static.over_limit_until,
        )  # fmt: skip
