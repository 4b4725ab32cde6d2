"""What passive safety is proven against, and the places at which it is asked.

Tested through ``trajectory/test_passive_safety`` and ``trajectory/test_charted_safety``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import Final

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.kernels.motion.passive_contacts import LEAST_GAP
from viaspline.kernels.motion.passive_threats import Threats, free_until
from viaspline.world.moving_obstacles import MovingObstacles

SPACING_M: Final = 0.1
"""From place to place along a path [m]."""

SAME_PLACE_M: Final = 1e-9
"""Places of a law that are nearer to each other are one [m]."""


@cache
def _nothing() -> MovingObstacles:
    """That is on no map: to be packed once."""
    return MovingObstacles()


@dataclass(frozen=True, eq=False)
class PassivePremises:
    """What may come, by one look: what passive safety is proven against.

    Attributes:
        tubes: What was seen to move or may move, each in its tube; none of them jumps.
        seen_at: When the look was [s].
        top_speed: Nothing that isn't on the map is faster [m/s].
        eye: Where the look was taken [m], shape (2,) or longer.
        reach: All that is there and nearer was seen, or is behind a mouth [m].
        mouths: Lines through which what was hidden may come [m], ``x0, y0, x1, y1``, shape (k, 4).
        charted: What moves as the map says, by the same clock; it may jump.
    """

    tubes: MovingObstacles
    seen_at: float
    top_speed: float
    eye: tuple[float, ...]
    reach: float = math.inf
    mouths: Floats = field(default_factory=lambda: np.empty((0, 4)))
    charted: MovingObstacles = field(default_factory=MovingObstacles)

    def along(self, part: ChordTable, keep: float) -> Threats:
        """What kernels take that are asked about a part of a path.

        Args:
            part: Of the path.
            keep: What is kept from what may come [m].
        """
        if not len(self.charted):
            return self._packed
        x, y, radius = part.circle
        around = radius + keep + LEAST_GAP
        until = free_until(self.charted.packed, x, y, around, float(self.seen_at))
        return self._packed._replace(free_until=until)

    @property
    def first_charted(self) -> int:
        """The first source of what may come that is on the map, as kernels count them."""
        return 1 + len(self.mouths) + int(self.tubes.packed.speeds.size)

    @cached_property
    def _packed(self) -> Threats:
        """What may come, wherever that is asked."""
        eye, mouths = np.array(self.eye[:2], np.float64), np.ascontiguousarray(self.mouths)
        charted = self.charted if len(self.charted) else _nothing()
        return Threats(
            self.tubes.packed, float(self.seen_at), float(self.top_speed), eye, float(self.reach),
            mouths.reshape(-1, 4).astype(np.float64), charted.packed, np.empty(0),
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class ChordTable:
    """A part of a path as kernels take it: places at multiples of ``SPACING_M``.

    Attributes:
        origin: The distance along the path of the first of them [m].
        places: [m], shape (n, 2), n >= 2; the chord in which the path ends goes on beyond it.
        sag: How far the path may be from the chords between them [m].
    """

    origin: float
    places: Floats
    sag: float

    @classmethod
    def of(cls, path: Path, start: float, end: float) -> ChordTable:
        """The part of a path between two distances along it [m].

        Of two places A and B at a distance l along the path and a chord c, a place P between them
        that is w l behind A is at most w l from A and (1 - w) l from B. So the place Q that is as
        far along the chord is near it (Stewart's theorem):

            |PQ|² = (1-w) |PA|² + w |PB|² - w (1-w) c² <= w (1-w) (l² - c²) <= (l² - c²) / 4.
        """
        first = math.floor(start / SPACING_M)
        last = max(math.ceil(end / SPACING_M), first + 1)
        along = np.minimum(SPACING_M * np.arange(first, last + 1), path.length)
        places = np.ascontiguousarray(np.asarray(path.at_distance(along))[:, :2])
        steps, chords = np.diff(along), np.diff(places, axis=0)
        left = np.maximum(steps**2 - (chords**2).sum(axis=1), 0.0)
        short = int((steps > SAME_PLACE_M).sum()) - 1  # where the path ends within a step
        if short >= 0:
            places[short + 1 :] = places[short] + chords[short] * (SPACING_M / steps[short])
        return cls(first * SPACING_M, places, 0.5 * math.sqrt(float(left.max())))

    @classmethod
    def at(cls, path: Path, distance: float) -> ChordTable:
        """One place of a path, at a distance along it [m]."""
        place = np.asarray(path.at_distance(distance))[:2]
        return cls(distance, np.array((place, place)), 0.0)

    @property
    def circle(self) -> tuple[float, float, float]:
        """The middle and the radius of a circle around all of its places: x, y, radius [m]."""
        middle = 0.5 * (self.places.min(axis=0) + self.places.max(axis=0))
        radius = float(np.hypot(*(self.places - middle).T).max())
        return float(middle[0]), float(middle[1]), radius
