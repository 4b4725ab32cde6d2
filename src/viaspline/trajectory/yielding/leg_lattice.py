"""The lattice for a leg: its steps divide the leg, and its speeds the largest one.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.kernels.timing.yielding.time_lattice import TimeLattice

RATIOS = ((1, 1), (1, 2), (2, 1), (1, 3), (3, 1), (2, 3), (3, 2))
"""Quanta by which the speed rises and falls in a step."""
MIN_PLACES = 1500
"""A leg has so many places at least."""


@dataclass(frozen=True)
class DrivenLeg:
    """What is driven from one rest to the next.

    Attributes:
        start: Distance along the path [m].
        end: The same of the rest at its end [m].
        stay: For how long the robot has to stay there [s].
        begin: The first time at which it can begin [s].
        speed: With which it begins [m/s].
    """

    start: float
    end: float
    stay: float
    begin: float
    speed: float = 0.0

    @property
    def length(self) -> float:
        """[m]."""
        return self.end - self.start


@dataclass(frozen=True)
class Dynamics:
    """How a robot speeds up and slows down along a path.

    Attributes:
        accel: [m/s²].
        brake: [m/s²].
        top: Largest speed [m/s].
    """

    accel: float
    brake: float
    top: float

    def lattice(self, leg: DrivenLeg, step: float) -> TimeLattice:
        """The lattice over a leg, with steps as long as they may be [s]."""
        hardest = max(self.accel, self.brake)
        step = min(step, math.sqrt(2.0 * leg.length / (MIN_PLACES * hardest)))
        ups, downs = max(RATIOS, key=self._kept)
        pace = self._pace((ups, downs))
        top = min(self.top, max(math.sqrt(2.0 * hardest * leg.length), leg.speed))
        levels = max(math.ceil(top / (pace * step) - 1e-9), 1)
        quantum = top / levels
        pitch = 0.5 * quantum * quantum / pace
        count = max(math.floor(leg.length / pitch + 1e-9), 1)
        pitch = leg.length / count
        return TimeLattice(
            leg.begin, 2.0 * pitch / quantum, leg.start, pitch, count, levels, ups, downs
        )

    def _pace(self, ratio: tuple[int, int]) -> float:
        """The acceleration that is one quantum in a step [m/s²]."""
        return min(self.accel / ratio[0], self.brake / ratio[1])

    def _kept(self, ratio: tuple[int, int]) -> float:
        """How much of what the robot can do is left with a ratio."""
        return self._pace(ratio) * (ratio[0] / self.accel + ratio[1] / self.brake)


def on_lattice(
    lattice: TimeLattice, start: float, end: float, begin: float, level: int
) -> TimeLattice:
    """A lattice with the same speeds over another leg, not much shorter.

    In every step the place changes by as many pitches as the sum of the levels: at rest the robot
    is an even number of them away from where it was at rest, and an odd one from an odd level.
    """
    count = math.floor((end - start) / lattice.pitch + 1e-9)
    count = max(count - (count - level) % 2, 2 - level % 2)
    pitch = (end - start) / count
    step = lattice.step * pitch / lattice.pitch
    return lattice._replace(begin=begin, step=step, origin=start, pitch=pitch, last=count)
