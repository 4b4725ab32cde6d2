"""A time law along a path: where the robot is at every time, and when it is everywhere.

Tested through ``trajectory/test_retime``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.handed_in import numbers_from
from viaspline.kernels.arrays import Floats
from viaspline.kernels.timing.integrate import ride
from viaspline.kernels.timing.law_states import law_states
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.rounded_number import rounded
from viaspline.presentable.shown_value import ShownValue
from viaspline.trajectory.limits import Station
from viaspline.trajectory.motion_pieces import after, speed_into, time_into


@dataclass(frozen=True, eq=False)
class Trajectory(ShownValue, ComparedByValue):
    """Speed and time along a path, exact between its points.

    Without a limit of the jerk the acceleration is constant from point to point. With one it
    changes linearly with the distance, and with time beside a rest.

    A station appears twice: when the robot arrives and when it leaves. All arrays are read-only.

    Attributes:
        distances: Along the path [m], not decreasing, shape (n,).
        speeds: [m/s], shape (n,).
        times: [s], not decreasing, shape (n,).
        accelerations: Along the path, at the beginning of what lies between each point and the
            next [m/s²], shape (n - 1,).
        stations: The stops on the way, in order.
        over_limit_until: Distance up to which the robot is faster than its limits allow, because
            it was when the time law began [m]; it brakes as hard as it can there. None if never.
        changes: Of the acceleration with the distance [1/s²], shape (n - 1,); None: all 0.
        jerks: Changes of the acceleration with time beside rests [m/s³], shape (n - 1,), 0
            elsewhere; None: all 0.
        over_jerk_until: Distance up to which ``max_jerk`` is exceeded, because there is no room to
            keep it from the start on [m]. None if never.
    """

    distances: Floats
    speeds: Floats
    times: Floats
    accelerations: Floats
    stations: tuple[Station, ...] = ()
    over_limit_until: float | None = None
    changes: Floats | None = None
    jerks: Floats | None = None
    over_jerk_until: float | None = None

    def __post_init__(self) -> None:
        for values in (self.distances, self.speeds, self.times, self.accelerations):
            values.flags.writeable = False

    def __repr__(self) -> str:
        begin, end = float(self.distances[0]), float(self.distances[-1])
        count = len(self.stations)
        stops = f", {count} station{'s' if count > 1 else ''}" if count else ""
        return (
            f"<Trajectory: {begin:g} m to {rounded(end, 1)} m in {self.duration:.1f} s from "
            f"{self.start_time:g} s on, at most {rounded(float(self.speeds.max()), 2)} m/s{stops}>"
        )

    @classmethod
    def through(
        cls,
        distances: Floats,
        squares: Floats,
        *,
        max_accel: float,
        stations: Sequence[Station] = (),
        start_time: float = 0.0,
        over_limit_until: float | None = None,
    ) -> Trajectory:
        """The time law with these squares of the speed, linear between the points.

        Args:
            distances: Increasing [m], shape (n,), with all stations among them.
            squares: v² there [m²/s²], shape (n,), 0 at stations.
            max_accel: For stretches so short that v² is 0 at both of their ends [m/s²].
            stations: In order of distance.
            start_time: Time at the first point [s].
            over_limit_until: Passed on.
        """
        stops = np.array([(s.distance, s.dwell) for s in stations], dtype=np.float64)
        stops = np.ascontiguousarray(stops.reshape(-1, 2).T)
        law = ride(distances, squares, stops[0], stops[1], max_accel, start_time)
        return cls(*law, tuple(stations), over_limit_until)

    @property
    def start_time(self) -> float:
        """Time at its first point [s]."""
        return float(self.times[0])

    @property
    def end_time(self) -> float:
        """Time at its last point [s]."""
        return float(self.times[-1])

    @property
    def duration(self) -> float:
        """From its first point to its last [s]."""
        return self.end_time - self.start_time

    def delayed(self, seconds: float) -> Trajectory:
        """The time law begun so much later [s]."""
        return replace(self, times=self.times + seconds)

    def moved(self, by: float) -> Trajectory:
        """The time law so much farther along a path [m]: all its distances are larger."""
        over, jerky = self.over_limit_until, self.over_jerk_until
        return replace(
            self,
            distances=self.distances + by,
            stations=tuple(replace(stop, distance=stop.distance + by) for stop in self.stations),
            over_limit_until=None if over is None else over + by,
            over_jerk_until=None if jerky is None else jerky + by,
        )

    def waiting(self, distance: float, seconds: float) -> Trajectory:
        """The time law with a longer stay at a rest, at a distance along the path [m], [s]."""
        at_rest = np.flatnonzero((self.speeds == 0.0) & (self.distances >= distance))
        i = int(at_rest[0])
        while i + 1 < len(self.times) and self.distances[i + 1] == self.distances[i]:
            i += 1  # a stay that there is becomes longer
        return self.waiting_after(i, seconds)

    def waiting_after(self, i: int, seconds: float) -> Trajectory:
        """The time law that goes on so much later from its point i, the last one of a rest."""
        if i > 0 and self.distances[i - 1] == self.distances[i]:
            times = np.concatenate((self.times[:i], self.times[i:] + seconds))
            return replace(self, times=times)

        def twice(values: Floats) -> Floats:
            return np.concatenate((values[: i + 1], values[i:]))

        def none_between(values: Floats) -> Floats:
            return np.concatenate((values[:i], [0.0], values[i:]))

        return replace(
            self,
            distances=twice(self.distances),
            speeds=twice(self.speeds),
            times=np.concatenate((self.times[: i + 1], self.times[i:] + seconds)),
            accelerations=none_between(self.accelerations),
            changes=None if self.changes is None else none_between(self.changes),
            jerks=None if self.jerks is None else none_between(self.jerks),
        )

    def staying_at_most(self, seconds: float) -> Trajectory:
        """The time law with no stay longer than this [s]; itself, if it has none."""
        lasts = np.diff(self.times)
        spared = np.where(np.diff(self.distances) == 0.0, np.maximum(lasts - seconds, 0.0), 0.0)
        if not spared.any():
            return self
        return replace(self, times=self.times - np.concatenate(([0.0], np.cumsum(spared))))

    def until(self, distance: float) -> Trajectory:
        """The time law as far as the first rest at a distance along the path [m] or beyond it."""
        rests = np.flatnonzero((self.speeds == 0.0) & (self.distances >= distance))
        if not rests.size:
            return self
        last = max(int(rests[0]), 1)
        return replace(
            self,
            distances=self.distances[: last + 1],
            speeds=self.speeds[: last + 1],
            times=self.times[: last + 1],
            accelerations=self.accelerations[:last],
            changes=None if self.changes is None else self.changes[:last],
            jerks=None if self.jerks is None else self.jerks[:last],
            stations=tuple(s for s in self.stations if s.distance <= self.distances[last]),
        )

    def cut_after(self, time: float) -> float:
        """The first time from here on at which another time law may take over [s].

        The last moments before a rest, in which the acceleration changes with time, stay whole.
        """
        i = int(self.times.searchsorted(time, side="right")) - 1
        if self.jerks is None or not 0 <= i < len(self.jerks):
            return time
        is_last = self.jerks[i] > 0.0 and self.speeds[i] > 0.0
        return float(self.times[i + 1]) if is_last else time

    def followed_by(self, later: Trajectory, since: float) -> Trajectory:
        """The time law from a time on [s], and from where a later one begins that one.

        Args:
            later: It begins in the state in which this one is then, at a time at which it may be
                cut.
            since: What was before is left out.
        """
        begin = later.start_time
        first = max(int(self.times.searchsorted(since, side="right")) - 1, 0)
        last = int(self.times.searchsorted(begin, side="left"))
        if last <= first or self.times[first] >= begin or since >= self.end_time:
            return later
        before = self if last < len(self.times) else self._standing_until(begin)
        kept = slice(first, min(last, len(before.accelerations)))
        passed = tuple(
            stop
            for stop in self.stations
            if self.distances[first] <= stop.distance < later.distances[0]
        )
        joined = replace(
            later,
            distances=np.concatenate((before.distances[kept], later.distances)),
            speeds=np.concatenate((before.speeds[kept], later.speeds)),
            times=np.concatenate((before.times[kept], later.times)),
            accelerations=np.concatenate((before.accelerations[kept], later.accelerations)),
            stations=(*passed, *later.stations),
            over_jerk_until=self._over_jerk_with(later),
        )
        if before.changes is None and later.changes is None:
            return joined
        changes, jerks = (
            np.concatenate((old[kept], new))
            for old, new in zip(before._bends, later._bends, strict=True)
        )
        return replace(joined, changes=changes, jerks=jerks)

    def _standing_until(self, time: float) -> Trajectory:
        """The time law that stays where it ends until a later time [s]."""
        end = len(self.times) - 1
        return self.waiting_after(end, time - self.end_time)

    def _over_jerk_with(self, later: Trajectory) -> float | None:
        """Up to where the jerk is exceeded on this law up to a later one, and on that [m]."""
        if self.over_jerk_until is None:
            return later.over_jerk_until
        until = min(self.over_jerk_until, float(later.distances[0]))
        return until if later.over_jerk_until is None else max(until, later.over_jerk_until)

    @property
    def _bends(self) -> tuple[Floats, Floats]:
        """How the acceleration changes in every piece, with the distance and with time."""
        none = np.zeros(len(self.accelerations))
        changes, jerks = self.changes, self.jerks
        return none if changes is None else changes, none if jerks is None else jerks

    def state_at(self, time: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Distance [m], speed [m/s] and acceleration [m/s²] at any time [s].

        Before its start and from its end on it stays as it is there, without acceleration.
        Scalar or array in, the same shape out.
        """
        at = numbers_from("time", time)
        if self.changes is not None and self.jerks is not None:
            return self._bent_state_at(at)
        law = (self.times, self.distances, self.speeds, self.accelerations)
        distance, speed, acceleration = law_states(*law, at.reshape(-1).copy())
        return (
            distance.reshape(at.shape)[()],
            speed.reshape(at.shape)[()],
            acceleration.reshape(at.shape)[()],
        )

    def _bent_state_at(self, time: Floats) -> tuple[Floats, Floats, Floats]:
        """State at any time of a law whose acceleration changes between its points."""
        t = _within(time, self.times[0], self.times[-1])
        i = _within(self.times.searchsorted(t, side="right") - 1, 0, len(self.accelerations) - 1)
        piece = (self.speeds[i], self.accelerations[i], *(one[i] for one in self._bends))
        states = after(t - self.times[i], *piece)
        is_over = t >= self.times[-1]
        moving = (t == time) & ~is_over
        distance = _within(self.distances[i] + states[0], self.distances[i], self.distances[i + 1])
        speed = np.where(is_over, self.speeds[-1], np.maximum(states[1], 0.0))
        return distance[()], speed[()], (states[2] * moving)[()]

    def distance_at(self, time: ArrayLike) -> Floats:
        """Distance along the path at any time [s], in [m]."""
        return self.state_at(time)[0]

    def _before(self, distance: ArrayLike) -> tuple[Floats, NDArray[np.intp], Floats, Floats]:
        """The clipped distance, its stretch, how far it is into it and the speed there."""
        s = _within(numbers_from("distance", distance), self.distances[0], self.distances[-1])
        last = self.accelerations.shape[0] - 1
        i = _within(self.distances.searchsorted(s, side="left") - 1, 0, last)
        into = s - self.distances[i]
        width = self.distances[i + 1] - self.distances[i]
        if self.changes is not None and self.jerks is not None:
            piece = (self.speeds[i], self.accelerations[i], self.changes[i], self.jerks[i])
            return s, i, into, speed_into(into, width, *piece)
        part = np.divide(into, width, out=np.zeros_like(into), where=width > 0)
        first, last_square = self.speeds[i] ** 2, self.speeds[i + 1] ** 2
        speed = np.sqrt(first + part * (last_square - first))
        return s, i, into, speed

    def speed_at(self, distance: ArrayLike) -> Floats:
        """Speed at a distance along the path [m], in [m/s]; 0 at stations."""
        return self._before(distance)[3][()]

    def time_at(self, distance: ArrayLike) -> Floats:
        """Time of arrival at a distance along the path [m], in [s]."""
        _, i, into, speed = self._before(distance)
        if self.changes is not None and self.jerks is not None:
            width = self.distances[i + 1] - self.distances[i]
            late = time_into(into, width, self.speeds[i], speed, self.changes[i], self.jerks[i])
            return np.minimum(self.times[i] + late, self.times[i + 1])[()]
        sums = self.speeds[i] + speed
        late = np.divide(2.0 * into, sums, out=np.zeros_like(into), where=sums != 0)
        return np.minimum(self.times[i] + late, self.times[i + 1])[()]

    def next_rest(self, distance: float) -> float:
        """The first distance from here on where the robot comes to rest, or the end [m]."""
        rests = self.distances[(self.speeds == 0.0) & (self.distances >= distance)]
        return float(rests[0]) if rests.size else float(self.distances[-1])


def _within(values: Any, low: Any, high: Any) -> Any:
    """``np.clip``, which takes ten times as long for a number."""
    return np.minimum(np.maximum(values, low), high)
