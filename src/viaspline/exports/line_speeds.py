"""From a time law to one speed for each straight line, as formats of way points have them."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.trajectory.trajectory import Trajectory

SPEED_STEP: Final = 1.25
"""Within a line what may be set differs by no more than this."""

SAME_SPEED: Final = 1.03
"""Lines behind each other whose speeds differ by no more than this get one."""

MOST_LOST_S: Final = 0.5
"""What a line may take longer for having one speed [s]."""

_FULL: Final = 0.9
"""Of the greatest acceleration, what counts as speeding up or braking as hard as can be."""

_SAME_TIME: Final = 1.03
"""With a limit of the jerk: of the least time for a change of speed, what counts as that."""

_CREEPING: Final = 0.1
"""Of a line's greatest speed, below which not its least speed counts but its mean one."""

_SAMPLES: Final = 4000


class SettableSpeeds:
    """What speed may be set for a vehicle at each place of a path.

    It is the planned one, but where the plan speeds up as hard as the robot can, up to what it
    speeds up to; and where it brakes to a rest, what it brakes from: the vehicle does both by
    itself. So one with the mission's accelerations that keeps what is set is nowhere faster than
    the plan.

    Args:
        law: The time law.
        max_accel: The robot's greatest acceleration [m/s²].
        max_brake: Its greatest deceleration [m/s²].
        max_jerk: The greatest change of either [m/s³]; None: no limit.
    """

    def __init__(
        self, law: Trajectory, max_accel: float, max_brake: float, max_jerk: float | None = None
    ) -> None:
        ends = (float(law.distances[0]), float(law.distances[-1]))
        self._law = law
        self._at = np.union1d(law.distances, np.linspace(*ends, _SAMPLES))
        low = np.array(law.speed_at(self._at), np.float64)
        high = low.copy()
        for first, last, speed in _ramps(law, max_accel, max_brake, max_jerk):
            inside = (self._at >= first) & (self._at <= last)
            low[inside] = np.maximum(low[inside], speed)
            high[inside] = speed
        self._low, self._high = low, high

    def least(self, first: float, last: float) -> float:
        """The least of them between two distances along the path [m], in [m/s]."""
        return float(self._low[self._slice(first, last)].min())

    def may_be_one(self, first: float, last: float) -> bool:
        """Whether one speed does between two distances along the path [m]."""
        part = self._slice(first, last)
        least, high = float(self._low[part].min()), self._high[part]
        if high.max() > SPEED_STEP * least:
            return False
        # Of the samples the mean stands for the line: they are close together.
        step = (last - first) / max(len(high), 1)
        return float((step / max(least, 1e-9) - step / np.maximum(high, 1e-9)).sum()) <= MOST_LOST_S

    def of_line(self, first: float, last: float) -> float:
        """The speed to be set for a line between two distances along the path [m], in [m/s]."""
        part = self._slice(first, last)
        least = float(self._low[part].min())
        if least >= _CREEPING * float(self._high[part].max()):
            return least
        times = np.asarray(self._law.time_at([first, last]))
        stays = sum(s.dwell for s in self._law.stations if first <= s.distance < last)
        return (last - first) / max(float(times[1] - times[0]) - stays, 1e-9)

    def _slice(self, first: float, last: float) -> slice:
        """The samples between two distances, at least one."""
        inside = np.searchsorted(self._at, (first + 1e-9, last - 1e-9))
        begin = min(int(inside[0]), len(self._at) - 1)
        return slice(begin, max(int(inside[1]), begin + 1))


def set_speeds(speeds: Floats) -> Floats:
    """The speeds that are set for lines in a row, changed as seldom as may be [m/s], shape (n,).

    Lines behind each other get one speed, the least of theirs, as long as it is no more than three
    in a hundred less than any of them.

    Args:
        speeds: What may be set for each line [m/s], shape (n,).

    >>> set_speeds(np.array([2.0, 1.99, 1.95, 0.9, 1.0, 2.0])).tolist()
    [1.95, 1.95, 1.95, 0.9, 1.0, 2.0]
    """
    found = np.array(speeds, np.float64)
    first = 0
    for i in range(1, len(found) + 1):
        run = speeds[first : i + 1]
        if i == len(found) or run.max() > SAME_SPEED * run.min():
            found[first:i] = speeds[first:i].min()
            first = i
    return found


def _ramps(
    law: Trajectory, max_accel: float, max_brake: float, max_jerk: float | None
) -> list[tuple[float, float, float]]:
    """Where the vehicle speeds up or brakes by itself: from, to [m], and the speed for it."""
    at, speed = law.distances, law.speeds
    step = np.diff(at)
    gain = np.divide(np.diff(speed**2), 2.0 * step, out=np.zeros(len(step)), where=step > 0.0)
    is_smooth = max_jerk is not None  # nothing is as hard as can be all the time then
    up = (gain > 0.0) if is_smooth else (gain >= _FULL * max_accel)
    down = (gain < 0.0) if is_smooth else (gain <= -_FULL * max_brake)
    found: list[tuple[float, float, float]] = []
    for begin, end in _runs(up):
        last = end
        while last > begin and not _is_quick(law, begin, last, max_accel, max_jerk):
            last -= 1
        found.append((float(at[begin]), float(at[last]), float(speed[last])))
    for begin, end in _runs(down):
        first = begin
        while first < end and not _is_quick(law, first, end, max_brake, max_jerk):
            first += 1
        if speed[end] == 0.0:
            found.append((float(at[first]), float(at[end]), float(speed[first])))
    return found


def _is_quick(law: Trajectory, begin: int, end: int, accel: float, max_jerk: float | None) -> bool:
    """Whether the speed changes from one node to another as quickly as it can."""
    if max_jerk is None:
        return True
    change = abs(float(law.speeds[end] - law.speeds[begin]))
    if change >= accel**2 / max_jerk:
        least = change / accel + accel / max_jerk
    else:
        least = 2.0 * math.sqrt(change / max_jerk)
    return float(law.times[end] - law.times[begin]) <= _SAME_TIME * least


def _runs(flags: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> list[tuple[int, int]]:
    """The first and the last node of pieces in a row that are flagged."""
    edges = np.flatnonzero(np.diff(np.r_[False, flags, False].astype(int)))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))
