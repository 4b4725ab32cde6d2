"""What goes wrong under way: robots that are slow, that halt, that aren't heard."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.handed_in import number_from
from viaspline.kernels.fleet.granted_drive import PackedTrouble

SEEDS = 1 << 62
"""So many seeds the kernels tell apart."""
MOST_HALTS = 1000.0
"""Of a robot in the mean."""


@dataclass(frozen=True, kw_only=True)
class Delays:
    """How robots are delayed at random.

    Attributes:
        slowed: The largest part of its speed that a robot lacks, 0 to 0.95: it is drawn anew for
            every stretch, evenly from 0 on.
        stretch_m: How long such a stretch is [m].
        halts: How often a robot halts on its way, in the mean; where is drawn at random.
        halts_s: For how long it stands then [s].
        lost: The part of all reports, and of all grants, that never arrive, 0 to 0.95.

    Raises:
        GeometryError: A number is not within its bounds.

    >>> Delays(slowed=2)
    Traceback (most recent call last):
    viaspline.errors.GeometryError: delays.slowed is 2; give a number from 0 to 0.95
    """

    slowed: float = 0.0
    stretch_m: float = 20.0
    halts: float = 0.0
    halts_s: float = 30.0
    lost: float = 0.0

    def __post_init__(self) -> None:
        bounds = {
            "slowed": (0.0, 0.95), "stretch_m": (1.0, math.inf), "halts": (0.0, MOST_HALTS),
            "halts_s": (0.0, 1e6), "lost": (0.0, 0.95),
        }  # fmt: skip
        for key in fields(self):
            value, (low, high) = getattr(self, key.name), bounds[key.name]
            if not low <= number_from(f"delays.{key.name}", value) <= high:
                raise GeometryError(
                    f"delays.{key.name} is {value}; give a number from {low:g} to {high:g}"
                )


def trouble_of(delays: Delays, fleet: DrivenFleet, seed: int) -> PackedTrouble:
    """Delays at random, for each cell of each robot.

    Args:
        delays: What may go wrong.
        fleet: Whose robots it befalls.
        seed: The same seed makes the same trouble.
    """
    random = np.random.default_rng(seed)
    courses = fleet.courses.packed
    pace, halts = np.ones(courses.distance.size), np.zeros(courses.distance.size)
    for robot, length in enumerate(fleet.lengths):
        nodes = slice(int(courses.first[robot]), int(courses.first[robot + 1]))
        along = courses.distance[nodes]
        stretch = (along / delays.stretch_m).astype(np.int64)
        lacks = random.uniform(0.0, delays.slowed, int(length / delays.stretch_m) + 1)
        pace[nodes] = 1.0 - lacks[stretch]
        where = random.uniform(0.0, length, random.poisson(delays.halts))
        at = np.minimum(np.searchsorted(along, where), along.size - 2)
        np.add.at(halts[nodes], at, delays.halts_s)
    return PackedTrouble(pace, halts, delays.lost, seed % SEEDS)
